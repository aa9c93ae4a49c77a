from collections.abc import Iterator
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from executive.geometry import rays, transform
from executive.perception.pipeline import locate
from executive.types.geometry import Pose, Vector3
from sim.__main__ import HEIGHT, WIDTH, main
from sim.bullet.bodies import build_home, frame_pose, place_objects
from sim.bullet.camera import (
    GLANCING,
    KEPT_SEGMENTATIONS,
    LOOKING,
    SimulatedCamera,
    SimulatedDetector,
    render,
    view_from,
)
from sim.bullet.client import connect
from sim.bullet.rendering import draw, draw_part, parts
from sim.home.home_file import load_home
from sim.objects.objects import load_objects

pytestmark = pytest.mark.physics

HOME = load_home("four_rooms")
EYE_HEIGHT_M = 1.35
PLACES = [place.name for place in HOME.places()]


class Scene:
    def __init__(self) -> None:
        self.client: Any = connect()
        build_home(self.client, HOME)
        self.names = place_objects(self.client, HOME, load_objects())


@pytest.fixture(scope="module")
def scene() -> Iterator[Scene]:
    scene = Scene()
    yield scene
    scene.client.disconnect()


def view(place: str, target: Vector3) -> Pose:
    """A camera over the middle of the robot that stands before a place."""
    eye = np.array([*HOME.stand(place)[:2], EYE_HEIGHT_M])
    forward = (np.asarray(target) - eye) / np.linalg.norm(np.asarray(target) - eye)
    right = np.cross(forward, (0, 0, 1))
    right /= np.linalg.norm(right)
    axes = np.column_stack((right, np.cross(forward, right), forward))
    return Pose(tuple(eye.tolist()), tuple(Rotation.from_matrix(axes).as_quat().tolist()))


def camera_at(scene: Scene, pose: Pose) -> SimulatedCamera:
    return SimulatedCamera(scene.client, lambda: pose)


@pytest.mark.parametrize("place", PLACES)
def test_every_object_is_visible_from_a_view_of_its_furniture(scene: Scene, place: str):
    expected = {name for name, where in HOME.placement.items() if where == place}
    found = set()
    for target in HOME.view_targets(place):
        camera = camera_at(scene, view(place, target))
        detector = SimulatedDetector(camera, scene.names, minimum_pixels=160)
        found |= {detection.label for detection in detector.detect(camera.capture())}
    assert expected <= found


@pytest.mark.parametrize("place", PLACES)
def test_the_front_of_every_surface_is_in_sight_of_its_view(scene: Scene, place: str):
    piece = HOME.furniture_named(place)
    for surface, target in zip(piece.surfaces(), HOME.view_targets(place), strict=True):
        eye = view(place, target).position
        x, _, z = surface.center
        spot = piece.to_map((x + surface.length_x / 2 - 0.13, 0.0, z + 0.03))
        [hit] = scene.client.rayTestBatch([eye], [spot])
        assert hit[0] == -1 or hit[0] in scene.names


@pytest.mark.parametrize("place", ["dining_table", "shelf_lobby", "sofa"])
def test_depth_meets_the_surface_that_a_ray_meets(scene: Scene, place: str):
    pose = view(place, HOME.view_targets(place)[0])
    seen = render(scene.client, pose, GLANCING)
    rows, columns = (grid.ravel() for grid in np.mgrid[4:240:12, 4:320:12])
    reach = 8.0
    ends = transform(pose, reach * rays(GLANCING, rows, columns))
    hits = scene.client.rayTestBatch([pose.position] * len(rows), ends.tolist())
    same = np.array([hit[0] for hit in hits]) == seen.segmentation[rows, columns]
    true_depth = reach * np.array([hit[2] for hit in hits])
    assert same.mean() > 0.99
    off = np.abs(seen.depth[rows, columns] - true_depth)
    thing = np.isin(seen.segmentation[rows, columns], list(scene.names))
    assert off[same & ~thing].max() < 0.005
    seen_things = off[same & thing]
    assert not seen_things.size or np.median(seen_things) < 0.003  # drawn as meshes


def test_depth_is_infinite_where_nothing_is(scene: Scene):
    up = Pose((7.0, 5.6, 1.0))
    seen = render(scene.client, up, GLANCING)
    assert np.isinf(seen.depth).all()
    assert (seen.segmentation == -1).all()


@pytest.mark.parametrize("place", ["counter_wagon", "shelf_lobby"])
def test_a_large_picture_drawn_in_two_parts_is_the_one_drawn_in_one(scene: Scene, place: str):
    wanted = view_from(view(place, HOME.view_targets(place)[0]), LOOKING)
    assert [part.width for part in parts(wanted)] == [320, 320]
    whole, seen = draw_part(scene.client, wanted), draw(scene.client, wanted)
    assert np.array_equal(seen.color, whole.color)
    assert np.array_equal(seen.segmentation, whole.segmentation)
    assert np.array_equal(seen.depth[:, ::2], whole.depth[:, ::2])
    assert np.allclose(seen.depth, whole.depth, rtol=0, atol=2e-5)  # that of a column in a column


def test_pictures_are_numbered(scene: Scene):
    camera = camera_at(scene, view("desk", HOME.view_targets("desk")[0]))
    assert [camera.capture().number for _ in range(3)] == [0, 1, 2]


def test_a_detection_covers_the_pixels_of_its_object_and_their_depth_lies_on_it(scene: Scene):
    camera = camera_at(scene, view("dining_table", HOME.view_targets("dining_table")[0]))
    frame = camera.capture()
    detections = SimulatedDetector(camera, scene.names).detect(frame)
    assert detections[0].label == "cracker_box"
    [apple] = [detection for detection in detections if detection.label == "apple"]
    points = locate(apple, frame).points
    [body] = [body for body, name in scene.names.items() if name == "apple"]
    middle = np.asarray(frame_pose(scene.client, body).position) + (0, 0, 0.0375)
    assert len(points) >= 100
    off_sphere = np.abs(np.linalg.norm(points - middle, axis=1) - 0.0375)
    assert np.quantile(off_sphere, 0.95) < 0.005  # an apple is dented at its stem


def test_late_pictures_can_be_recognised_and_very_old_ones_are_forgotten(scene: Scene):
    camera = camera_at(scene, view("desk", HOME.view_targets("desk")[0]))
    frames = [camera.capture() for _ in range(KEPT_SEGMENTATIONS + 1)]
    detector = SimulatedDetector(camera, scene.names)
    assert [detection.label for detection in detector.detect(frames[1])] == ["scissors"]
    with pytest.raises(KeyError):
        detector.detect(frames[0])


def test_things_with_too_few_pixels_are_not_detected(scene: Scene):
    camera = camera_at(scene, view("dining_table", HOME.view_targets("dining_table")[0]))
    frame = camera.capture()
    few = SimulatedDetector(camera, scene.names, minimum_pixels=4000).detect(frame)
    assert [detection.label for detection in few] == ["cracker_box"]


def test_things_rest_where_the_home_has_them(scene: Scene):
    for body, name in scene.names.items():
        moved = np.subtract(
            frame_pose(scene.client, body).position, HOME.object_pose(name).position
        )
        assert np.linalg.norm(moved) < 0.002, name


def test_a_home_can_be_drawn_from_the_command_line(tmp_path: Path):
    picture = tmp_path / "home.png"
    assert main(["view", "--out", str(picture)]) == 0
    color = cv2.imread(str(picture))
    assert color is not None
    assert color.shape == (HEIGHT, WIDTH, 3)
    assert len(np.unique(color.reshape(-1, 3), axis=0)) > 50


def test_drawing_an_unknown_home_says_so(capsys: pytest.CaptureFixture[str]):
    assert main(["view", "villa"]) == 2
    assert "packaged are four_rooms" in capsys.readouterr().err
