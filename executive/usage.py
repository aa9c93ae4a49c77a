"""A command line whose complaints are one line each, whatever was given."""

import argparse
from pathlib import Path
from typing import Any, NoReturn

from executive.text import printable


class Parser(argparse.ArgumentParser):
    """The standard parser, which quotes what it refuses as it came, line breaks and all.

    A name or a path that is empty, as of a variable that a shell lacks, is refused: the path would
    be the folder that one is in.
    """

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        """Take what the standard parser takes."""
        super().__init__(*args, **kwargs)
        for kind in (str, Path):
            self.register("type", kind, lambda text, kind=kind: kind(_named(text)))

    def error(self, message: str) -> NoReturn:
        """End with the usage and the complaint."""
        super().error(printable(message))


def _named(text: str) -> str:
    if not text.strip():
        raise argparse.ArgumentTypeError("is empty; name one, or leave it out")
    return text
