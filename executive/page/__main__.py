"""The page beside single missions: `python -m executive.page study FILE.toml` runs a study."""

from executive.start import begin

if __name__ == "__main__":
    begin()

import argparse
import sys
from collections.abc import Sequence

from executive.page.study import command
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
    p = Parser(prog="python -m executive.page", description="Run studies by the person's page.")
    command.add_to(p.add_subparsers(required=True, metavar="COMMAND"))
    return p


if __name__ == "__main__":
    sys.exit(main())
