"""`python -m trees show`: the tree that a mission is run with, printed and drawn."""

from executive.start import begin

if __name__ == "__main__":
    begin()

import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from executive.errors import InputError
from executive.shell import DONE, entry_point
from executive.usage import Parser

if TYPE_CHECKING:  # a command imports what it needs
    from py_trees.behaviour import Behaviour

KNOWLEDGE = ("okb", "okb+llm", "okb+llm+mem")


@entry_point
def main(arguments: Sequence[str] | None = None) -> int:
    """Run one command; return the exit status (0 done, 2 bad input)."""
    parser = Parser(prog="python -m trees", description=__doc__)
    commands = parser.add_subparsers(required=True, metavar="COMMAND")
    show = commands.add_parser("show", help="print the tree, and draw it into a file")
    show.add_argument(
        "--knowledge", choices=KNOWLEDGE, default=KNOWLEDGE[-1], help="default: %(default)s"
    )
    show.add_argument(
        "--elicit", choices=["generate", "rank"], default="rank", help="default: %(default)s"
    )
    show.add_argument(
        "--search", choices=["plan", "paper"], default="plan", help="default: %(default)s"
    )
    show.add_argument("--svg", type=Path, metavar="FILE", help="draw it, too")
    options = parser.parse_args(arguments)
    from py_trees.display import unicode_tree

    from trees.drawing import svg

    tree = build(options.knowledge, options.elicit, options.search)
    print(unicode_tree(tree), end="")
    if options.svg:
        _write(options.svg, svg(tree))
    return DONE


def build(knowledge: str, elicit: str, search: str = "plan") -> "Behaviour":
    """The tree for these settings, with placeholders in the context: it cannot be ticked."""
    from executive.app.parts import Parts, build_context
    from executive.situation import Situation
    from sim.home.home_file import load_home
    from trees.context import Parameters
    from trees.mission import mission

    nobody: Any = object()
    llm = None if knowledge == "okb" else nobody
    parts = Parts(
        settings=nobody,
        home=load_home("four_rooms"),
        inbox=nobody,
        clock=nobody,
        recorder=nobody,
        robot=nobody,
        perception=nobody,
        user=nobody,
        knowledge=nobody,
        model=llm,
        advice=llm,
        parameters=Parameters(elicit=elicit, search=search),
    )
    return mission(build_context(parts, Situation()))


def _write(file: Path, text: str) -> None:
    try:
        file.write_text(text, encoding="utf-8")
    except OSError as error:
        right = "name a file in an existing folder"
        raise InputError(str(file), f"cannot be written: {error.strerror}", right) from error
    print(file, file=sys.stderr)


if __name__ == "__main__":
    sys.exit(main())
