"""The home: rooms, doors, furniture, and where things, the person and the robot are in it.

A home is a TOML file; `homes/four_rooms.toml` shows every key. Its frame is `map`.
"""

import math
from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any, Self

from pydantic import BaseModel, ConfigDict, Field, PrivateAttr

from executive.errors import InputError
from executive.geometry import heading
from executive.types.geometry import Pose, Vector3
from executive.types.home import PERSON, Place, Thing
from sim.home.arrangement import Spot, Standing, arrange
from sim.home.floorplan import Door, Length, Room, Wall, walls
from sim.home.furniture import Furniture, PlanarPose, PoseInDegrees
from sim.home.own import Entry, OwnObject
from sim.objects.objects import ObjectModel, load_objects

STAND_OFF_M = 0.62
"""From the front edge of a piece of furniture to the middle of the robot that uses it."""
TALKING_DISTANCE_M = 0.9
"""From the middle of the person to the middle of the robot that talks to them."""
FLOOR_VIEWS = 5
"""How many looks it takes to see the floor all around the robot."""
FACE_HEIGHT_M = 1.55
VIEW_DEPTH_M = 0.17
"""Behind the front edge of a surface, where the camera looks."""
VIEW_HEIGHT_M = 0.06
"""Above a surface, where the camera looks."""


class Home(BaseModel):
    """A home as its file describes it; `home_file` reads one."""

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

    @classmethod
    def from_file(cls, data: Any, file: str, folder: Path | None) -> Self:
        """The home that a file describes.

        Args:
            data: what is in it.
            file: what it is called in messages.
            folder: where its meshes are; None: nowhere, and things look like their forms.

        Raises:
            ValidationError: if it has not the right form.
        """
        home = cls.model_validate(data)
        home._folder, home._file = folder, file
        return home

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
