"""Models of objects: mass, shapes, and how a two-finger hand grasps them."""

import math
import re
from dataclasses import dataclass, replace
from functools import cache
from importlib.resources import files
from pathlib import Path
from typing import Annotated, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import AfterValidator, BaseModel, ConfigDict, TypeAdapter
from pydantic_core import PydanticCustomError

from executive.colors import Color
from executive.geometry import matrix_of, orientation_of, transform, vector3
from executive.records import Shape
from executive.toml_file import parse_toml
from executive.types.geometry import Pose, Vector3

Grasp = Literal["top", "rim", "handle"]
TUBE_WALLS = 12
ASSETS = Path(__file__).parents[1] / "assets" / "objects"
"""A folder for each object with a mesh, as `textured.obj` and as `textured.glb`."""
WHITE: Color = (1.0, 1.0, 1.0, 1.0)
"""Leaves the colours of a texture unchanged."""
OPENING_M = 0.0755
"""The widest object that fits between the fingers: `sim.manipulation.grasps.WIDEST`."""
PAYLOAD_KG = 3.0
"""The arm's payload, from the maker's data sheet."""
GREY: Color = (0.6, 0.6, 0.6, 1.0)
"""The default colour."""


def _check_hex(color: str) -> str:
    if not re.fullmatch("#[0-9a-fA-F]{6}", color, re.ASCII):
        raise PydanticCustomError("color", "write red, green and blue as in #336699")
    return color


HexColor = Annotated[str, AfterValidator(_check_hex)]
"""Red, green and blue in HTML notation: #336699."""


@dataclass(frozen=True, slots=True)
class ObjectModel:
    """The model of an object, in the pose in which it is put down.

    Attributes:
        name: as in the ontology.
        mass_kg: its mass.
        friction: lateral friction coefficient (the simulator multiplies those of both bodies).
        grasp: `top` (fingers straddle the narrow horizontal side from above), `rim` (one finger
            inside) or `handle`.
        shapes: collision shapes in the object frame, whose origin is the centre of its base.
        look: the textured mesh for the simulator's renderer, in the object frame; None: the shapes
            are drawn.
        shown: what the viewer of recordings draws, in the object frame.
        lower: lowest corner of the bounding box in the object frame (metres).
        upper: highest corner of the bounding box.
        center_of_mass: in the object frame; all shapes have the same density.
    """

    name: str
    mass_kg: float
    friction: float
    grasp: Grasp
    shapes: tuple[Shape, ...]
    look: Shape | None
    shown: tuple[Shape, ...]
    lower: Vector3
    upper: Vector3
    center_of_mass: Vector3

    @property
    def size(self) -> Vector3:
        """Lengths of the bounding box along x, y and z (metres)."""
        x, y, z = (high - low for low, high in zip(self.lower, self.upper, strict=True))
        return x, y, z


@cache
def load_objects() -> dict[str, ObjectModel]:
    """The objects of the package (objects.toml), by name."""
    return {name: row.model(name) for name, row in _rows().items()}


def rooms_of_objects() -> dict[str, tuple[str, ...]]:
    """The kinds of rooms that each object of the package belongs in."""
    return {name: row.rooms for name, row in _rows().items()}


def drawings() -> dict[str, str]:
    """The modules of `sim.modelling` that make the meshes, by object; only objects with a mesh."""
    return {name: row.drawn_by for name, row in _rows().items() if row.drawn_by}


def why_not_taken(model: ObjectModel) -> str | None:
    """Why the robot can never pick an object up, as the end of a sentence; None if it may."""
    if model.grasp == "top" and min(model.size) > OPENING_M:
        return "it is wider than my hand opens"
    return "it is heavier than my arm may lift" if model.mass_kg > PAYLOAD_KG else None


def rgba(color: HexColor) -> Color:
    """The colour of a text such as #336699."""
    red, green, blue = bytes.fromhex(color[1:])
    return red / 255, green / 255, blue / 255, 1.0


def packaged_mesh(name: str, form: Literal["obj", "glb"]) -> Shape:
    """The mesh of an object that `python -m sim.modelling` has made, in the object frame."""
    path = ASSETS / name / f"textured.{form}"
    return Shape("mesh", (1.0, 1.0, 1.0), WHITE, mesh=str(path))


class _Part(BaseModel):
    """A shape in the file (metres, degrees)."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    kind: Literal["box", "cylinder", "sphere", "tube"]
    size: Vector3
    at: Vector3
    rpy: Vector3 = (0.0, 0.0, 0.0)

    def shapes(self) -> tuple[Shape, ...]:
        if self.kind == "tube":
            return tuple(self._wall(i) for i in range(TUBE_WALLS))
        pose = Pose(self.at, orientation_of(np.deg2rad(self.rpy).tolist()))
        return (Shape(self.kind, self.size, WHITE, pose),)

    def _wall(self, index: int) -> Shape:
        """One of the boxes that form the tube's wall, in a ring."""
        diameter, thickness, height = self.size
        angle = 2 * math.pi * index / TUBE_WALLS
        middle = (diameter - thickness) / 2
        width = diameter * math.tan(math.pi / TUBE_WALLS)
        turn = orientation_of((0.0, 0.0, angle))
        [at] = transform(Pose(self.at, turn), np.array([[middle, 0.0, 0.0]]))
        return Shape("box", (thickness, width, height), WHITE, Pose(vector3(at), turn))


class _Row(BaseModel):
    """An object in the file."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    mass_kg: float
    friction: float
    grasp: Grasp
    shapes: tuple[_Part, ...]
    rooms: tuple[str, ...]
    drawn_by: str | None = None
    color: HexColor | None = None

    def model(self, name: str) -> ObjectModel:
        paint = GREY if self.color is None else rgba(self.color)
        shapes = tuple(shape for part in self.shapes for shape in part.shapes())
        return object_model(
            name,
            tuple(replace(shape, color=paint) for shape in shapes),
            mass_kg=self.mass_kg,
            friction=self.friction,
            grasp=self.grasp,
            look=packaged_mesh(name, "obj") if self.drawn_by else None,
            shown=(packaged_mesh(name, "glb"),) if self.drawn_by else (),
        )


def object_model(
    name: str,
    shapes: tuple[Shape, ...],
    *,
    mass_kg: float,
    friction: float = 0.7,
    grasp: Grasp = "top",
    look: Shape | None = None,
    shown: tuple[Shape, ...] = (),
) -> ObjectModel:
    """The model of an object of these shapes; `shown` is the shapes by default."""
    reach = np.array([_half_extent(shape) for shape in shapes])
    middle = np.array([shape.pose.position for shape in shapes])
    volume = np.array([_volume(shape) for shape in shapes])
    return ObjectModel(
        name,
        mass_kg,
        friction,
        grasp,
        shapes,
        look,
        shown or shapes,
        lower=vector3((middle - reach).min(axis=0)),
        upper=vector3((middle + reach).max(axis=0)),
        center_of_mass=vector3(volume @ middle / volume.sum()),
    )


@cache
def _rows() -> dict[str, _Row]:
    content = files("sim").joinpath("objects.toml").read_bytes()
    return TypeAdapter(dict[str, _Row]).validate_python(parse_toml(content, "objects.toml"))


def _half_extent(shape: Shape) -> NDArray[np.float64]:
    """Half lengths of the axis-aligned box around a shape (metres)."""
    half = np.asarray(shape.size) / 2
    axes = matrix_of(shape.pose.orientation)
    if shape.kind == "sphere":
        return half
    if shape.kind == "cylinder":
        axis = axes[:, 2]
        return np.asarray(half[2] * np.abs(axis) + half[0] * np.sqrt(np.clip(1 - axis**2, 0, 1)))
    return np.asarray(np.abs(axes) @ half)


def _volume(shape: Shape) -> float:
    x, y, z = shape.size
    share = {"box": 1.0, "cylinder": math.pi / 4, "sphere": math.pi / 6}[shape.kind]
    return share * x * y * z
