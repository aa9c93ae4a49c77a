"""Rooms and doors, and the walls around them."""

from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field

Span = tuple[float, float]
FARTHEST_M = 1000.0
"""Greatest absolute value of x and y; the robot's base can move a little farther."""
Coordinate = Annotated[float, Field(strict=True, ge=-FARTHEST_M, le=FARTHEST_M)]
"""x or y of a point in `map` in a home file (metres)."""
Length = Annotated[float, Field(strict=True, gt=0.0, le=100.0)]
"""A length in a home file (metres)."""


class Room(BaseModel):
    """A room with walls along the edges of its rectangle; neighbours share the wall between."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)

    name: str
    label: str = ""
    """The robot's word for it in speech; empty: derived from its name."""
    kind: str
    """Its class in the ontology."""
    rectangle: tuple[Coordinate, Coordinate, Coordinate, Coordinate]
    """Left, lower, right and upper edge in `map` (metres)."""

    def holds(self, x: float, y: float) -> bool:
        """Whether a point (metres, in `map`) is in the room."""
        left, lower, right, upper = self.rectangle
        return left <= x <= right and lower <= y <= upper

    def overlaps(self, other: "Room") -> bool:
        """Whether the rooms have more than an edge in common."""
        left, lower, right, upper = self.rectangle
        a, b, c, d = other.rectangle
        return max(left, a) < min(right, c) and max(lower, b) < min(upper, d)


class Door(BaseModel):
    """A gap in a wall, from floor to ceiling."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)

    position: tuple[Coordinate, Coordinate]
    """Its centre, on the line of a wall (metres, in `map`)."""
    width: Length


@dataclass(frozen=True, slots=True)
class Wall:
    """A straight piece of wall without gaps, seen from above (metres, in `map`)."""

    center: tuple[float, float]
    size: tuple[float, float]


def walls(rooms: tuple[Room, ...], doors: tuple[Door, ...], thickness: float) -> tuple[Wall, ...]:
    """The pieces of wall between the doors.

    Pieces are extended by half a wall at the corners of rooms, so that corners are closed.
    """
    pieces = []
    for (axis, offset), spans in wall_lines(rooms).items():
        gaps = [
            (door.position[1 - axis] - door.width / 2, door.position[1 - axis] + door.width / 2)
            for door in doors
            if abs(door.position[axis] - offset) < thickness / 2
        ]
        for start, end in _without(_joined(spans), gaps):
            grown = _grown((start, end), spans, thickness)
            pieces.append(_wall(axis, offset, grown, thickness))
    return tuple(pieces)


def wall_axis(door: Door, lines: "Lines") -> int | None:
    """The fixed coordinate of the wall that contains a door: 0 (x) or 1 (y); None if none does."""
    for axis in (0, 1):
        along, half = door.position[1 - axis], door.width / 2
        for start, end in _joined(lines.get((axis, door.position[axis]), ())):
            if start <= along - half and along + half <= end:
                return axis
    return None


def doors_between(rooms: tuple[Room, ...], doors: tuple[Door, ...]) -> dict[Door, tuple[str, str]]:
    """The names of the two rooms at each door; doors to the outside are left out."""
    sides = {door: _rooms_beside(door, rooms) for door in doors}
    return {door: (found[0], found[1]) for door, found in sides.items() if len(found) == 2}


def _rooms_beside(door: Door, rooms: tuple[Room, ...]) -> list[str]:
    x, y = door.position
    return [
        room.name
        for room in rooms
        if room.holds(x, y)  # on its edge; at a corner of three rooms no door can be
    ]


Lines = Mapping[tuple[int, float], Sequence[Span]]


def wall_lines(rooms: tuple[Room, ...]) -> Lines:
    """Spans of wall by line, which is (axis, offset): axis 0 has x fixed, axis 1 has y fixed."""
    lines: dict[tuple[int, float], list[Span]] = defaultdict(list)
    for room in rooms:
        left, lower, right, upper = room.rectangle
        for x in (left, right):
            lines[0, x].append((lower, upper))
        for y in (lower, upper):
            lines[1, y].append((left, right))
    return lines


def _joined(spans: Sequence[Span]) -> list[Span]:
    joined: list[Span] = []
    for start, end in sorted(spans):
        if joined and start <= joined[-1][1]:
            joined[-1] = (joined[-1][0], max(end, joined[-1][1]))
        else:
            joined.append((start, end))
    return joined


def _without(spans: list[Span], gaps: list[Span]) -> list[Span]:
    for low, high in gaps:
        spans = [
            piece
            for start, end in spans
            for piece in ((start, min(end, low)), (max(start, high), end))
            if piece[1] > piece[0]
        ]
    return spans


def _grown(piece: Span, spans: Sequence[Span], thickness: float) -> Span:
    """A piece of wall, extended by half a wall's thickness at ends that are corners of rooms."""
    corners = {end for span in spans for end in span}
    start, end = piece
    half = thickness / 2
    return start - half * (start in corners), end + half * (end in corners)


def _wall(axis: int, offset: float, span: Span, thickness: float) -> Wall:
    middle, length = (span[0] + span[1]) / 2, span[1] - span[0]
    if axis == 0:
        return Wall((offset, middle), (thickness, length))
    return Wall((middle, offset), (length, thickness))
