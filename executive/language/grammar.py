"""Reads English as the tree needs it: what is commanded, answered, said for its own sake."""

from collections.abc import Iterable, Sequence
from functools import cache, lru_cache
from itertools import chain

from executive.language.commands import NOT_KNOWN_WHAT, agrees, commands_in, talk
from executive.language.meaning import (
    Answer,
    Choice,
    Correction,
    Request,
    Said,
    Task,
    Unable,
    Unread,
)
from executive.language.pronouns import resolved
from executive.language.reader import AT_A_TIME, Reader, english
from executive.language.slips import brought, put_there, without_slips
from executive.language.spoken import NOTHING, Spoken
from executive.types.commands import Command, CommandKind, Commands

_CHOOSES = (Choice.ANY, Choice.NEAREST, Choice.ALL, Choice.BOTH)


class EnglishInterpreter:
    """Reads commands such as "Bring a sugar_box", "Could you fetch me the mug, please?".

    Args:
        names: of the things and places that there are: a name with words in it that mean something
            else ("salt and pepper") is read as one.
    """

    def __init__(self, names: Iterable[str] = ()) -> None:
        """Build what reads, which takes longest of all."""
        self._reader, self._known = _reader_of(tuple(names))

    def read(self, words: str) -> Said:
        """What the words mean, as far as the grammar reads them."""
        return self._reader.read(words)

    def commands(self, words: str, spoken: Spoken = NOTHING, *, holds: bool = False) -> Commands:
        """The tasks in the words; none if there are none that can be done."""
        read = self._read(words, spoken, holds)
        return read if isinstance(read, tuple) else ()

    def command(self, words: str) -> Command | None:
        """The first of the tasks, or None if there are none."""
        commands = self.commands(words)
        return commands[0][0] if commands else None

    def remark(self, words: str, spoken: Spoken = NOTHING) -> str:
        """What to say of words that were read and are no command to carry out; empty if they are.

        It is empty, too, if they were not read: then somebody else may.
        """
        read = self._read(words, spoken, False)
        return read if isinstance(read, str) and not self._reader.likely(words) else ""

    def _read(self, words: str, spoken: Spoken, holds: bool) -> Commands | str | None:
        """The tasks; or what to say; nothing to say if somebody else may read it."""
        said = resolved(self._reader.read(words), spoken, holds=holds)
        if isinstance(said, Request) and said.later:  # than what? Nothing is under way
            said = Unable(AT_A_TIME)
        read, denial = self._with_denial(said, words)
        return f"I do nothing: {NOT_KNOWN_WHAT.format(denial)}" if denial else read

    def denial(self, words: str) -> str:
        """A word among them that denies, if it is not known what; empty if there is none."""
        return self._with_denial(self._reader.read(words), words)[1]

    def _with_denial(self, said: Said, words: str) -> tuple[Commands | str | None, str]:
        """What is made of words that were read so; and a word that denies, it is not known what."""
        read = commands_in(said, words)
        names = _names_in(read) if isinstance(read, tuple) else []
        if self._is_other_language(words, names):
            read = None
        denial = next(filter(None, map(self._reader.denial_in_name, names)), "")
        return read, denial or ("" if read is not None else self._reader.denial(words))

    def _is_other_language(self, words: str, names: Iterable[str]) -> bool:
        """Whether what was read as English is not, but for names that are known in any language."""
        is_other = self._reader.is_other_language
        return is_other(words) and any(is_other(n) for n in names if n and n not in self._known)

    def not_understood(self, words: str) -> str:
        """Why nobody could read the words, as a clause."""
        said = f"'{words}'" if words.strip() else "what you said"
        if self._reader.is_other_language(words):
            return f"I speak only English, and do not understand {said}"
        return f"I do not understand {said}"

    def talk(self, words: str, things: Sequence[str] = ()) -> str:
        """The answer to small talk, or to who asks for help; empty if it is neither."""
        return talk(self._reader.read(words), things)

    def passed_over(self, words: str, commands: Sequence[Command]) -> tuple[str, ...]:
        """Numbers and conditions in words that somebody else has read, and none of the commands."""
        named = " ".join(name for one in commands for name in named_in(one)).split()
        numbers = {one.number for one in commands}
        conditions = self._reader.conditions(words) * (not any(one.conditional for one in commands))
        counts = (said for said, n in self._reader.numbers(words) if n not in numbers)
        return tuple(dict.fromkeys(w for w in (*counts, *conditions) if w not in named))

    def without_slips(self, words: str) -> Commands:
        """The tasks that the words probably are, as with the word for the deed spelled right."""
        if (said := self._reader.likely(words)) and isinstance(
            likely := commands_in(said, words), tuple
        ):
            return likely
        ways = (without_slips, brought, put_there)
        for likely in chain.from_iterable(way(self._reader, words) for way in ways):
            if commands := self.commands(likely):
                return commands
        return ()

    def declines(self, answer: str) -> bool:
        """Whether an answer says that the person does not know or will not say."""
        said = self._reader.read(answer)
        if isinstance(said, Answer) and said.choice in _CHOOSES:
            return False  # "I do not mind"
        if isinstance(said, Correction):
            return False  # "none of them, the mug"
        if self._reader.declines(answer) or not self._reader.plain(answer).strip("?"):
            return True
        declining = (Answer(Choice.NO), Answer(Choice.UNKNOWN))
        return self._reader.knows(answer) and said in declining

    def only(self, words: str) -> bool:
        """Whether it says that nothing else is meant: "only the mug", "no, just the pear"."""
        return self._reader.only(words)

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

    def after_yes(self, answer: str) -> Said:
        """What is said behind a yes: "yes, and the pear"; what does not begin so is not read."""
        first, _, rest = self._reader.plain(answer).partition(" ")
        agreed = agrees(self._reader.read(first)) is True
        return self._reader.read(rest) if agreed and rest else Unread(answer)


def _names_in(commands: Commands) -> list[str]:
    return [*chain.from_iterable(named_in(one) for group in commands for one in group)]


def named_in(command: Command) -> tuple[str, ...]:
    """All that a command names."""
    return command.target, command.source, command.goal, command.purpose, *command.exceptions


@lru_cache(maxsize=16)
def _reader_of(names: tuple[str, ...]) -> tuple[Reader, frozenset[str]]:
    """What reads, and these names as it writes them: of every mission in a home the same."""
    odd = tuple(sorted({name for name in names if not _is_read(name)}))
    reader = english(odd) if odd else english()
    return reader, frozenset(map(reader.plain, names))


@cache
def _is_read(name: str) -> bool:
    """Whether the grammar reads a name as one, without being told."""
    if english().denial_in_name(name):
        return False
    if not english().knows(name):
        return True
    match english().read(f"find {name}"):
        case Request(tasks=(Task(verb=CommandKind.FIND, things=things, source=None, goal=None),)):
            assert things
            return [thing.said for thing in things.members] == [english().plain(name)]
    return False
