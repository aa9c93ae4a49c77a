"""What the person asks for, as far as it is understood."""

from dataclasses import asdict, dataclass, field
from typing import Any

from executive.situation.snapshot import logged_as
from executive.types.commands import Command, CommandKind


def command_as_logged(command: Command | None) -> dict[str, Any] | None:
    """The command without what was not said: the commands of older recordings had no places."""
    if command is None:
        return None
    always = ("kind", "target", "words")
    said = asdict(command, dict_factory=_less_plural)
    return {name: v for name, v in said.items() if v or name in always}


def _less_plural(fields: list[tuple[str, Any]]) -> dict[str, Any]:
    """The fields without `plural`: older recordings do not have it, and the number tells it."""
    return {name: value for name, value in fields if name != "plural"}


@dataclass
class Request:
    """What the person wants; fields are in the order in which they become known."""

    words: str = ""
    command: Command | None = field(default=None, metadata=logged_as(plain=command_as_logged))
    remark: str = ""
    """What to answer if the words were read, but are not a command to carry out."""
    options: tuple[str, ...] = ()
    """Objects that the target may mean."""
    several: bool = False
    """Whether the target names several things at once."""
    guess: str = ""
    """A known name that may be meant: the target is like it, or has it in it."""
    object: str | None = None
    """Name of the thing that is meant; None while that is not known."""
    from_places: tuple[str, ...] = ()
    """The furniture where the thing is, as the words say, the likeliest first."""
    goals: tuple[str, ...] = ()
    """The furniture where the thing, or the robot, may go, the best first."""
    goal: str = ""
    """The one of `goals` that the robot has chosen."""

    @property
    def asked_for(self) -> Command:
        """The command; only for those who come after the words were understood."""
        assert self.command is not None
        return self.command

    @property
    def thing(self) -> str:
        """Name of the thing that is meant; empty while that is not known."""
        return self.object or ""

    def asks_to(self, kind: CommandKind) -> bool:
        """Whether the current command is of this kind."""
        return self.command is not None and self.command.kind == kind
