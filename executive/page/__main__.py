"""The page beside missions: `study FILE.toml` leads through a study, `runs` shows past runs."""

from executive.start import begin

if __name__ == "__main__":
    begin()

import argparse
import sys
from collections.abc import Sequence

from executive.page.experiment import command as past
from executive.page.study import command as study
from executive.shell import entry_point
from executive.usage import Parser


@entry_point
def main(arguments: Sequence[str] | None = None) -> int:
    """Run a command; return the exit code."""
    options = parser().parse_args(arguments)
    code: int = options.run(options)
    return code


def parser() -> argparse.ArgumentParser:
    """The command line."""
    p = Parser(
        prog="python -m executive.page", description="Studies by the person's page, and past runs."
    )
    commands = p.add_subparsers(required=True, metavar="COMMAND")
    study.add_to(commands)
    past.add_to(commands)
    return p


if __name__ == "__main__":
    sys.exit(main())
