"""The home: rooms, doors, furniture, and where things, the person and the robot are in it.

A home is a TOML file; `homes/four_rooms.toml` shows every key. Its frame is `map`.
"""

import math
from collections.abc import Mapping
from functools import cache, lru_cache
from importlib.resources import files
from itertools import islice
from pathlib import Path
from typing import Annotated, Any, Self

from pydantic import BaseModel, ConfigDict, Field, PrivateAttr, ValidationError
from pydantic_core import ErrorDetails

from executive.errors import InputError
from executive.files import decoded, read_bytes
from executive.geometry import heading
from executive.toml_file import MOST_BYTES, in_words, packaged, parse_toml, shown
from executive.types import DELIVERY, PERSON, Place, Pose, Thing, Vector3
from sim.home.arrangement import Spot, Standing, arrange
from sim.home.floorplan import FARTHEST_M, Door, Length, Room, Wall, walls
from sim.home.furniture import Furniture, PlanarPose, PoseInDegrees, Surface
from sim.home.naming import usable
from sim.home.own import Entry, OwnObject, is_declaration
from sim.home.validation import home_flaws, mesh_flaws, object_flaws, spot_flaws
from sim.objects.objects import ObjectModel, load_objects

__all__ = ["DELIVERY", "PERSON", "Furniture", "Home", "PlanarPose", "Surface", "load_home"]

STAND_OFF_M = 0.62
"""From the front edge of a piece of furniture to the middle of the robot that uses it."""
TALKING_DISTANCE_M = 0.9
"""From the middle of the person to the middle of the robot that talks to them."""
FLOOR_VIEWS = 5
"""How many looks it takes to see the floor all around the robot."""
FACE_HEIGHT_M = 1.55
MOST_TOLD = 100
"""So many things that are wrong are told of one file."""
_SHOWN = 80
"""So many characters of a value that is wrong are told."""
VIEW_DEPTH_M = 0.17
"""Behind the front edge of a surface, where the camera looks."""
VIEW_HEIGHT_M = 0.06
"""Above a surface, where the camera looks."""


class Home(BaseModel):
    """A home as its file describes it; made by `load_home`."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)

    name: str
    wall_height: Length = 2.4
    wall_thickness: Annotated[Length, Field(le=1.0)] = 0.1
    robot_start: PoseInDegrees
    person: PoseInDegrees
    """Where the person is, and where they look."""
    rooms: Annotated[tuple[Room, ...], Field(min_length=1, max_length=200)]
    doors: Annotated[tuple[Door, ...], Field(max_length=600)] = ()
    furniture: Annotated[tuple[Furniture, ...], Field(max_length=5000)]
    delivery: Furniture
    """The table where brought things go; it is not searched."""
    objects: Annotated[dict[str, Entry], Field(max_length=200)] = Field(default_factory=dict)
    """Where things are; those of one's own are declared there, too."""
    _folder: Path | None = PrivateAttr(None)
    """Where its meshes are; None: nowhere, and things look like their forms."""
    _file: str = PrivateAttr("")
    _left: frozenset[str] = PrivateAttr(frozenset())
    """Things that were left just where they are: so there is room for them."""

    @property
    def file(self) -> str:
        """What its file is called in messages; empty if it was not read from one."""
        return self._file

    @property
    def own(self) -> dict[str, OwnObject]:
        """The objects that the file declares, in its order."""
        return {name: one for name, one in self.objects.items() if isinstance(one, OwnObject)}

    def things(self) -> tuple[Thing, ...]:
        """The objects that the file declares, for who knows only those of the ontology."""
        return tuple(Thing(name, one.kind, one.color_name) for name, one in self.own.items())

    def models(self) -> dict[str, ObjectModel]:
        """All things that there may be: those of the package, and those that the file declares."""
        return {**load_objects(), **{name: one.model(name) for name, one in self.own.items()}}

    def drawn_models(self) -> dict[str, ObjectModel]:
        """The same, those with meshes looking like them.

        Raises:
            InputError: if a mesh is not there any more.
        """
        return {**load_objects(), **{name: self.drawn_model(name) for name in self.own}}

    def drawn_model(self, name: str) -> ObjectModel:
        """One of those that the file declares, looking like its mesh if it has one.

        Raises:
            InputError: if the mesh is elsewhere, or cannot be used.
        """
        one = self.own[name]
        return one.drawn_model(name, self._folder) if self._folder else one.model(name)

    @property
    def placement(self) -> dict[str, str]:
        """Name of the furniture that each object is on, in the file's order."""
        return {name: spot.furniture for name, spot in self.objects.items()}

    def places(self) -> tuple[Place, ...]:
        """The searchable furniture, in the file's order."""
        rooms = {room.name: room for room in self.rooms}
        return tuple(
            Place(f.name, f.kind, f.room, rooms[f.room].kind, f.label, rooms[f.room].label)
            for f in self.furniture
        )

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
        pieces = (*self.furniture, self.delivery)
        for piece in pieces:
            if piece.name == name:
                return piece
        known = "it has " + ", ".join(piece.name for piece in pieces)
        raise InputError(f"home {self.name}", f"there is no furniture {name!r}", known)

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
        return self._pose(name, self.arrangement()[name])

    def object_poses(self) -> dict[str, Pose]:
        """Where each object's frame is in `map` at the start, in the file's order."""
        standing = self.arrangement()
        return {name: self._pose(name, standing[name]) for name in self.objects}

    def _pose(self, name: str, standing: Standing) -> Pose:
        piece = self.furniture_named(self.objects[name].furniture)
        yaw = piece.pose[2] + standing.yaw
        position = piece.to_map((standing.x, standing.y, standing.z))
        return Pose(position, heading(yaw))

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
        if not placement:
            return self
        nowhere = Spot(furniture="")
        spots = {n: self.objects.get(n, nowhere).moved(place) for n, place in placement.items()}
        home = self.model_copy(update={"objects": {**self.objects, **spots}})
        for flaw in (*object_flaws(home), *spot_flaws(home)):
            raise InputError("--place", *flaw)
        return home

    def arrangement(self) -> dict[str, Standing]:
        """Where each object's frame is in the frame of its furniture at the start."""
        surfaces = {f.name: f.surfaces() for f in (*self.furniture, self.delivery)}
        return arrange(self.objects, surfaces, self.models(), self._left)

    def as_left(self, spots: Mapping[str, Spot]) -> Self:
        """This home with things where they were left; those not named stay where they are."""
        moved = {name: self.objects.get(name, spot).at_spot(spot) for name, spot in spots.items()}
        home = self.model_copy(update={"objects": {**self.objects, **moved}})
        home._left = self._left | spots.keys()
        return home


def load_home(name_or_path: str) -> Home:
    """Read a home: the name of a packaged one, or a TOML file.

    Raises:
        InputError: if there is no such home or something in it is wrong, naming file and key.
    """
    if name_or_path in packaged_homes():
        return _packaged(name_or_path)
    return _sound(*_read(name_or_path))


@cache
def _packaged(name: str) -> Home:
    """What comes with the project stays as it is."""
    return _sound(*_read(name))


@lru_cache(maxsize=8)
def _sound(content: bytes, where: str) -> Home:
    """The home of a file; one that has not changed is the same home."""
    home, faults = _inspect(content, where, Path(where).parent)
    if home is None or faults:
        raise faults[0]
    return home


def inspect_home(name_or_path: str) -> tuple[Home | None, tuple[InputError, ...]]:
    """Read a home and all that is wrong in its file; no home if it does not have the right form.

    Raises:
        InputError: if there is no such home or it is not TOML.
    """
    content, where = _read(name_or_path)
    return _inspect(content, where, Path(where).parent)


def recorded_home(content: bytes) -> Home:
    """The home of a recording, whose meshes may be elsewhere.

    Raises:
        InputError: if something in it is wrong.
    """
    home, faults = _inspect(content, "home.toml", None)
    if home is None or faults:
        raise faults[0]
    return home


def _inspect(
    content: bytes, where: str, folder: Path | None
) -> tuple[Home | None, tuple[InputError, ...]]:
    data = {"name": usable(Path(where).stem), **parse_toml(content, where)}
    try:
        home = Home.model_validate(data)
    except ValidationError as error:
        faults = error.errors(include_url=False)
        around = {fault["loc"][:depth] for fault in faults for depth in range(len(fault["loc"]))}
        found = islice((fault for fault in faults if fault["loc"] not in around), MOST_TOLD)
        return None, tuple(_input_error(where, data, fault) for fault in found)
    home._folder, home._file = folder, where
    flaws = list(islice(home_flaws(home), MOST_TOLD)) or list(islice(mesh_flaws(home), MOST_TOLD))
    return home, tuple(InputError(where, *flaw) for flaw in flaws)


def home_text(name_or_path: str) -> str:
    """The file of a home, as `load_home` reads it.

    Raises:
        InputError: if there is no such home.
    """
    return decoded(*_read(name_or_path))


def packaged_homes() -> tuple[str, ...]:
    """Names of the homes that come with the project."""
    return packaged("sim", "homes")


def _read(name_or_path: str) -> tuple[bytes, str]:
    """The file of a home, and what to call it in messages."""
    known = f"packaged are {', '.join(packaged_homes())}"
    if name_or_path.endswith(".toml"):
        return read_bytes(Path(name_or_path), MOST_BYTES, right=known), name_or_path
    if name_or_path in packaged_homes():
        file = files("sim").joinpath("homes", f"{name_or_path}.toml")
        return file.read_bytes(), file.name
    known += "; or give the path of a .toml file"
    raise InputError(f"home {name_or_path[:_SHOWN]}", "there is no home of this name", known)


def _input_error(where: str, data: Any, fault: ErrorDetails) -> InputError:
    """One of pydantic's complaints, with the key as the file has it."""
    key = _key(data, fault["loc"])
    example = "see sim/homes/four_rooms.toml"
    match fault["loc"]:
        case ("objects", name, _, *_) if is_declaration(data["objects"][name]):
            example = "see docs/own-home.md"
    if fault["type"] == "extra_forbidden":
        return InputError(where, f"there is no key {key}", example)
    if fault["type"] == "missing":
        return InputError(where, f"{key} is missing", example)
    return InputError(where, f"{key} is {shown(fault['input'])}", _right(fault))


def _key(data: Any, path: tuple[str | int, ...]) -> str:
    """A path into the file as a person would put it: `furniture.desk.size.0`."""
    words = []
    for part in path:
        try:
            data = data[part]
        except (KeyError, IndexError, TypeError):
            data = None
        name = data.get("name") if isinstance(part, int) and isinstance(data, dict) else None
        words.append(str(part if name is None else name)[:_SHOWN])
    return ".".join(words)


def _right(fault: ErrorDetails) -> str:
    said = in_words(fault["msg"].lower())
    is_point = any(bound in (-FARTHEST_M, FARTHEST_M) for bound in fault.get("ctx", {}).values())
    return f"{said} (metres)" if is_point else said
