"""What a camera picture costs: `python tests/benchmarks/bench_rendering.py [YCB_DIR]`.

Renders the packaged home with all its objects from three places, with our meshes or YCB's scans,
and once more with the boxes, cylinders and spheres that things collide with. Beside the whole:
what is left of it if only what shows is drawn, and if nothing is. That the rest is in vain is known
only afterwards. At the end, for each place to look from: how long one waits for a picture that this
process draws, that another draws, and that this other and its twin draw at once (real time).
"""

import sys
import time
from collections.abc import Callable, Collection, Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path

import numpy as np
from scipy.spatial.transform import Rotation

from executive.types.geometry import Pose
from sim.bullet.bodies import build_home, create_body
from sim.bullet.camera import LOOKING, pinhole, render, view_from
from sim.bullet.client import connect
from sim.bullet.rendering import View, draw
from sim.engine import BulletClient
from sim.home.home_file import load_home
from sim.objects.objects import ObjectModel, load_objects
from sim.objects.ycb import with_scans
from sim.pictures.painter import Asked, Stage
from sim.pictures.process import Painter
from sim.pictures.scene import Blueprint, Moment

HOME = load_home("four_rooms")
PLACES = "counter_wagon", "desk", "high_table"
PICTURES = 10
_OPTICAL = Rotation.from_matrix(np.array([[0, 0, 1], [-1, 0, 0], [0, -1, 0]]))


def world(client: BulletClient, models: dict[str, ObjectModel], meshes: bool) -> BulletClient:
    """The home with its things, drawn as meshes or as what they collide with."""
    build_home(client, HOME)
    for name in HOME.objects:
        model = models[name]
        look = model.look if meshes else None
        create_body(client, model.shapes, HOME.object_pose(name), look=look)
    return client


def pictures(client: BulletClient, width: int, height: int) -> str:
    """CPU time of pictures, on average over the places."""
    lens, took = pinhole(width, height), []
    for pose in map(look_at, PLACES):
        shown = set(np.unique(render(client, pose, lens).segmentation).tolist())
        costs = []
        for drawn in (range(client.getNumBodies()), shown, ()):
            with only(client, drawn):
                least = min(timed(partial(render, client, pose, lens)) for _ in range(PICTURES))
            costs.append(1000 * least)
        took.append(costs)
    whole, showing, empty = np.mean(took, axis=0)
    return f"{whole:.1f} ms; only what shows {showing:.1f} ms; nothing {empty:.1f} ms"


def look_at(place: str) -> Pose:
    """The camera of a robot that stands there."""
    x, y, yaw = HOME.stand(place)
    ahead = Rotation.from_euler("ZY", (yaw, 0.5)) * _OPTICAL
    return Pose((x, y, 1.3), tuple(ahead.as_quat().tolist()))


def waits(models: dict[str, ObjectModel]) -> str:
    """For the pictures that the robot looks at: median and most of all places."""
    client = connect()
    blueprint = Blueprint(client)
    world(client, models, meshes=True)
    painter = Painter(Stage(blueprint.looks, (), robot=0))
    ways: dict[str, Callable[[View], object]] = {
        "here": partial(draw, client),
        "another process": lambda view: painter.paint(Asked(view, Moment())).result(),
        "two others": lambda view: painter.paint(Asked(view, Moment(), awaited=True)).result(),
    }
    took: dict[str, list[float]] = {way: [] for way in ways}
    for place in HOME.places():
        view = view_from(look_at(place.name), LOOKING)
        for way, do in ways.items():
            do(view)
            began = time.perf_counter()
            do(view)
            took[way].append(1000 * (time.perf_counter() - began))
    painter.close()
    client.disconnect()
    return ", ".join(
        f"{way} {np.median(ms):.0f} ms (most {max(ms):.0f})" for way, ms in took.items()
    )


@contextmanager
def only(client: BulletClient, drawn: Collection[int]) -> Iterator[None]:
    """Draw no other bodies: the renderer passes over what has no opacity."""
    others = [body for body in range(client.getNumBodies()) if body not in drawn]
    colors = {body: [seen[7] for seen in client.getVisualShapeData(body)] for body in others}
    for body in others:
        client.changeVisualShape(body, -1, rgbaColor=(0.0, 0.0, 0.0, 0.0))
    yield
    for body, shapes in colors.items():
        for index, color in enumerate(shapes):
            client.changeVisualShape(body, -1, shapeIndex=index, rgbaColor=color)


def timed(do: Callable[[], object]) -> float:
    """CPU seconds that it takes: the renderer has one thread."""
    began = time.process_time()
    do()
    return time.process_time() - began


def main(arguments: list[str]) -> None:
    """Print the table."""
    models = load_objects()
    if arguments:
        models = with_scans(models, Path(arguments[0]))
    for label, meshes in (("meshes", True), ("shapes", False)):
        client = world(connect(), models, meshes)
        for width, height in ((320, 240), (640, 480)):
            print(f"{label} {width}x{height}: {pictures(client, width, height)}")
        client.disconnect()
    print(f"waiting for 640x480: {waits(models)}")


if __name__ == "__main__":
    main(sys.argv[1:])
