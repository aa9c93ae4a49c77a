"""The person, and who reads what they say."""

from collections.abc import Sequence
from typing import Protocol

from executive.language.meaning import Said
from executive.language.spoken import NOTHING, Spoken
from executive.types.commands import Command, Commands
from executive.types.dialogue import Question


class User(Protocol):
    """The person, or who stands in for them."""

    def ask(self, question: Question) -> int:
        """Put a question; ends Answered, or Failed if no answer can come.

        An answer that says stop stops the mission: `Inbox.end` sees to that.
        """
        ...

    def cancel(self, request: int) -> None:
        """Withdraw the question."""
        ...

    def tell(self, text: str) -> None:
        """Say something that needs no answer."""
        ...


class Interpreter(Protocol):
    """Reads what a person says."""

    def read(self, words: str) -> Said:
        """What the words mean, as far as they can be read."""
        ...

    def commands(self, words: str, spoken: Spoken = NOTHING, *, holds: bool = False) -> Commands:
        """The tasks in the words; none if there are none that can be done.

        Args:
            words: what was said.
            spoken: of what was spoken before: "it", "there" and "another" stand for that.
            holds: whether the hand holds something.
        """
        ...

    def command(self, words: str) -> Command | None:
        """The first of the tasks in the words, or None if there are none."""
        ...

    def remark(self, words: str, spoken: Spoken = NOTHING) -> str:
        """What to say of words that were read and are no command to carry out; empty otherwise.

        Nobody else may make a command of them then: they may say what is not to be done.
        """
        ...

    def denial(self, words: str) -> str:
        """A word among them that denies, if it is not known what; empty if there is none."""
        ...

    def not_understood(self, words: str) -> str:
        """Why nobody could read the words, as a clause: they are of another language, for one."""
        ...

    def passed_over(self, words: str, commands: Sequence[Command]) -> tuple[str, ...]:
        """Numbers and conditions in words that somebody else has read, and none of the commands."""
        ...

    def without_slips(self, words: str) -> Commands:
        """The tasks that the words are with the word for the deed spelled right; none if none."""
        ...

    def talk(self, words: str, things: Sequence[str] = ()) -> str:
        """The answer to small talk, or to who asks for help; empty if it is neither.

        Args:
            words: what was said.
            things: names of things of this home, for examples.
        """
        ...

    def after_yes(self, answer: str) -> Said:
        """What is said behind a yes: "yes, and the pear"; `Unread` if it does not begin so."""
        ...

    def only(self, words: str) -> bool:
        """Whether it says that nothing else is meant: "only the mug", "no, just the pear"."""
        ...

    def declines(self, answer: str) -> bool:
        """Whether an answer says that the person does not know or will not say."""
        ...

    def agrees(self, answer: str) -> bool | None:
        """Whether an answer says yes or no; None if it says neither."""
        ...
