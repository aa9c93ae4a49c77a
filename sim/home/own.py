"""The user's own objects: a home file can declare objects that the package does not have."""

from functools import cache
from pathlib import Path
from typing import Annotated, Any, Self

from pydantic import BeforeValidator, Field, model_validator
from pydantic_core import PydanticCustomError

from executive.colors import Color, color_name
from executive.errors import InputError
from executive.records import Shape
from executive.types.geometry import Pose, Vector3
from sim.home.arrangement import Spot
from sim.objects.objects import GREY, WHITE, HexColor, ObjectModel, object_model, rgba

Extent = Annotated[float, Field(strict=True, ge=0.005, le=0.5)]
"""A length of an object that can stand on furniture (metres)."""
_SUFFIX = ".obj"
_FORMS = ("box", "cylinder", "sphere")


class OwnObject(Spot):
    """A declared object and its spot. `mesh` is only for drawing; the form is for collisions."""

    kind: str
    """Its class in the ontology."""
    box: tuple[Extent, Extent, Extent] | None = None
    """Depth, width and height (metres)."""
    cylinder: tuple[Extent, Extent] | None = None
    """Diameter and height (metres); the axis is vertical."""
    sphere: Extent | None = None
    """Diameter (metres)."""
    mass: Annotated[float, Field(strict=True, ge=0.001, le=100.0)]
    """Kilograms."""
    color: HexColor | None = None
    mesh: Annotated[str, Field(max_length=200)] | None = None
    """Path of an OBJ file, relative to the folder of the home file, and inside it."""

    @model_validator(mode="after")
    def _of_one_form(self) -> Self:
        if sum(getattr(self, form) is not None for form in _FORMS) != 1:
            raise PydanticCustomError("form", "give one of box, cylinder and sphere")
        return self

    @property
    def size(self) -> Vector3:
        """Lengths along x, y and z of the standing object (metres)."""
        if self.box:
            return self.box
        if self.cylinder:
            return self.cylinder[0], self.cylinder[0], self.cylinder[1]
        assert self.sphere
        return self.sphere, self.sphere, self.sphere

    @property
    def paint(self) -> Color | None:
        """Its colour, if the file gives one."""
        return None if self.color is None else rgba(self.color)

    @property
    def color_name(self) -> str:
        """The name of its colour; empty if the file gives none."""
        return "" if self.paint is None else color_name(*self.paint[:3])

    def model(self, name: str) -> ObjectModel:
        """Its model, named `name`, without a mesh: it looks like its form."""
        return _model(name, self._form, self.size, self.mass, self.paint or GREY)

    def drawn_model(self, name: str, folder: Path) -> ObjectModel:
        """Its model with the mesh, if it has one.

        Raises:
            InputError: if the mesh is outside the folder, or cannot be used.
        """
        plain = self.model(name)
        if self.mesh is None:
            return plain
        from sim.objects.meshes import aligned  # slow to import, and few objects have a mesh

        look = aligned(plain, mesh_in(folder, self.mesh), self.paint or WHITE)
        return object_model(name, plain.shapes, mass_kg=plain.mass_kg, look=look, shown=(look,))

    @property
    def _form(self) -> str:
        return next(form for form in _FORMS if getattr(self, form) is not None)


KEYS = frozenset(OwnObject.model_fields) - frozenset(Spot.model_fields)
"""An entry of `objects` with any of these keys is a declaration."""


def as_entry(value: Any) -> Any:
    """Convert an entry of `objects` for parsing: furniture, a spot, or a declared object."""
    if isinstance(value, str):
        return {"furniture": value}
    return OwnObject.model_validate(value) if is_declaration(value) else value


def is_declaration(entry: Any) -> bool:
    """Whether an entry of `objects` declares an object, instead of only its spot."""
    return isinstance(entry, dict) and not KEYS.isdisjoint(entry)


Entry = Annotated[Spot, BeforeValidator(as_entry)]


def mesh_in(folder: Path, mesh: str) -> Path:
    """The path of a mesh, which must be in the folder or below it.

    Raises:
        InputError: if it is outside, or not an OBJ file.
    """
    where, right = f"mesh {mesh!r}", "name an .obj file in the folder of the home file"
    if not mesh.endswith(_SUFFIX) or not mesh.isprintable():
        raise InputError(where, "is no OBJ file", right)
    path = folder / mesh
    if not path.resolve().is_relative_to(folder.resolve()):
        raise InputError(where, "is outside of the folder of the home file", right)
    return path


@cache
def _model(name: str, form: str, size: Vector3, mass: float, color: Color) -> ObjectModel:
    middle = Pose((0.0, 0.0, size[2] / 2))
    return object_model(name, (Shape(form, size, color, middle),), mass_kg=mass)
