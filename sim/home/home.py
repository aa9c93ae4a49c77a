"""The home: rooms, doors and furniture, and where objects, the person and the robot are.

A home is a TOML file; `homes/four_rooms.toml` shows every key. All poses are in `map`.
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
"""Distance from the front edge of furniture to the centre of the robot that uses it."""
TALKING_DISTANCE_M = 0.9
"""Distance from the centre of the person to the centre of the robot that talks to them."""
FLOOR_VIEWS = 5
"""Number of head poses that together see the floor all around the robot."""
FACE_HEIGHT_M = 1.55
VIEW_DEPTH_M = 0.17
"""The camera looks at a point this far behind the front edge of a surface,"""
VIEW_HEIGHT_M = 0.06
"""and this high above it."""


class Home(BaseModel):
    """A home as its file describes it; `home_file` reads the file."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)

    name: str
    wall_height: Length = 2.4
    wall_thickness: Annotated[Length, Field(le=1.0)] = 0.1
    robot_start: PoseInDegrees
    person: PoseInDegrees
    """Where the person stands, and the direction in which they look."""
    rooms: Annotated[tuple[Room, ...], Field(min_length=1, max_length=200)]
    doors: Annotated[tuple[Door, ...], Field(max_length=600)] = ()
    furniture: Annotated[tuple[Furniture, ...], Field(max_length=5000)]
    delivery: Furniture
    """The table for objects that are brought; it is not searched."""
    objects: Annotated[dict[str, Entry], Field(max_length=200)] = Field(default_factory=dict)
    """Spots of the objects, by name; the user's own objects are also declared here."""
    _folder: Path | None = PrivateAttr(None)
    """The folder of its meshes; None: no meshes, and objects look like their forms."""
    _file: str = PrivateAttr("")
    _left: frozenset[str] = PrivateAttr(frozenset())
    """Objects that were left exactly where they are: their spots are not checked for room."""

    @classmethod
    def from_file(cls, data: Any, file: str, folder: Path | None) -> Self:
        """Make a home from the parsed content of its file.

        Args:
            data: the content.
            file: the name of the file in messages.
            folder: the folder of its meshes; None: no meshes, objects look like their forms.

        Raises:
            ValidationError: if keys or values are invalid.
        """
        home = cls.model_validate(data)
        home._folder, home._file = folder, file
        return home

    @property
    def file(self) -> str:
        """The name of its file in messages; empty if it was not read from a file."""
        return self._file

    @property
    def own(self) -> dict[str, OwnObject]:
        """The objects that the file declares, in its order."""
        return {name: one for name, one in self.objects.items() if isinstance(one, OwnObject)}

    def things(self) -> tuple[Thing, ...]:
        """The objects that the file declares, in the form that the ontology needs."""
        return tuple(Thing(name, one.kind, one.color_name) for name, one in self.own.items())

    def models(self) -> dict[str, ObjectModel]:
        """The models of all known objects: those of the package, and those of the file."""
        return {**load_objects(), **{name: one.model(name) for name, one in self.own.items()}}

    def drawn_models(self) -> dict[str, ObjectModel]:
        """The same models with meshes for drawing, if they have any.

        Raises:
            InputError: if a mesh cannot be read any more.
        """
        return {**load_objects(), **{name: self.drawn_model(name) for name in self.own}}

    def drawn_model(self, name: str) -> ObjectModel:
        """The model of an object that the file declares, with its mesh if it has one.

        Raises:
            InputError: if the mesh is outside the folder, or cannot be used.
        """
        one = self.own[name]
        return one.drawn_model(name, self._folder) if self._folder else one.model(name)

    @property
    def placement(self) -> dict[str, str]:
        """The name of the furniture that each object is on, in the file's order."""
        return {name: spot.furniture for name, spot in self.objects.items()}

    def places(self) -> tuple[Place, ...]:
        """The searchable furniture, in the file's order."""
        rooms = {room.name: room for room in self.rooms}
        return tuple(
            Place(f.name, f.kind, f.room, rooms[f.room].kind, f.label, rooms[f.room].label)
            for f in self.furniture
        )

    def extent(self) -> tuple[float, float, float, float]:
        """Left, lower, right and upper edge of all rooms together, in `map` (metres)."""
        left, lower, right, upper = zip(*(room.rectangle for room in self.rooms), strict=True)
        return min(left), min(lower), max(right), max(upper)

    def walls(self) -> tuple[Wall, ...]:
        """The walls, with gaps for doors, in `map`."""
        return walls(self.rooms, self.doors, self.wall_thickness)

    def furniture_named(self, name: str) -> Furniture:
        """The piece of furniture, or the delivery table, of a name.

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
        """The robot's pose for using a piece of furniture, or for talking to the `person`.

        It faces the front of the furniture, STAND_OFF_M away from its edge.

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
        """The start pose of an object in `map`.

        Raises:
            InputError: if the object is not in this home.
        """
        if name not in self.objects:
            known = "it has " + ", ".join(self.objects)
            raise InputError(f"home {self.name}", f"there is no object {name!r}", known)
        return self._pose(name, self.arrangement()[name])

    def object_poses(self) -> dict[str, Pose]:
        """The start poses of all objects in `map`, in the file's order."""
        standing = self.arrangement()
        return {name: self._pose(name, standing[name]) for name in self.objects}

    def _pose(self, name: str, standing: Standing) -> Pose:
        piece = self.furniture_named(self.objects[name].furniture)
        yaw = piece.pose[2] + standing.yaw
        position = piece.to_map((standing.x, standing.y, standing.z))
        return Pose(position, heading(yaw))

    def view_targets(self, place: str) -> tuple[Vector3, ...]:
        """Points in `map` that the robot looks at to see all of a place, from its `stand`.

        One for each surface of the furniture, in the order of `surfaces`; the face of the `person`.

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
        """The start pose of each object in the frame of its furniture."""
        surfaces = {f.name: f.surfaces() for f in (*self.furniture, self.delivery)}
        return arrange(self.objects, surfaces, self.models(), self._left)

    def as_left(self, spots: Mapping[str, Spot]) -> Self:
        """A copy of this home with objects where they were left; all others stay as they are."""
        moved = {name: self.objects.get(name, spot).at_spot(spot) for name, spot in spots.items()}
        home = self.model_copy(update={"objects": {**self.objects, **moved}})
        home._left = self._left | spots.keys()
        return home
