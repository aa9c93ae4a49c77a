"""Random scenes, as the robot's camera may see them, with ground truth.

A scene is a piece of furniture with objects on it, with or without a wall behind and other
furniture beside it. The camera has a pose of the robot when it searches, or a random one. The scene
follows from its seed.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.random import Generator
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from executive.geometry import pose_from
from executive.records import Shape
from executive.types.geometry import Pose, Vector3
from executive.types.perception import Box, Frame
from sim.body.hardware import Hardware
from sim.body.head import aim
from sim.bullet.bodies import PERSON_SHAPES, create_body, create_object
from sim.bullet.camera import LOOKING, pinhole, render
from sim.bullet.client import connect
from sim.bullet.rendering import Rendering
from sim.home.furniture import Furniture, Surface, box
from sim.home.home import STAND_OFF_M, VIEW_DEPTH_M, VIEW_HEIGHT_M
from sim.learning.decor import draw_light, dress, through_the_lens, write_patterns
from sim.objects.objects import ObjectModel
from sim.tools.generation import SIZES

FEWEST_PIXELS = 120
"""An object with fewer visible pixels does not count."""
LEAST_SHARE = 0.35
"""An object does not count either if a smaller fraction of it is visible, because it is occluded or
partly outside the picture."""
WIDE = pinhole(320, 240, 2 * float(np.arctan(2 * np.tan(np.radians(65.0) / 2))))
"""A camera with twice the width of view of LOOKING; one pixel is 4 x 4 pixels of that camera."""
_WIDE_PIXEL = (LOOKING.fx / WIDE.fx) ** 2
_GAPS_M = (0.005, 0.08)
_TRIES = 30
_ROOM = 9.0
_WALL_M = 2.6


@dataclass(frozen=True, slots=True)
class Truth:
    """An object in a picture: its visible pixels, and their number if nothing hid it."""

    name: str
    box: Box
    visible: int
    alone: int
    pose: Pose

    @property
    def counts(self) -> bool:
        """Whether a detector should find it; the same rule holds in training and evaluation."""
        return self.visible >= FEWEST_PIXELS and self.visible >= LEAST_SHARE * self.alone


@dataclass(frozen=True, slots=True, eq=False)
class Scene:
    """A picture and its ground truth.

    Attributes:
        seed: of the scene.
        frame: the picture as rendered, without noise and exposure.
        truths: all objects with at least one visible pixel.
        bodies: (height, width) int32, one plus the index into `truths`; 0 for anything else.
    """

    seed: int
    frame: Frame
    truths: tuple[Truth, ...]
    bodies: NDArray[np.int32]

    def photograph(self) -> NDArray[np.uint8]:
        """The colours (height, width, 3) with random exposure, white balance and noise."""
        return through_the_lens(self.frame.color, np.random.default_rng((self.seed, 1)))


class SceneMaker:
    """Makes scenes in a simulator of its own."""

    def __init__(self, models: Mapping[str, ObjectModel], folder: Path) -> None:
        """Use these objects; patterns are written into the folder."""
        self._models = models
        self._patterns = write_patterns(folder)
        self._client = connect()

    def make(self, seed: int) -> Scene:
        """Make the scene of a seed."""
        chance = np.random.default_rng(seed)
        self._client.resetSimulation()
        piece = _draw_piece(chance, (0.0, 0.0, 0.0))
        self._build_room(piece, chance)
        standing = dict(self._scatter(piece, chance))
        by_body = {
            create_object(self._client, self._models[name], pose): name
            for name, pose in standing.items()
        }
        target = self._target(piece, list(standing.values()), chance)
        pose = self._camera_pose(piece, target, chance)
        seen = render(self._client, pose, LOOKING, light=draw_light(chance))
        frame = Frame(seed, seen.color, seen.depth, LOOKING, pose)
        return Scene(seed, frame, *self._truths(seen, pose, by_body, standing))

    def close(self) -> None:
        """Close the simulator."""
        self._client.disconnect()

    # --- room and objects ---

    def _build_room(self, piece: Furniture, chance: Generator) -> None:
        """Build floor, walls, the furniture and its surroundings."""
        back = -piece.size[0] / 2 - (chance.uniform(0.03, 0.1) if chance.random() < 0.6 else 2.5)
        floor = box((_ROOM, _ROOM, 0.1), (back + _ROOM / 2, 0.0, -0.05), (0.0, 0.0, 0.0, 1.0))
        fixtures: list[tuple[Shape, ...]] = [(floor,), (_wall((0.1, _ROOM), back - 0.05, 0.0),)]
        side = chance.choice([-1, 1]) * chance.uniform(piece.size[1] / 2 + 0.05, 3.0)
        if chance.random() < 0.5:
            fixtures.append((_wall((_ROOM, 0.1), back + _ROOM / 2, side),))
        if chance.random() < 0.15:
            fixtures.append(PERSON_SHAPES)
        for index, shapes in enumerate(fixtures):
            away = Pose((back + 0.4, 1.7 * float(np.sign(side)), 0.0)) if index > 2 else Pose()
            self._put(shapes, away, chance)
        self._put(piece.shapes(), piece.frame(), chance)
        for left in (-1, 1):
            if chance.random() < 0.5:
                beside = _draw_piece(chance, (0.0, 0.0, 0.0))
                gap = chance.uniform(0.05, 0.6) + (piece.size[1] + beside.size[1]) / 2
                x = back + beside.size[0] / 2 + chance.uniform(0.03, 0.3)
                self._put(beside.shapes(), Pose((x, left * gap, 0.0)), chance)

    def _put(self, shapes: tuple[Shape, ...], pose: Pose, chance: Generator) -> None:
        """Create a fixture, in three of four cases with random colours."""
        body = create_body(self._client, shapes, pose)
        if shapes[0].color[0] == 0.0 or chance.random() < 0.75:
            dress(self._client, body, len(shapes), self._patterns, chance)

    def _scatter(self, piece: Furniture, chance: Generator) -> Iterator[tuple[str, Pose]]:
        """Put unknown objects on all surfaces; yield names and poses of known ones for them."""
        names = list(chance.permutation(sorted(self._models)))
        for surface in piece.surfaces():
            taken: list[tuple[float, float, float]] = []
            for _ in range(chance.integers(0, 3)):
                self._put_foreign(piece, surface, taken, chance)
            for _ in range(min(len(names), int(chance.integers(1, 8)))):
                model = self._models[names.pop()]
                if model.size[2] + 0.01 > surface.clearance:
                    continue
                radius = float(np.hypot(*model.size[:2])) / 2
                spot = _free_spot(surface, taken, radius, chance)
                if spot is not None:
                    taken.append((*spot, radius))
                    yaw = chance.uniform(-np.pi, np.pi)
                    turn = (0.0, 0.0, float(np.sin(yaw / 2)), float(np.cos(yaw / 2)))
                    yield model.name, Pose(piece.to_map((*spot, surface.center[2])), turn)

    def _put_foreign(
        self,
        piece: Furniture,
        surface: Surface,
        taken: list[tuple[float, float, float]],
        chance: Generator,
    ) -> None:
        """Put an object that is no class of the detector on a surface: plate, vase or book."""
        kind = chance.choice(["plate", "vase", "book"])
        low, high = {
            "plate": ((0.16, 0.16, 0.012), (0.28, 0.28, 0.03)),
            "vase": ((0.09, 0.09, 0.13), (0.16, 0.16, 0.32)),
            "book": ((0.12, 0.16, 0.012), (0.22, 0.30, 0.04)),
        }[kind]
        x, y, height = chance.uniform(low, high)
        if height + 0.01 > surface.clearance:
            return
        radius = float(np.hypot(x, y)) / 2 if kind == "book" else float(x) / 2
        spot = _free_spot(surface, taken, radius, chance)
        if spot is None:
            return
        taken.append((*spot, radius))
        size = (float(x), float(y) if kind == "book" else float(x), float(height))
        shape = Shape(
            "box" if kind == "book" else "cylinder",
            size,
            (0.0, 0.0, 0.0, 1.0),
            Pose((0.0, 0.0, float(height) / 2)),
        )
        yaw = chance.uniform(-np.pi, np.pi)
        turn = (0.0, 0.0, float(np.sin(yaw / 2)), float(np.cos(yaw / 2)))
        self._put((shape,), Pose(piece.to_map((*spot, surface.center[2])), turn), chance)

    # --- camera ---

    def _target(self, piece: Furniture, things: list[Pose], chance: Generator) -> Vector3:
        """The point to look at: as the robot does when it searches, or at an object."""
        surface = piece.surfaces()[chance.integers(len(piece.surfaces()))]
        x, _, z = surface.center
        usual = (x + surface.length_x / 2 - VIEW_DEPTH_M, 0.0, z + VIEW_HEIGHT_M)
        if things and chance.random() < 0.4:
            usual = things[chance.integers(len(things))].position
        x, y, z = np.asarray(usual) + chance.normal(0.0, 0.06, 3)
        return float(x), float(y), float(z)

    def _camera_pose(self, piece: Furniture, target: Vector3, chance: Generator) -> Pose:
        """The camera's pose: in two of three cases on a robot, which may be in the picture."""
        if chance.random() < 0.33:
            return _free_pose(target, chance)
        ahead = piece.size[0] / 2 + STAND_OFF_M + chance.normal(0.0, 0.04)
        aside = chance.normal(0.0, 0.06 if chance.random() < 0.8 else 0.4)
        yaw = np.pi + chance.normal(0.0, 0.05)
        hardware = Hardware(self._client, (float(ahead), float(aside), float(yaw)))
        for link, angle in zip(("head", "camera_link"), aim(hardware, target), strict=True):
            self._client.resetJointState(hardware.body, hardware.links[link], angle)
        return hardware.link_pose("camera_optical")

    # --- the truth ---

    def _truths(
        self,
        seen: Rendering,
        pose: Pose,
        by_body: Mapping[int, str],
        standing: Mapping[str, Pose],
    ) -> tuple[tuple[Truth, ...], NDArray[np.int32]]:
        self._client.resetSimulation()
        truths: list[Truth] = []
        bodies = np.zeros(seen.segmentation.shape, np.int32)
        for body, name in by_body.items():
            mask = seen.segmentation == body
            if mask.any():
                alone = self._pixels_alone(self._models[name], standing[name], pose)
                visible = int(mask.sum())
                truths.append(Truth(name, extent(mask), visible, alone, standing[name]))
                bodies[mask] = len(truths)
        return tuple(truths), bodies

    def _pixels_alone(self, model: ObjectModel, pose: Pose, eye: Pose) -> int:
        """The number of pixels if nothing hid the object, and the picture were large enough."""
        body = create_object(self._client, model, pose)
        seen = render(self._client, eye, WIDE)
        self._client.removeBody(body)
        return round(float((seen.segmentation == body).sum()) * _WIDE_PIXEL)


def extent(mask: NDArray[np.bool_]) -> Box:
    """The bounding box of a mask, which must not be empty."""
    rows, columns = np.flatnonzero(mask.any(axis=1)), np.flatnonzero(mask.any(axis=0))
    top, left = int(rows[0]), int(columns[0])
    return Box(left, top, int(columns[-1]) - left + 1, int(rows[-1]) - top + 1)


def looking_at(eye: Vector3, target: Vector3, roll: float = 0.0) -> Pose:
    """The pose in `map` of an optical frame at `eye` that looks at `target`; `roll` in radians."""
    forward = np.subtract(target, eye) / np.linalg.norm(np.subtract(target, eye))
    right = np.cross(forward, (0.0, 0.0, 1.0))
    right /= np.linalg.norm(right)
    axes = Rotation.from_matrix(np.column_stack((right, np.cross(forward, right), forward)))
    return pose_from(eye, axes * Rotation.from_euler("z", roll))


def _free_pose(target: Vector3, chance: Generator) -> Pose:
    """A random pose in front of a target, at the eye height of a robot or a person."""
    away, around = chance.uniform(0.55, 1.9), chance.uniform(-1.2, 1.2)
    eye = (
        target[0] + float(away * np.cos(around)),
        target[1] + float(away * np.sin(around)),
        max(target[2] + 0.1, float(chance.uniform(0.8, 1.6))),
    )
    return looking_at(eye, target, float(chance.normal(0.0, 0.05)))


def _draw_piece(chance: Generator, pose: Vector3) -> Furniture:
    kinds = sorted(SIZES)
    kind = kinds[chance.integers(len(kinds))]
    size, boards = SIZES[kind]
    x, y, z = np.asarray(size) * chance.uniform(0.9, 1.12, 3)
    low = z / size[2]
    return Furniture(
        name="piece",
        kind=kind,
        room="room",
        pose=pose,
        size=(float(x), float(y), float(z)),
        boards=tuple(float(board * low) for board in boards),
    )


def _wall(outline: tuple[float, float], x: float, y: float) -> Shape:
    return box((*outline, _WALL_M), (x, y, _WALL_M / 2), (0.0, 0.0, 0.0, 1.0))


def _free_spot(
    surface: Surface,
    taken: list[tuple[float, float, float]],
    radius: float,
    chance: Generator,
) -> tuple[float, float] | None:
    """A random free spot for a circle of `radius` (metres) on a surface; None if none is found."""
    reach = np.array([surface.length_x, surface.length_y]) / 2 - min(radius, 0.08)
    middle = np.array(surface.center[:2])
    if (reach <= 0).any():
        return None
    for _ in range(_TRIES):
        offset = chance.uniform(-reach, reach)
        offset[1] = np.clip(offset[1], -0.7, 0.7)
        x, y = middle + offset
        gap = chance.uniform(*_GAPS_M)
        if all(np.hypot(x - a, y - b) > r + radius + gap for a, b, r in taken):
            return float(x), float(y)
    return None
