"""An interpreter that reads what a test lays down, so that the tree is tested without a grammar."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

from executive.app.parts import Change, Parts
from executive.language.grammar import EnglishInterpreter
from executive.types import Command, CommandKind


@dataclass(frozen=True)
class Reads(EnglishInterpreter):
    """These words mean these commands; all else is read as ever."""

    commands: Mapping[str, Command] = field(default_factory=dict)

    def command(self, words: str) -> Command | None:
        """The command that was laid down."""
        return self.commands.get(words) or super().command(words)


def reading(words: str, kind: str, target: str = "", source: str = "", goal: str = "") -> Change:
    """Change the parts so that these words are read so."""
    command = Command(CommandKind(kind), target, words, source, goal)

    def change(parts: Parts) -> Parts:
        before = parts.interpreter
        known = before.commands if isinstance(before, Reads) else {}
        return replace(parts, interpreter=Reads({**known, words: command}))

    return change
