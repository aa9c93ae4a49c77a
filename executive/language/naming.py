"""Names that cannot be spoken of, because who says them is heard to say something else."""

from functools import cache

from executive.language.control import Control, control
from executive.language.grammar import EnglishInterpreter
from executive.language.meaning import (
    Answer,
    Correction,
    Refusal,
    Request,
    Task,
    Thing,
    Things,
    Unread,
)
from executive.language.phrases import CLAUSE_ENDS, MOST_WORDS, NEGATION, place_words, spoken
from executive.language.reader import english

Fault = tuple[str, str]
"""What is wrong with a name, as a clause, and what would be right."""

_OTHER = "give another name"
_OFTEN_SAID = "where is it", "how many are there", "please find it", "bring two mugs"


def heard_as(name: str) -> str | None:
    """What somebody who says only this name tells the robot, as a clause; None if nothing else."""
    words = spoken(name)
    if said := control(words):
        return "tells the robot to stop" if said is Control.STOP else "ends the session"
    if _is_mere_name(words):
        return None
    if _english().declines(words):
        return "says that somebody does not know"
    if _says_yes_or_no(words):
        return "says yes or no"
    if _is_pronoun(words):
        return "says what was spoken of before"
    return "has only words that say something else" if _says_something_else(words) else None


def says_how_many(name: str) -> bool:
    """Whether somebody who asks for a thing of this name asks for several: "two mugs"."""
    words = spoken(name)
    commands = () if _is_mere_name(words) else _english().commands(f"find {words}")
    return any(command.number for together in commands for command in together)


def place_fault(name: str) -> Fault | None:
    """Why no answer can name a place that is called this; None if one can."""
    words = spoken(name)
    telling = place_words(words)
    if not telling:
        return "it has no word that says which place it is", "add one, as in corner_desk"
    if meaning := heard_as(name):
        return f"this name has a meaning of its own: it {meaning}", _OTHER
    if denial := NEGATION.search(words):
        return f"an answer with {denial[0]!r} in it names no place", f"leave {denial[0]!r} out"
    if end := CLAUSE_ENDS.search(words):
        return f"{end[0]!r} would be read as the end of the name", f"leave {end[0]!r} out"
    if len(telling) > MOST_WORDS:
        return f"it has more than {MOST_WORDS} words", "shorten it"
    return None


def _is_mere_name(words: str) -> bool:
    """Whether none of the words means anything else: so it is with most, and reading takes long."""
    return not english().knows(words) and not english().declines(words)


def _says_yes_or_no(words: str) -> bool:
    """Whether all of it is a yes or no: "of course", but not "right shelf"."""
    *before, _ = words.split() or [""]
    begun = " ".join(before)
    agrees = _english().agrees
    return agrees(words) is not None and (not begun or agrees(begun) is None)


def _is_pronoun(words: str) -> bool:
    """As "it" and "that one" are."""
    match _english().read(f"bring {words}"):
        case Request(tasks=(Task(things=Things(members=(Thing(pronoun=True),)), goal=None),)):
            return True
    return False


def _says_something_else(words: str) -> bool:
    """As "find it" does; or others are read otherwise in a home with such a name, as "where"."""
    plain = english()
    if not plain.vocabulary.issuperset(words.split()):
        return False
    match plain.read(words):
        case Answer() | Unread() | Refusal() | Correction():
            told = english((words,))
            return any(told.read(said) != plain.read(said) for said in _OFTEN_SAID)
    return True


@cache
def _english() -> EnglishInterpreter:
    """Built when it is first needed, which takes a while."""
    return EnglishInterpreter()
