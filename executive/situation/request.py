"""The current command, as far as it is understood."""

from dataclasses import asdict, dataclass, field
from typing import Any

from executive.situation.snapshot import logged_as
from executive.types.commands import Command, CommandKind


def command_as_logged(command: Command | None) -> dict[str, Any] | None:
    """A command as JSON for the log, without empty fields, as in recordings that lack them."""
    if command is None:
        return None
    always = ("kind", "target", "words")
    said = asdict(command, dict_factory=_less_plural)
    return {name: v for name, v in said.items() if v or name in always}


def _less_plural(fields: list[tuple[str, Any]]) -> dict[str, Any]:
    """Leave out `plural`: earlier recordings do not have it, and `number` says the same."""
    return {name: value for name, value in fields if name != "plural"}


@dataclass
class Request:
    """What the person wants; fields are in the order in which they become known."""

    words: str = ""
    command: Command | None = field(default=None, metadata=logged_as(plain=command_as_logged))
    remark: str = ""
    """The reply to the words if they were parsed and are not a command to carry out."""
    options: tuple[str, ...] = ()
    """Objects that the target may mean."""
    several: bool = False
    """Whether the target names several things at once."""
    guess: str = ""
    """A known name that the target may misspell, or that is the only known part of it."""
    object: str | None = None
    from_places: tuple[str, ...] = ()
    """The furniture where the thing is, as the words say, the likeliest first."""
    goals: tuple[str, ...] = ()
    """The acceptable furniture for the goal of the thing, or of the robot, the best first."""
    goal: str = ""
    """The one of `goals` that the robot has chosen."""

    def asks_to(self, kind: CommandKind) -> bool:
        """Whether the current command is of this kind."""
        return self.command is not None and self.command.kind == kind
