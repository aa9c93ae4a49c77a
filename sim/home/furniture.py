"""The shapes of furniture, and the surfaces that objects can stand on.

The furniture frame has its origin on the floor at the centre of the piece; x points out of its
front, the side from which it is used; z points up.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from typing import Annotated, Literal

from pydantic import AfterValidator, BaseModel, ConfigDict, Field

from executive.colors import Color
from executive.geometry import heading
from executive.records import Shape
from executive.types.geometry import Pose, Vector3
from sim.home.floorplan import Coordinate, Length

PlanarPose = tuple[float, float, float]
"""x and y (metres) and yaw (radians) in `map`."""
Form = Literal["table", "case", "fridge", "sofa", "bed"]

FORM_OF_KIND: dict[str, Form] = {
    "Table": "table",
    "DiningTable": "table",
    "CoffeeTable": "table",
    "SideTable": "table",
    "Desk": "table",
    "Wagon": "table",
    "Counter": "case",
    "Dresser": "case",
    "Nightstand": "case",
    "TvStand": "case",
    "Cabinet": "case",
    "Bookshelf": "case",
    "Shelf": "case",
    "Sideboard": "case",
    "Refrigerator": "fridge",
    "Sofa": "sofa",
    "Bed": "bed",
}
"""The default form of each ontology class; a home file can give another."""

OPEN = math.inf
PANEL_M = 0.03
LEG_M = 0.05

OAK: Color = (0.72, 0.53, 0.34, 1.0)
WALNUT: Color = (0.45, 0.30, 0.20, 1.0)
WHITE: Color = (0.90, 0.90, 0.88, 1.0)
STEEL: Color = (0.62, 0.64, 0.66, 1.0)
LINEN: Color = (0.83, 0.80, 0.73, 1.0)
FABRIC: Color = (0.36, 0.45, 0.52, 1.0)
COLOR_OF_KIND: dict[str, Color] = {
    "Desk": WALNUT,
    "Wagon": STEEL,
    "Cabinet": WHITE,
    "Bookshelf": WALNUT,
    "Refrigerator": WHITE,
    "Sofa": FABRIC,
}


@dataclass(frozen=True, slots=True)
class Surface:
    """A level area that objects can stand on, in the furniture frame (metres).

    Attributes:
        center: its centre.
        length_x: from front to back.
        length_y: from side to side.
        clearance: free height above it; infinite if open.
    """

    center: Vector3
    length_x: float
    length_y: float
    clearance: float


@dataclass(frozen=True, slots=True)
class Build:
    """The solid parts of a piece of furniture, and its surfaces, the easiest to reach first."""

    shapes: tuple[Shape, ...]
    surfaces: tuple[Surface, ...]


def _yaw_in_radians(pose: PlanarPose) -> PlanarPose:
    x, y, degrees = pose
    return x, y, math.radians(degrees)


Degrees = Annotated[float, Field(strict=True, ge=-3600.0, le=3600.0)]
PoseInDegrees = Annotated[tuple[Coordinate, Coordinate, Degrees], AfterValidator(_yaw_in_radians)]
"""A PlanarPose; its yaw is in degrees in the file, and in radians once it is read."""


class Furniture(BaseModel):
    """A piece of furniture that objects can be on or in; `pose` is its frame in `map`."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)

    name: str
    label: str = ""
    """The robot's word for it in speech; empty: derived from its name."""
    kind: str
    """Its class in the ontology."""
    room: str
    pose: PoseInDegrees
    size: tuple[Length, Length, Length]
    """Depth, width and height over all (metres)."""
    boards: Annotated[tuple[Length, ...], Field(max_length=8)] = ()
    """Heights of its boards below the top, or of a sofa's seat (metres)."""
    form: Form | None = None
    """Its form; None: that of its kind."""

    @property
    def _build(self) -> "Build":
        color = COLOR_OF_KIND.get(self.kind, OAK)
        return build(self.form or FORM_OF_KIND[self.kind], self.size, self.boards, color)

    def shapes(self) -> tuple[Shape, ...]:
        """Its solid parts, in the furniture frame."""
        return self._build.shapes

    def surfaces(self) -> tuple[Surface, ...]:
        """Where objects can stand, in the furniture frame, the easiest to reach first."""
        return self._build.surfaces

    def to_map(self, point: Vector3) -> Vector3:
        """Transform a point from the furniture frame to `map` (metres)."""
        x, y, yaw = self.pose
        cos, sin = math.cos(yaw), math.sin(yaw)
        return x + cos * point[0] - sin * point[1], y + sin * point[0] + cos * point[1], point[2]

    def from_map(self, point: Vector3) -> Vector3:
        """Transform a point from `map` to the furniture frame (metres)."""
        x, y, yaw = self.pose
        cos, sin = math.cos(yaw), math.sin(yaw)
        east, north = point[0] - x, point[1] - y
        return cos * east + sin * north, cos * north - sin * east, point[2]

    def is_below(self, point: Vector3) -> bool:
        """Whether a point of `map` (metres) is inside the outline on the floor, at any height."""
        ahead, left, _ = self.from_map(point)
        return abs(ahead) <= self.size[0] / 2 and abs(left) <= self.size[1] / 2

    def frame(self) -> Pose:
        """Its frame in `map`."""
        x, y, yaw = self.pose
        return Pose((x, y, 0.0), heading(yaw))

    def corners(self) -> tuple[tuple[float, float], ...]:
        """The four corners of its outline on the floor, in order around it, in `map` (metres)."""
        x, y = self.size[0] / 2, self.size[1] / 2
        points = ((x, y, 0.0), (-x, y, 0.0), (-x, -y, 0.0), (x, -y, 0.0))
        return tuple(self.to_map(point)[:2] for point in points)


@cache
def build(form: Form, size: Vector3, boards: tuple[float, ...], color: Color) -> Build:
    """Build a piece of furniture.

    Args:
        form: which kind of construction.
        size: overall depth (x), width (y) and height (z), metres.
        boards: heights of the upper sides of the boards below the top (table, case) or of the open
            compartments (fridge), metres above the floor.
        color: of its main parts.
    """
    return _BUILDERS[form](size, tuple(sorted(boards, reverse=True)), color)


def box(size: Vector3, center: Vector3, color: Color) -> Shape:
    """A box with its centre at `center` (metres)."""
    return Shape("box", size, color, Pose(center))


def _slab(size: Vector3, top: float, color: Color) -> Shape:
    """A board with the depth and width of `size`, and its upper side at height `top`."""
    return box((size[0], size[1], PANEL_M), (0.0, 0.0, top - PANEL_M / 2), color)


def _shaded(color: Color, factor: float) -> Color:
    red, green, blue, opacity = color
    return red * factor, green * factor, blue * factor, opacity


def _board_surfaces(
    boards: tuple[float, ...], ceiling: float, length_x: float, length_y: float
) -> tuple[Surface, ...]:
    """The surfaces of boards, from the highest to the lowest; `ceiling` is above all (metres)."""
    surfaces = []
    for height in boards:
        surfaces.append(Surface((0.0, 0.0, height), length_x, length_y, ceiling - height))
        ceiling = height - PANEL_M
    return tuple(surfaces)


def _table(size: Vector3, boards: tuple[float, ...], color: Color) -> Build:
    depth, width, height = size
    leg_height = height - PANEL_M
    legs = tuple(
        box(
            (LEG_M, LEG_M, leg_height),
            (x * (depth - LEG_M) / 2, y * (width - LEG_M) / 2, leg_height / 2),
            _shaded(color, 0.8),
        )
        for x in (-1, 1)
        for y in (-1, 1)
    )
    slabs = tuple(_slab(size, top, color) for top in (height, *boards))
    shelves = _board_surfaces(boards, leg_height, depth - 2 * LEG_M, width - 2 * LEG_M)
    return Build(slabs + legs, (Surface((0.0, 0.0, height), depth, width, OPEN), *shelves))


def _case(size: Vector3, boards: tuple[float, ...], color: Color) -> Build:
    depth, width, height = size
    inner = (depth, width - 2 * PANEL_M, height)
    parts = [_slab(size, height, _shaded(color, 0.85))]
    parts += [_slab(inner, top, color) for top in boards]
    side = (depth, PANEL_M, height - PANEL_M)
    parts += [
        box(side, (0.0, y * (width - PANEL_M) / 2, side[2] / 2), _shaded(color, 0.93))
        for y in (-1, 1)
    ]
    back = (PANEL_M, inner[1], height - PANEL_M)
    parts.append(box(back, (-(depth - PANEL_M) / 2, 0.0, back[2] / 2), _shaded(color, 0.75)))
    if boards:
        plinth = boards[-1] - PANEL_M
        parts.append(
            box((depth - 0.06, inner[1], plinth), (-0.03, 0.0, plinth / 2), _shaded(color, 0.6))
        )
    shelves = _board_surfaces(boards, height - PANEL_M, depth - 2 * PANEL_M, inner[1])
    return Build(tuple(parts), (Surface((0.0, 0.0, height), depth, width, OPEN), *shelves))


def _fridge(size: Vector3, boards: tuple[float, ...], color: Color) -> Build:
    """A fridge, closed below the lowest board, and open in front above; its top is not used."""
    depth, width, height = size
    carcass = _case(size, boards, color)
    freezer = min(boards, default=height) - PANEL_M
    front = box((PANEL_M, width, freezer), ((depth - PANEL_M) / 2, 0.0, freezer / 2), color)
    handle = box((0.02, width * 0.5, 0.02), (depth / 2 + 0.01, 0.0, freezer - 0.06), STEEL)
    return Build((*carcass.shapes, front, handle), carcass.surfaces[1:])


def _sofa(size: Vector3, boards: tuple[float, ...], color: Color) -> Build:
    depth, width, height = size
    seat = boards[0] if boards else 0.42
    arm, back = 0.18, 0.22
    inner = width - 2 * arm
    dark = _shaded(color, 0.85)
    parts = (
        box((depth, inner, seat), (0.0, 0.0, seat / 2), color),
        box((back, width, height), (-(depth - back) / 2, 0.0, height / 2), dark),
        *(
            box(
                (depth - back, arm, seat + 0.16),
                (back / 2, y * (width - arm) / 2, (seat + 0.16) / 2),
                dark,
            )
            for y in (-1, 1)
        ),
    )
    return Build(parts, (Surface((back / 2, 0.0, seat), depth - back, inner, OPEN),))


def _bed(size: Vector3, boards: tuple[float, ...], color: Color) -> Build:
    """A bed along y, with its head to the right; it is used from a long side."""
    depth, width, height = size
    frame = height * 0.6
    head, pillow = 0.05, 0.45
    right = -width / 2
    mattress = (depth - 0.04, width - head - 0.02, height - frame)
    parts = (
        box((depth, width, frame), (0.0, 0.0, frame / 2), color),
        box(mattress, (0.0, head / 2, (height + frame) / 2), LINEN),
        box((depth, head, height + 0.4), (0.0, right + head / 2, (height + 0.4) / 2), color),
        box((0.6, 0.38, 0.1), (0.0, right + head + 0.23, height + 0.05), WHITE),
    )
    middle = (head + pillow) / 2
    free = Surface((0.0, middle, height), mattress[0], width - head - pillow, OPEN)
    return Build(parts, (free,))


_BUILDERS: dict[Form, Callable[[Vector3, tuple[float, ...], Color], Build]] = {
    "table": _table,
    "case": _case,
    "fridge": _fridge,
    "sofa": _sofa,
    "bed": _bed,
}
