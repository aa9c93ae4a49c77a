"""The home: rooms, doors, furniture, and where things, the person and the robot are in it.

A home is a TOML file; `homes/four_rooms.toml` shows every key. Its frame is `map`.
"""

import math
import tomllib
from collections import Counter
from collections.abc import Iterator, Mapping
from importlib.resources import files
from itertools import combinations
from pathlib import Path
from typing import Annotated, Any, Self

from pydantic import (
    BaseModel,
    BeforeValidator,
    ConfigDict,
    Field,
    PositiveFloat,
    ValidationError,
)
from pydantic_core import ErrorDetails

from executive.errors import InputError
from executive.types import Place, Pose, Vector3
from sim.floorplan import Door, Room, Wall, wall_axis, walls
from sim.furniture import FORM_OF_KIND, Furniture, PlanarPose, PoseInDegrees, Surface
from sim.objects import load_objects
from sim.spots import NoRoomError, Spot, Standing, arrange

__all__ = ["DELIVERY", "PERSON", "Furniture", "Home", "PlanarPose", "Surface", "load_home"]

Fault = tuple[str, str]
"""What is wrong, and what would be right."""

PERSON = "person"
DELIVERY = "delivery"
STAND_OFF_M = 0.62
"""From the front edge of a piece of furniture to the middle of the robot that uses it."""
TALKING_DISTANCE_M = 0.9
"""From the middle of the person to the middle of the robot that talks to them."""
FLOOR_VIEWS = 5
"""How many looks it takes to see the floor all around the robot."""
FACE_HEIGHT_M = 1.55
LARGEST_M = 200.0
"""A home that is longer was not meant in metres."""
VIEW_DEPTH_M = 0.17
"""Behind the front edge of a surface, where the camera looks."""
VIEW_HEIGHT_M = 0.06
"""Above a surface, where the camera looks."""


def _as_spot(value: Any) -> Any:
    return {"furniture": value} if isinstance(value, str) else value


class Home(BaseModel):
    """A home as its file describes it; made by `load_home`."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)

    name: str
    wall_height: PositiveFloat = 2.4
    wall_thickness: PositiveFloat = 0.1
    robot_start: PoseInDegrees
    person: PoseInDegrees
    """Where the person is, and where they look."""
    rooms: Annotated[tuple[Room, ...], Field(min_length=1)]
    doors: tuple[Door, ...] = ()
    furniture: tuple[Furniture, ...]
    delivery: Furniture
    """The table where brought things go; it is not searched."""
    objects: dict[str, Annotated[Spot, BeforeValidator(_as_spot)]] = Field(default_factory=dict)

    @property
    def placement(self) -> dict[str, str]:
        """Name of the furniture that each object is on, in the file's order."""
        return {name: spot.furniture for name, spot in self.objects.items()}

    def places(self) -> tuple[Place, ...]:
        """The searchable furniture, in the file's order."""
        kinds = {room.name: room.kind for room in self.rooms}
        return tuple(Place(f.name, f.kind, f.room, kinds[f.room]) for f in self.furniture)

    def extent(self) -> tuple[float, float, float, float]:
        """Left, lower, right and upper edge of all rooms, in `map` (metres)."""
        left, lower, right, upper = zip(*(room.rectangle for room in self.rooms), strict=True)
        return min(left), min(lower), max(right), max(upper)

    def walls(self) -> tuple[Wall, ...]:
        """The walls without the doors' gaps, in `map`."""
        return walls(self.rooms, self.doors, self.wall_thickness)

    def furniture_named(self, name: str) -> Furniture:
        """A piece of furniture, or the delivery table.

        Raises:
            InputError: if there is none of this name.
        """
        pieces = {piece.name: piece for piece in (*self.furniture, self.delivery)}
        if name not in pieces:
            known = "it has " + ", ".join(pieces)
            raise InputError(f"home {self.name}", f"there is no furniture {name!r}", known)
        return pieces[name]

    def stand(self, place: str) -> PlanarPose:
        """Where the robot stands to use a piece of furniture, or to talk to the `person`.

        It faces the front of the furniture, STAND_OFF_M away from the edge.

        Raises:
            InputError: if there is no such place.
        """
        if place == PERSON:
            (x, y, yaw), ahead = self.person, TALKING_DISTANCE_M
        else:
            piece = self.furniture_named(place)
            (x, y, yaw), ahead = piece.pose, piece.size[0] / 2 + STAND_OFF_M
        facing = math.remainder(yaw + math.pi, math.tau)
        return x + ahead * math.cos(yaw), y + ahead * math.sin(yaw), facing

    def object_pose(self, name: str) -> Pose:
        """Where an object's frame is in `map` at the start.

        Raises:
            InputError: if the object is not in this home.
        """
        if name not in self.objects:
            known = "it has " + ", ".join(self.objects)
            raise InputError(f"home {self.name}", f"there is no object {name!r}", known)
        piece = self.furniture_named(self.objects[name].furniture)
        standing = self.arrangement()[name]
        yaw = piece.pose[2] + standing.yaw
        position = piece.to_map((standing.x, standing.y, standing.z))
        return Pose(position, (0.0, 0.0, math.sin(yaw / 2), math.cos(yaw / 2)))

    def view_targets(self, place: str) -> tuple[Vector3, ...]:
        """Points to look at, from where the robot stands, to see all that stands on a place.

        One for each of its surfaces, the handiest first; for the `person`, their face.

        Raises:
            InputError: if there is no such place.
        """
        if place == PERSON:
            return ((self.person[0], self.person[1], FACE_HEIGHT_M),)
        piece = self.furniture_named(place)
        return tuple(
            piece.to_map((x + surface.length_x / 2 - VIEW_DEPTH_M, 0.0, z + VIEW_HEIGHT_M))
            for surface in piece.surfaces()
            for x, _, z in (surface.center,)
        )

    def with_placement(self, placement: Mapping[str, str]) -> Self:
        """This home with some objects on other furniture.

        Raises:
            InputError: if an object or a piece of furniture is unknown, or there is no room for it.
        """
        spots = {name: Spot(furniture=where) for name, where in placement.items()}
        home = self.model_copy(update={"objects": {**self.objects, **spots}})
        for fault in (*_object_faults(home), *_spot_faults(home)):
            raise InputError("--place", *fault)
        return home

    def arrangement(self) -> dict[str, Standing]:
        """Where each object's frame is in the frame of its furniture at the start."""
        surfaces = {f.name: f.surfaces() for f in (*self.furniture, self.delivery)}
        return arrange(self.objects, surfaces, load_objects())


def load_home(name_or_path: str) -> Home:
    """Read a home: the name of a packaged one, or a TOML file.

    Raises:
        InputError: if there is no such home or something in it is wrong, naming file and key.
    """
    home, faults = inspect_home(name_or_path)
    if home is None or faults:
        raise faults[0]
    return home


def inspect_home(name_or_path: str) -> tuple[Home | None, tuple[InputError, ...]]:
    """Read a home and all that is wrong in its file; no home if it does not have the right form.

    Raises:
        InputError: if there is no such home or it is not TOML.
    """
    text, where = _read(name_or_path)
    try:
        data = {"name": Path(where).stem, **tomllib.loads(text)}
    except tomllib.TOMLDecodeError as error:
        raise InputError(where, f"this is not TOML: {error}") from None
    try:
        home = Home.model_validate(data)
    except ValidationError as error:
        return None, tuple(_input_error(where, data, fault) for fault in error.errors())
    return home, tuple(InputError(where, *fault) for fault in home_faults(home))


def home_text(name_or_path: str) -> str:
    """The file of a home, as `load_home` reads it.

    Raises:
        InputError: if there is no such home.
    """
    return _read(name_or_path)[0]


def packaged_homes() -> tuple[str, ...]:
    """Names of the homes that come with the project."""
    entries = files("sim").joinpath("homes").iterdir()
    return tuple(sorted(e.name.removesuffix(".toml") for e in entries if e.name.endswith(".toml")))


def _read(name_or_path: str) -> tuple[str, str]:
    """The text of a home, and what to call its file in messages."""
    if not name_or_path.endswith(".toml"):
        if name_or_path in packaged_homes():
            file = files("sim").joinpath("homes", f"{name_or_path}.toml")
            return file.read_text(encoding="utf-8"), file.name
        known = f"packaged are {', '.join(packaged_homes())}; or give the path of a .toml file"
        raise InputError(f"home {name_or_path}", "there is no home of this name", known)
    try:
        return Path(name_or_path).read_text(encoding="utf-8"), name_or_path
    except (OSError, UnicodeDecodeError) as error:
        why = error.strerror if isinstance(error, OSError) else "it is not UTF-8 text"
        known = f"packaged are {', '.join(packaged_homes())}"
        raise InputError(name_or_path, f"cannot read this home: {why}", known) from None


def _input_error(where: str, data: Any, fault: ErrorDetails) -> InputError:
    """One of pydantic's complaints, with the key as the file has it."""
    key = _key(data, fault["loc"])
    if fault["type"] == "extra_forbidden":
        return InputError(where, f"there is no key {key}", "see sim/homes/four_rooms.toml")
    if fault["type"] == "missing":
        return InputError(where, f"{key} is missing", "see sim/homes/four_rooms.toml")
    return InputError(where, f"{key} is {fault['input']!r}", fault["msg"].lower())


def _key(data: Any, path: tuple[str | int, ...]) -> str:
    """A path into the file as a person would put it: `furniture.desk.size.0`."""
    words = []
    for part in path:
        try:
            data = data[part]
        except (KeyError, IndexError, TypeError):
            data = None
        name = data.get("name") if isinstance(part, int) and isinstance(data, dict) else None
        words.append(str(part if name is None else name))
    return ".".join(words)


def home_faults(home: Home) -> Iterator[Fault]:
    """All that is wrong; what follows only from an earlier fault is left out."""
    unbuildable = [*_room_faults(home), *_furniture_faults(home)]
    yield from unbuildable
    yield from _layout_faults(home)
    yield from _object_faults(home)
    if not unbuildable:
        yield from _spot_faults(home)


def _room_faults(home: Home) -> Iterator[Fault]:
    for room in home.rooms:
        left, lower, right, upper = room.rectangle
        if left >= right or lower >= upper:
            yield f"room {room.name} has no area", "give left, lower, right and upper edge"
    left, lower, right, upper = home.extent()
    if max(right - left, upper - lower) > LARGEST_M:
        yield f"the rooms span more than {LARGEST_M:g} m", "give metres"
    yield from _twice("room", [room.name for room in home.rooms])
    for door in home.doors:
        if wall_axis(door, home.rooms) is None:
            on_edge = "put its middle on the edge of a room, away from the corners"
            yield f"the door at {door.position} is not in a wall", on_edge


def _furniture_faults(home: Home) -> Iterator[Fault]:
    yield from _twice("furniture", [PERSON, DELIVERY, *(f.name for f in home.furniture)])
    if home.delivery.name != DELIVERY:
        yield f"the delivery table is named {home.delivery.name}", f"name it {DELIVERY}"
    rooms = [room.name for room in home.rooms]
    for piece in (*home.furniture, home.delivery):
        of = f"furniture {piece.name}"
        if piece.room not in rooms:
            yield f"{of}: no room {piece.room!r}", f"rooms: {', '.join(rooms)}"
        if piece.form is None and piece.kind not in FORM_OF_KIND:
            known = f"known are {', '.join(FORM_OF_KIND)}; or give its form"
            yield f"{of}: cannot build kind {piece.kind!r}", known
        elif max(piece.boards, default=0.0) >= piece.size[2]:
            yield f"{of}: a board is above its top", f"below {piece.size[2]} m"
        elif min(length for shape in piece.shapes() for length in shape.size) <= 0:
            yield f"{of}: too small or too low to be built", "make it larger"
        elif not piece.surfaces():
            yield f"{of}: nothing can stand on it", "give its boards"


def _layout_faults(home: Home) -> Iterator[Fault]:
    for room, neighbour in combinations(home.rooms, 2):
        if room.overlaps(neighbour):
            yield f"room {room.name} and {neighbour.name} overlap", "let them share an edge at most"
    rooms = {room.name: room for room in home.rooms}
    pieces = (*home.furniture, home.delivery)
    for piece in pieces:
        here = rooms.get(piece.room)
        if here and not all(here.holds(x, y) for x, y in piece.corners()):
            yield f"furniture {piece.name}: it sticks out of room {here.name}", "move it inside"
    for one, other in combinations(pieces, 2):
        if one.overlaps(other):
            yield f"furniture {one.name} and {other.name} overlap", "move one of them"


def _object_faults(home: Home) -> Iterator[Fault]:
    models = load_objects()
    furniture = [*(f.name for f in home.furniture), DELIVERY]
    for name, spot in home.objects.items():
        if name not in models:
            yield f"there is no object {name!r}", f"objects: {', '.join(models)}"
        if spot.furniture not in furniture:
            where = f"furniture: {', '.join(furniture)}"
            yield f"{name}: there is no furniture {spot.furniture!r}", where


def _spot_faults(home: Home) -> Iterator[Fault]:
    """Objects for which there is no room; those named otherwise are left out."""
    furniture = [*(f.name for f in home.furniture), DELIVERY]
    models = load_objects()
    left = {n: s for n, s in home.objects.items() if n in models and s.furniture in furniture}
    while True:
        try:
            home.model_copy(update={"objects": left}).arrangement()
        except NoRoomError as error:
            yield f"{error.name}: {error}", "choose another place for it"
            del left[error.name]
        else:
            return


def _twice(what: str, names: list[str]) -> Iterator[Fault]:
    for name, count in Counter(names).items():
        if count > 1:
            yield f"{what} {name!r} is there twice", "give each its own name"
