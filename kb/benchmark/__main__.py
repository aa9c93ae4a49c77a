"""`python -m kb.benchmark`: how well a language model knows where things are.

Several ways of finding out are held against the same questions: chance, what the knowledge base
counts without a model, the plain model, and what the robot does (`--elicit rank` or `generate`).
"""

from executive.start import begin

if __name__ == "__main__":
    begin()

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from executive.options import add_setting
from executive.shell import DONE, entry_point
from executive.usage import Parser

DATA = ("survey", "survey-rest", "placements", "placements-new")


@entry_point
def main(arguments: Sequence[str] | None = None) -> int:
    """Run the benchmark."""
    given = parser().parse_args(arguments)
    given.data = given.data or DATA
    from kb.benchmark.running import run  # heavy: not for --help or a wrong option

    run(given)
    return DONE


def parser() -> argparse.ArgumentParser:
    """The command line."""
    p = Parser(prog="python -m kb.benchmark", description=__doc__)
    p.add_argument("--data", action="append", choices=DATA, help="repeatable; default: all")
    p.add_argument("--fold", choices=("valid", "test"), default="test", help="of the placements")
    p.add_argument("--placements", type=Path, metavar="FILE", help="default: as installed")
    add_setting(
        p,
        "llm",
        default="embedded",
        metavar="LLM",
        help="embedded, FILE.gguf, http://host:port/v1, or none",
    )
    add_setting(p, "elicit", choices=("rank", "generate"), help="default: rank, if it can")
    p.add_argument("--grammar", action="store_true", help="hold replies to their JSON schema")
    add_setting(p, "prompts", help="texts that replace ours")
    add_setting(p, "seed", default=0, metavar="SEED", help="of what a model writes (default: 0)")
    p.add_argument("--objects", type=int, metavar="N", help="only the first N of each data set")
    p.add_argument("--journal", type=Path, metavar="FILE", help="keep answers, and go on from them")
    p.add_argument("--json", action="store_true", help="print JSON")
    p.add_argument(
        "--reliability",
        type=Path,
        metavar="FILE",
        help="draw whether what the robot does says how likely it is, as .svg or .png",
    )
    p.add_argument("--plot", type=Path, metavar="FILE", help="draw it, as .svg or .png")
    return p


if __name__ == "__main__":
    sys.exit(main())
