"""Makes the meshes of the objects anew: `python -m sim.modelling` (needs the extra `objects`)."""

from collections.abc import Callable
from importlib import import_module
from pathlib import Path

from executive.usage import Parser
from sim.modelling.assembly import assemble, write
from sim.modelling.parts import Part
from sim.objects.objects import ASSETS, drawings, load_objects


def recipe(name: str) -> Callable[[], list[Part]]:
    """The function that builds an object, from the module that objects.toml gives."""
    module = import_module(f"{__package__}.{drawings()[name]}")
    found: Callable[[], list[Part]] = getattr(module, name)
    return found


def main(arguments: list[str] | None = None) -> None:
    """Write the files of all objects, or of those named."""
    parser = Parser(prog="python -m sim.modelling", description=__doc__)
    parser.add_argument(
        "names",
        nargs="*",
        choices=[*drawings(), []],
        metavar="OBJECT",
        default=[],
        help="default: all",
    )
    parser.add_argument(
        "--out", type=Path, default=ASSETS, metavar="DIR", help="default: the packaged objects"
    )
    options = parser.parse_args(arguments)
    models = load_objects()
    for name in options.names or drawings():
        mesh = assemble(recipe(name)(), models[name])
        write(mesh, options.out / name)
        print(f"{name}: {len(mesh.faces)} triangles, texture {mesh.visual.material.image.size}")


if __name__ == "__main__":
    main()
