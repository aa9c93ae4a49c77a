"""What is asked for, as far as it is understood."""

from dataclasses import dataclass

from executive.types import Command, CommandKind


@dataclass
class Request:
    """What the person wants, in the order in which it becomes known."""

    words: str = ""
    command: Command | None = None
    remark: str = ""
    """What to say of the words if they were read, and are no command to carry out."""
    options: tuple[str, ...] = ()
    """Objects that the target may mean."""
    several: bool = False
    """Whether the target names several things at once."""
    guess: str = ""
    """A known name that the target may be a slip of, or that is all of it that is known."""
    object: str | None = None

    def asks_to(self, kind: CommandKind) -> bool:
        """Whether this kind of deed was asked for."""
        return self.command is not None and self.command.kind == kind
