"""What things and places are called when one speaks of them: article, number, preposition, room."""

import re
from collections.abc import Callable, Iterable, Sequence

from executive.types.home import DELIVERY, FLOOR, PERSON, SOMETHING, Called

_OURS = {
    DELIVERY: Called("delivery table"),
    FLOOR: Called("floor"),
    PERSON: Called("you", bare=True),
    SOMETHING: Called("something", bare=True),
}
"""What is in no ontology."""
_IDENTIFIER = re.compile(rf"(?:\bthe )?\b([^\W_]+(?:_[^\W_]+)+)\b|\bthe ({DELIVERY})\b(?! table)")
_ARTICLES = ("the", "a", "an", "my", "our", "your")
"""And what stands for one."""
_POSSESSIVE = re.compile(r"['’]s?$")


class Wording:
    """Words for names.

    Args:
        called: tells what a thing or a place of this name is called; None: there is none such.
    """

    def __init__(self, called: Callable[[str], Called | None]) -> None:
        """Ask this for every name."""
        self._called = called

    def words(self, name: str) -> str:
        """Without an article: "sugar box"."""
        return self._of(name).words

    def the(self, name: str) -> str:
        """A thing or a place, with its room if it takes that to know it: "the sugar box"."""
        called = self._of(name)
        return _in_room(called) if called.says_room else _the(called)

    def label(self, name: str) -> str:
        """The same without an article: "cabinet in the kitchen"."""
        called = self._of(name)
        if called.says_room and called.room:
            return f"{called.words} in {_with_article(called.room)}"
        return called.words

    def are(self, name: str) -> str:
        """As in "the mug is", "the scissors are"."""
        return f"{self.the(name)} {self.is_(name)}"

    def is_(self, name: str) -> str:
        """The verb that goes with it."""
        return self.agree(name, "is", "are")

    def it(self, name: str) -> str:
        """The pronoun for it, as an object."""
        return self.agree(name, "it", "them")

    def agree(self, name: str, singular: str, plural: str) -> str:
        """What goes with it: "belongs", or "belong" of the scissors."""
        return plural if self._of(name).plural else singular

    def at(self, place: str) -> str:
        """Where something is that is there: "on the high table", "in the refrigerator"."""
        return f"{self._of(place).preposition} {self.the(place)}"

    def at_in_full(self, place: str) -> str:
        """The same with the room: "on the high table in the kitchen"."""
        return f"{self._of(place).preposition} {self.in_full(place)}"

    def in_full(self, place: str) -> str:
        """A place with its room: "the high table in the kitchen"."""
        return _in_room(self._of(place))

    def stands(self, place: str) -> str:
        """In which room it is, as a clause: "the sofa is in the living room"."""
        called = self._of(place)
        return f"{_the(called)} {self.is_(place)} in {_with_article(called.room)}"

    def at_each(self, places: Iterable[str]) -> list[str]:
        """The same of several, to be said one after the other: "on the sofa", "the bed"."""
        said, before = [], ""
        for place in places:
            preposition = self._of(place).preposition
            said.append(self.the(place) if preposition == before else self.at(place))
            before = preposition
        return said

    def any_of(self, names: Iterable[str]) -> str:
        """One of these things or places: "the apple, the pear or the mug"."""
        return either([self.the(name) for name in names])

    def in_words(self, text: str) -> str:
        """A text of who knows only names, in words: "the cabinet_kitchen" is "the cabinet ..."."""

        def spoken(found: re.Match[str]) -> str:
            name = found[1] or found[2]
            return self.the(name) if name in _OURS or self._called(name) else found[0]

        return _IDENTIFIER.sub(spoken, text)

    def _of(self, name: str) -> Called:
        return _OURS.get(name) or self._called(name) or Called(name.replace("_", " "))


def beginning(text: str) -> str:
    """A clause as a sentence begins."""
    return text[:1].upper() + text[1:]


def either(words: Sequence[str]) -> str:
    """One of these: "apple, pear or mug"."""
    return _joined(words, "or")


def listed(words: Sequence[str]) -> str:
    """All of these: "apple, pear and mug"."""
    return _joined(words, "and")


WITHOUT_KNOWLEDGE = Wording(lambda name: None)
"""Says the words of a name, where there is nobody to ask what it is called."""


def _joined(words: Sequence[str], last: str) -> str:
    return f" {last} ".join(filter(None, (", ".join(words[:-1]), *words[-1:])))


def as_said(text: str, words: str) -> str:
    """Words that were read, as they were said in a text: "under desk" is "under the desk"."""
    parts = [re.escape(word) for word in words.split()]
    gap = rf"(?:\W|_)+(?:(?:{'|'.join(_ARTICLES)})\W+)?"
    found = re.search(rf"(?<!\w){gap.join(parts)}(?!\w)", text, re.IGNORECASE) if parts else None
    return found[0] if found else words


def _the(called: Called) -> str:
    return called.words if called.bare else _with_article(called.words)


def _in_room(called: Called) -> str:
    return f"{_the(called)} in {_with_article(called.room)}" if called.room else _the(called)


def _with_article(words: str) -> str:
    """What has one, a number or an owner goes without: "the den", "bedroom 2", "Anna's desk"."""
    first, last = words.partition(" ")[0], words.rpartition(" ")[2]
    owned = first.lower() in _ARTICLES or _POSSESSIVE.search(first)
    bare = not words or last.isdecimal() or owned
    return words if bare else f"the {words}"
