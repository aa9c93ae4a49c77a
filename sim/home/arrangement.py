"""Arranges objects on furniture at the start: at given spots, or side by side."""

import math
from collections import defaultdict
from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass
from typing import Annotated, Self

from pydantic import AfterValidator, BaseModel, ConfigDict, NonNegativeInt

from sim.home.floorplan import Coordinate
from sim.home.furniture import Degrees, Surface
from sim.objects.objects import ObjectModel

GAP_M = 0.12
"""Least gap between the outlines of neighbours, for the fingers of a hand."""
FRONT_M = 0.13
"""Distance from the front edge to the centre of an object, for the reach of the arm."""
MARGIN_M = 0.02
"""Least distance from the outline of an object to the edge of its surface."""
SIDE_M = 0.5
"""How far the row extends left and right of the centre, where the robot stands."""
STEP_M = 0.01
"""Distance between the positions that are tried."""
HEADROOM_M = 0.05
"""Least free height above an object under a board."""


class Spot(BaseModel):
    """Where an object is: on which furniture and, optionally, where on it."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)

    furniture: str
    surface: NonNegativeInt | None = None
    """Index in the furniture's `surfaces`; None: the first that the object fits on."""
    at: tuple[Coordinate, Coordinate] | None = None
    """x (to the front) and y (to the left) from the centre of the surface (metres)."""
    yaw: Annotated[Degrees, AfterValidator(math.radians)] = 0.0
    """Yaw of the object in the furniture frame (degrees in the file, radians here)."""

    def moved(self, furniture: str) -> Self:
        """A copy on other furniture, at no particular spot."""
        there = {"furniture": furniture, "surface": None, "at": None, "yaw": 0.0}
        return self.model_copy(update=there)

    def at_spot(self, spot: "Spot") -> Self:
        """A copy at another spot."""
        there = {"furniture": spot.furniture, "surface": spot.surface}
        return self.model_copy(update={**there, "at": spot.at, "yaw": spot.yaw})


@dataclass(frozen=True, slots=True)
class Standing:
    """The pose of an object's frame in the frame of its furniture (metres, radians)."""

    surface: int
    x: float
    y: float
    z: float
    yaw: float


class NoRoomError(Exception):
    """There is no room for an object on its furniture; `name` is the object."""

    def __init__(self, name: str, reason: str) -> None:
        """The object has no room, for a reason, which is the message."""
        super().__init__(reason)
        self.name = name


@dataclass(frozen=True, slots=True)
class _Outline:
    """The bounding rectangle of an object or a surface, seen from above (metres)."""

    back: float
    front: float
    right: float
    left: float

    def moved(self, x: float, y: float) -> "_Outline":
        return _Outline(self.back + x, self.front + x, self.right + y, self.left + y)

    def holds(self, other: "_Outline") -> bool:
        return (
            self.back <= other.back
            and other.front <= self.front
            and self.right <= other.right
            and other.left <= self.left
        )

    def is_apart(self, other: "_Outline", gap: float) -> bool:
        return (
            max(self.back - other.front, other.back - self.front) >= gap
            or max(self.right - other.left, other.right - self.left) >= gap
        )


def arrange(
    spots: Mapping[str, Spot],
    surfaces: Mapping[str, tuple[Surface, ...]],
    models: Mapping[str, ObjectModel],
    left: Collection[str] = (),
) -> dict[str, Standing]:
    """Find a pose for every object.

    Objects with `at` stand there. The others follow in their order: each takes the free spot
    nearest to the centre of the front of the first surface that has one. So moving one object does
    not affect those before it.

    Args:
        spots: the wanted spots, by object.
        surfaces: the surfaces of the furniture, by its name.
        models: the models, by object.
        left: objects that were left at their spot; they stay even if there is too little room.

    Raises:
        NoRoomError: if an object does not fit.
    """
    standing: dict[str, Standing] = {}
    taken: dict[tuple[str, int], list[_Outline]] = defaultdict(list)
    for name, spot in sorted(spots.items(), key=lambda item: item[1].at is None):
        outline = _outline(models[name], spot.yaw)
        height = models[name].size[2]
        gap = GAP_M if spot.at is None else 0.0
        as_left = name in left and spot.at is not None
        for place in _candidates(spot, surfaces[spot.furniture], outline, height, as_left):
            row = taken[spot.furniture, place.surface]
            there = outline.moved(place.x, place.y)
            if as_left or all(there.is_apart(other, gap) for other in row):
                row.append(there)
                standing[name] = place
                break
        else:
            where = "no spot is left for it" if spot.at is None else f"it does not fit at {spot.at}"
            raise NoRoomError(name, f"{where} on {spot.furniture}")
    return standing


def _candidates(
    spot: Spot, surfaces: tuple[Surface, ...], outline: _Outline, height: float, as_left: bool
) -> Iterator[Standing]:
    """The poses of an object on otherwise empty furniture, the best first."""
    for index, surface in enumerate(surfaces):
        if spot.surface not in (None, index):
            continue
        if surface.clearance < height + HEADROOM_M and not as_left:
            continue
        x, y, z = surface.center
        half_x, half_y = surface.length_x / 2, surface.length_y / 2 - MARGIN_M
        area = _Outline(x - half_x, x + half_x, y - half_y, y + half_y)
        if spot.at is not None:
            positions = [(x + spot.at[0], y + spot.at[1])]
        else:
            inset = max(FRONT_M, outline.front + MARGIN_M)
            positions = [(area.front - inset, offset) for offset in _middle_out(outline)]
        for position in positions:
            if as_left or area.holds(outline.moved(*position)):
                yield Standing(index, *position, z, spot.yaw)


def _middle_out(outline: _Outline) -> Iterator[float]:
    """Offsets along y that keep the outline within SIDE_M, those nearest to the centre first."""
    for step in range(int(SIDE_M / STEP_M) + 1):
        for offset in (step * STEP_M, -step * STEP_M):
            if outline.right + offset >= -SIDE_M and outline.left + offset <= SIDE_M:
                yield offset


def _outline(model: ObjectModel, yaw: float) -> _Outline:
    cos, sin = math.cos(yaw), math.sin(yaw)
    (x0, y0, _), (x1, y1, _) = model.lower, model.upper
    corners = [(x * cos - y * sin, x * sin + y * cos) for x in (x0, x1) for y in (y0, y1)]
    along, across = zip(*corners, strict=True)
    return _Outline(min(along), max(along), min(across), max(across))
