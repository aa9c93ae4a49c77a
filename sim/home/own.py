"""An object of one's own: what the package does not have, and a home file says itself."""

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
"""A length of a thing that may stand on furniture (metres)."""
_SUFFIX = ".obj"
_FORMS = ("box", "cylinder", "sphere")


class OwnObject(Spot):
    """What it is, beside where it is. `mesh` is only looked at; what collides is the form."""

    kind: str
    """Its class in the ontology."""
    box: tuple[Extent, Extent, Extent] | None = None
    """Depth, width and height (metres)."""
    cylinder: tuple[Extent, Extent] | None = None
    """Diameter and height (metres); it stands."""
    sphere: Extent | None = None
    """Diameter (metres)."""
    mass: Annotated[float, Field(strict=True, ge=0.001, le=100.0)]
    """Kilograms."""
    color: HexColor | None = None
    mesh: Annotated[str, Field(max_length=200)] | None = None
    """OBJ file in the folder of the home file, or below it."""

    @model_validator(mode="after")
    def _of_one_form(self) -> Self:
        if sum(getattr(self, form) is not None for form in _FORMS) != 1:
            raise PydanticCustomError("form", "give one of box, cylinder and sphere")
        return self

    @property
    def size(self) -> Vector3:
        """Lengths along x, y and z as it stands (metres)."""
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
        """What its colour is called; empty if the file gives none."""
        return "" if self.paint is None else color_name(*self.paint[:3])

    def model(self, name: str) -> ObjectModel:
        """The thing that it is, of this name, looking like its form."""
        return _model(name, self._form, self.size, self.mass, self.paint or GREY)

    def drawn_model(self, name: str, folder: Path) -> ObjectModel:
        """The same, looking like its mesh, if it has one in this folder.

        Raises:
            InputError: if the mesh is elsewhere, or cannot be used.
        """
        plain = self.model(name)
        if self.mesh is None:
            return plain
        from sim.objects.meshes import aligned  # takes long to import, and few have a mesh

        look = aligned(plain, mesh_in(folder, self.mesh), self.paint or WHITE)
        return object_model(name, plain.shapes, mass_kg=plain.mass_kg, look=look, shown=(look,))

    @property
    def _form(self) -> str:
        return next(form for form in _FORMS if getattr(self, form) is not None)


KEYS = frozenset(OwnObject.model_fields) - frozenset(Spot.model_fields)
"""One of these makes an entry of `objects` a declaration."""


def as_entry(value: Any) -> Any:
    """An entry of `objects` as it is read: furniture, a spot, or an object of one's own."""
    if isinstance(value, str):
        return {"furniture": value}
    return OwnObject.model_validate(value) if is_declaration(value) else value


def is_declaration(entry: Any) -> bool:
    """Whether an entry of `objects` says what a thing is, and not only where."""
    return isinstance(entry, dict) and not KEYS.isdisjoint(entry)


Entry = Annotated[Spot, BeforeValidator(as_entry)]


def mesh_in(folder: Path, mesh: str) -> Path:
    """The file of a mesh, which has to be in the folder or below it.

    Raises:
        InputError: if it is elsewhere, or no OBJ.
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
