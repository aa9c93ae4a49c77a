"""Makes the meshes of the objects anew: `python -m sim.modelling` (needs the extra `objects`)."""

from collections.abc import Callable
from pathlib import Path

from executive.usage import Parser
from sim.modelling import fruit, household, packages, tools
from sim.modelling.assembly import assemble, write
from sim.modelling.parts import Part
from sim.objects.objects import ASSETS, load_objects

RECIPES: dict[str, Callable[[], list[Part]]] = {
    recipe.__name__: recipe
    for recipe in (
        fruit.apple,
        tools.adjustable_wrench,
        fruit.banana,
        packages.bleach_cleanser,
        household.colored_wood_blocks,
        packages.cracker_box,
        tools.hammer,
        fruit.orange,
        household.mug,
        packages.mustard_bottle,
        fruit.peach,
        fruit.pear,
        household.pitcher_base,
        packages.potted_meat_can,
        tools.power_drill,
        packages.pudding_box,
        tools.scissors,
        tools.spatula,
        fruit.strawberry,
        packages.sugar_box,
        fruit.tennis_ball,
        packages.tomato_soup_can,
    )
}
"""How each object of objects.toml looks."""


def main(arguments: list[str] | None = None) -> None:
    """Write the files of all objects, or of those named."""
    parser = Parser(prog="python -m sim.modelling", description=__doc__)
    parser.add_argument(
        "names",
        nargs="*",
        choices=[*RECIPES, []],
        metavar="OBJECT",
        default=[],
        help="default: all",
    )
    parser.add_argument(
        "--out", type=Path, default=ASSETS, metavar="DIR", help="default: the packaged objects"
    )
    options = parser.parse_args(arguments)
    models = load_objects()
    for name in options.names or RECIPES:
        mesh = assemble(RECIPES[name](), models[name])
        write(mesh, options.out / name)
        print(f"{name}: {len(mesh.faces)} triangles, texture {mesh.visual.material.image.size}")


if __name__ == "__main__":
    main()
