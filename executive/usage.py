"""A command line whose complaints are one line each, whatever was given."""

import argparse
from typing import NoReturn

from executive.text import printable


class Parser(argparse.ArgumentParser):
    """The standard parser, which quotes what it refuses as it came, line breaks and all."""

    def error(self, message: str) -> NoReturn:
        """End with the usage and the complaint."""
        super().error(printable(message))
