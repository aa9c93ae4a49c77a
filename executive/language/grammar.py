"""Reads English as the tree needs it: what is commanded, answered, said for its own sake."""

from collections.abc import Iterable, Sequence
from functools import cache

from executive.language.commands import agrees, command_in, talk
from executive.language.meaning import Answer, Choice, Request, Task, Unread, Verb
from executive.language.reader import english
from executive.language.slips import without_slips
from executive.types import Command


class EnglishInterpreter:
    """Reads commands such as "Bring a sugar_box", "Could you fetch me the mug, please?".

    Args:
        names: of the things and places that there are: a name with words in it that mean something
            else ("salt and pepper") is read as one.
    """

    def __init__(self, names: Iterable[str] = ()) -> None:
        """Build what reads, which takes longest of all."""
        odd = tuple(sorted({name for name in names if not _is_read(name)}))
        self._reader = english(odd) if odd else english()

    def command(self, words: str) -> Command | None:
        """The request in the words, or None if there is none that can be done."""
        read = self._read(words)
        return read if isinstance(read, Command) else None

    def remark(self, words: str) -> str:
        """What to say of words that were read and are no command to carry out; empty if they are.

        It is empty, too, if they were not read: then somebody else may.
        """
        read = self._read(words)
        return read if isinstance(read, str) else ""

    def _read(self, words: str) -> Command | str | None:
        """The command; or what to say; nothing to say if somebody else may read it."""
        read = command_in(self._reader.read(words), words)
        denial = ""
        if read is None:
            denial = self._reader.denial(words)
        elif isinstance(read, Command):
            names = (read.target, read.source, read.goal, read.purpose, *read.exceptions)
            denial = next(filter(None, map(self._reader.denial_in_name, names)), "")
        if denial:
            return f"I do nothing: I hear '{denial}', and do not understand the rest."
        return read

    def talk(self, words: str, things: Sequence[str] = ()) -> str:
        """The answer to small talk, or to who asks for help; empty if it is neither."""
        return talk(self._reader.read(words), things)

    def without_slips(self, words: str) -> Command | None:
        """The command that the words are with the word for the deed spelled right; None if none."""
        for likely in without_slips(self._reader, words):
            if command := self.command(likely):
                return command
        return None

    def declines(self, answer: str) -> bool:
        """Whether an answer says that the person does not know or will not say."""
        if self._reader.declines(answer) or not self._reader.plain(answer).strip("?"):
            return True
        declining = (Answer(Choice.NO), Answer(Choice.UNKNOWN))
        return self._reader.knows(answer) and self._reader.read(answer) in declining

    def agrees(self, answer: str) -> bool | None:
        """Whether an answer says yes or no; None if it says neither."""
        if not self._reader.knows(answer):
            return None
        said = self._reader.read(answer)
        if (agreed := agrees(said)) is not None or not isinstance(said, Unread | Request):
            return agreed
        first, _, rest = self._reader.plain(answer).partition(" ")
        begun = agrees(self._reader.read(first))
        return None if begun and self._reader.denial(rest) else begun


@cache
def _is_read(name: str) -> bool:
    """Whether the grammar reads a name as one, without being told."""
    if not english().knows(name):
        return True
    match english().read(f"find {name}"):
        case Request(tasks=(Task(verb=Verb.FIND, things=things, source=None, goal=None),)):
            assert things
            return [thing.said for thing in things.members] == [english().plain(name)]
    return False
