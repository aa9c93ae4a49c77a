"""Interfaces to the person, and to the parser of what they say."""

from collections.abc import Sequence
from typing import Protocol

from executive.language.meaning import Said
from executive.language.spoken import NOTHING, Spoken
from executive.types.commands import Command, Commands
from executive.types.dialogue import Question


class User(Protocol):
    """The person, or a stand-in for them."""

    def ask(self, question: Question) -> int:
        """Ask a question; ends Answered, or Failed if no answer can come.

        An answer that says stop ends the mission; `Inbox.end` detects it.
        """
        ...

    def cancel(self, request: int) -> None:
        """Withdraw the question."""
        ...

    def tell(self, text: str) -> None:
        """Say something that needs no answer."""
        ...


class Interpreter(Protocol):
    """Parses what a person says."""

    def read(self, words: str) -> Said:
        """Parse the words; `Unread` if they cannot be parsed."""
        ...

    def commands(self, words: str, spoken: Spoken = NOTHING, *, holds: bool = False) -> Commands:
        """The tasks in the words; empty if there are none that can be done.

        Args:
            words: what the person said.
            spoken: what was spoken of before, to resolve "it", "there" and "another".
            holds: whether the hand holds something.
        """
        ...

    def command(self, words: str) -> Command | None:
        """The first task in the words; None if there is none."""
        ...

    def remark(self, words: str, spoken: Spoken = NOTHING) -> str:
        """The reply to words that were parsed and are not a command to carry out; empty otherwise.

        A language model must not read a command into such words: they may say what not to do.
        """
        ...

    def denial(self, words: str) -> str:
        """A negating word whose scope is unclear; empty if there is none."""
        ...

    def not_understood(self, words: str) -> str:
        """Why the words could not be parsed, as a clause: for example, another language."""
        ...

    def passed_over(self, words: str, commands: Sequence[Command]) -> tuple[str, ...]:
        """Numbers and conditions in the words that the commands, read by a model, leave out."""
        ...

    def without_slips(self, words: str) -> Commands:
        """The tasks in the words with slips corrected, such as a misspelt verb; empty if none."""
        ...

    def talk(self, words: str, things: Sequence[str] = ()) -> str:
        """The answer to small talk or to a request for help; empty if the words are neither.

        Args:
            words: what the person said.
            things: names of things in this home, to use as examples.
        """
        ...

    def after_yes(self, answer: str) -> Said:
        """What follows a yes: "yes, and the pear"; `Unread` if the answer begins otherwise."""
        ...

    def only(self, words: str) -> bool:
        """Whether the words exclude everything else: "only the mug", "no, just the pear"."""
        ...

    def declines(self, answer: str) -> bool:
        """Whether an answer says that the person does not know, or will not say."""
        ...

    def agrees(self, answer: str) -> bool | None:
        """True if an answer says yes, False if it says no, None if neither."""
        ...
