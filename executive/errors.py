"""What can go wrong before or beside a mission.

    ExecutiveError            speaks to the person who can act: what, where, and what would be right
    ├── InputError            a file, an option or a reply that came from outside is wrong
    ├── ModelError            the language model cannot be loaded or reached
    └── UnreachableError      there is no way to the robot any more

A mission that merely does not succeed is no error: it ends with an Outcome.
"""

from executive.text import printable


class ExecutiveError(Exception):
    """Root of all errors that are shown to the person as one sentence, without a traceback."""


class InputError(ExecutiveError):
    """Something from outside (command, home file, ontology, config, log) is wrong."""

    def __init__(self, where: str, what: str, right: str = "") -> None:
        """Say where the fault is, what it is, and what would be right."""
        super().__init__(where, what, right)

    def __str__(self) -> str:
        """The three in one sentence, on one line that a terminal may have."""
        where, what, right = self.args
        return printable(f"{where}: {what}" + (f"; {right}" if right else ""))


class ModelError(ExecutiveError):
    """The language model is missing, broken, or does not answer."""


class UnreachableError(ExecutiveError):
    """There is no way to the robot any more: nothing that it is asked for would be done."""
