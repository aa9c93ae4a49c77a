"""What is asked for, as far as it is understood."""

from dataclasses import asdict, dataclass, field
from typing import Any

from executive.situation.snapshot import logged_as
from executive.types.commands import Command, CommandKind


def command_as_logged(command: Command | None) -> dict[str, Any] | None:
    """What was not said is left out, as in earlier recordings, whose commands had no places."""
    if command is None:
        return None
    always = ("kind", "target", "words")
    said = asdict(command, dict_factory=_less_plural)
    return {name: v for name, v in said.items() if v or name in always}


def _less_plural(fields: list[tuple[str, Any]]) -> dict[str, Any]:
    """Earlier recordings did not have it, and it is told by the number once that is known."""
    return {name: value for name, value in fields if name != "plural"}


@dataclass
class Request:
    """What the person wants, in the order in which it becomes known."""

    words: str = ""
    command: Command | None = field(default=None, metadata=logged_as(plain=command_as_logged))
    remark: str = ""
    """What to say of the words if they were read, and are no command to carry out."""
    options: tuple[str, ...] = ()
    """Objects that the target may mean."""
    several: bool = False
    """Whether the target names several things at once."""
    guess: str = ""
    """A known name that the target may be a slip of, or that is all of it that is known."""
    object: str | None = None
    from_places: tuple[str, ...] = ()
    """The furniture where the thing is by the words, the likeliest first."""
    goals: tuple[str, ...] = ()
    """The furniture that will do as the place where it, or the robot, is to go, the best first."""
    goal: str = ""
    """That of them which the robot has chosen."""

    def asks_to(self, kind: CommandKind) -> bool:
        """Whether this kind of deed was asked for."""
        return self.command is not None and self.command.kind == kind
