"""The exceptions of the executive.

    ExecutiveError            tells the person who can act what is wrong, where, and what is right
    ├── InputError            a file, an option or a reply from outside is wrong
    ├── ModelError            the language model cannot be loaded or reached
    └── UnreachableError      the robot cannot be reached any more

A mission that does not succeed is not an error: it ends with an Outcome.
"""

from executive.text import printable


class ExecutiveError(Exception):
    """Base of all errors that the person sees as one sentence, without a traceback."""


class InputError(ExecutiveError):
    """Something from outside (command, home file, ontology, config, log) is wrong."""

    def __init__(self, where: str, what: str, right: str = "") -> None:
        """Say where the error is, what is wrong, and what would be right."""
        super().__init__(where, what, right)

    def __str__(self) -> str:
        """The three in one sentence, on one printable line."""
        where, what, right = self.args
        return printable(f"{where}: {what}" + (f"; {right}" if right else ""))


class ModelError(ExecutiveError):
    """The language model is missing, broken, or does not answer."""


class UnreachableError(ExecutiveError):
    """The robot cannot be reached any more: it would do nothing that it is asked for."""
