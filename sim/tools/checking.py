"""All that is wrong with a home: in its file, for who drives in it, and for the arm."""

from collections.abc import Iterator
from functools import cache
from itertools import product
from math import dist

import numpy as np

from executive.errors import InputError
from executive.types.home import DELIVERY, PERSON
from sim.body.hardware import FOLDED
from sim.home.furniture import Furniture
from sim.home.home import Home
from sim.home.home_file import inspect_home
from sim.home.validation import Flaw
from sim.manipulation.grasps import TILTS, Grasp, find_grasps
from sim.manipulation.planning import PlanningWorld
from sim.manipulation.reaching import (
    APPROACH_M,
    Approach,
    choose_approach,
    plan_stance,
    standing_poses,
)
from sim.navigation.grid import FOOTPRINT_M, OccupancyGrid, Unreachable, reachable
from sim.objects.objects import ObjectModel, why_not_taken

GRASPS_TRIED = 4
"""Of a thing, for each way to hold the hand."""
NEAR_M = 4.0
"""From the furniture of an object: farther away nothing is in the way of the arm."""


def check_home(name_or_path: str) -> tuple[InputError, ...]:
    """Everything that is wrong with a home, each with its file and key and what would be right.

    Faults of the file hide those of ways, and these the arm's: where the robot cannot stand, its
    arm would be tried in vain, which takes long.

    Raises:
        InputError: if there is no such home or it is not TOML.
    """
    home, faults = inspect_home(name_or_path)
    if home is None or faults:
        return faults
    flaws = tuple(way_faults(home)) or tuple(_reach_faults(home))
    return tuple(InputError(home.file, *flaw) for flaw in flaws)


def notes_on(name_or_path: str) -> tuple[InputError, ...]:
    """What is allowed and yet should be known: objects that can be found, not brought.

    None of a file with faults, which may hide them.

    Raises:
        InputError: if there is no such home or it is not TOML.
    """
    home, faults = inspect_home(name_or_path)
    if home is None or faults:
        return ()
    models = home.models()
    reasons = ((name, why_not_taken(models[name])) for name in home.objects)
    right = "make it smaller or lighter to have it brought"
    return tuple(
        InputError(home.file, f"{name}: it can be found, not brought: {why}", right)
        for name, why in reasons
        if why
    )


def way_faults(home: Home) -> Iterator[Flaw]:
    """Where the robot does not fit or cannot get to."""
    grid = OccupancyGrid.from_home(home)
    needed = FOOTPRINT_M + grid.resolution
    for door in home.doors:
        if door.width < 2 * needed:
            right = f"make its width {2 * needed + grid.resolution:.2f} m or more"
            yield f"the door at {door.position} is too narrow for the robot", right
    try:
        area = reachable(grid, home.robot_start[:2])
    except Unreachable:
        right = f"leave {needed:.2f} m around its middle free"
        yield f"robot_start: the robot does not fit at {home.robot_start[:2]}", right
        return
    for place in (PERSON, DELIVERY, *(piece.name for piece in home.furniture)):
        x, y, _ = home.stand(place)
        key = place if place in (PERSON, DELIVERY) else f"furniture {place}"
        cell = grid.cell((x, y))
        if not grid.is_free(cell):
            right = f"leave {needed:.2f} m around ({x:.2f}, {y:.2f}) free"
            yield f"{key}: there is no room for the robot to stand before it", right
        elif not area[cell]:
            right = f"make a way to ({x:.2f}, {y:.2f}) that is {2 * needed:.2f} m wide"
            yield f"{key}: it cannot be reached from robot_start", right


def _reach_faults(home: Home) -> Iterator[Flaw]:
    """Objects that the arm would not get hold of, were each alone on its furniture."""
    world = PlanningWorld(_around_objects(home))
    models = home.models()
    for name, spot in home.objects.items():
        if not why_not_taken(models[name]) and not _reaches(world, home, models[name]):
            right = "put it nearer to the front of its furniture, or on another board"
            yield f"{name}: it is out of the arm's reach on {spot.furniture}", right
    world.close()


def _around_objects(home: Home) -> Home:
    """The home with only the furniture that may be in the way of reaching for its objects."""
    used = {home.furniture_named(place).pose[:2] for place in home.placement.values()}
    near = tuple(f for f in home.furniture if any(_is_near(f, place) for place in used))
    return home.model_copy(update={"furniture": near})


def _is_near(piece: Furniture, place: tuple[float, float]) -> bool:
    return dist(piece.pose[:2], place) < NEAR_M + max(piece.size[:2])


def _reaches(world: PlanningWorld, home: Home, model: ObjectModel) -> bool:
    """Whether there is a grasp, a place to stand for it, and a motion to it."""
    piece = home.furniture_named(home.objects[model.name].furniture)
    pose = home.object_pose(model.name)
    before = np.array(home.stand(piece.name))
    stances = [
        stance
        for stance in standing_poses(piece, np.asarray(pose.position))
        if plan_stance(world, before, stance)
    ]

    @cache
    def grasps(tilt: float) -> list[Grasp]:
        return find_grasps(model, pose, piece.pose[2] + np.pi, tilt)[:GRASPS_TRIED]

    def options() -> Iterator[tuple[Grasp, Approach]]:
        for tilt in TILTS:
            for stance, grasp, length in product(stances, grasps(tilt), APPROACH_M):
                yield grasp, Approach([stance], grasp.hands, length * grasp.hand.approach)

    return choose_approach(world, FOLDED, options) is not None
