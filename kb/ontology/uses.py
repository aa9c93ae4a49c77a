"""Finds things by purpose: whether a stated use serves what is asked for."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

from executive.language.phrases import PREPOSITIONS, Words, words_of

PURPOSE_WORDS = ("to", "for")
"""A use begins with one of these: "to drink from", "for nails"."""
_STRANDED = PREPOSITIONS | {"into", "onto", "with"}
_INSTRUMENT = "with"
"""This one may be omitted: "for cleaning" means "to clean with"."""
_SHORTEST_GERUND = 6


@dataclass(frozen=True, slots=True)
class Purpose:
    """The stems of the content words, and the preposition at the end, if there is one."""

    words: Words
    end: str

    def serves(self, asked: "Purpose") -> bool:
        """Whether this use serves the purpose: "to clean with", "clean the bathroom with".

        The purpose may name an object that the use leaves open. Both must end with the same
        preposition: what is "to eat" is not for eating with.
        """
        ends_alike = asked.end == self.end or (not asked.end and self.end == _INSTRUMENT)
        begin_alike = bool(self.words) and self.words[:1] == asked.words[:1]
        return begin_alike and ends_alike and _is_within(self.words, asked.words)


class Uses:
    """Finds the things that serve a purpose."""

    def __init__(self, used: Iterable[tuple[str, Sequence[str]]]) -> None:
        """Index the things; `used` are pairs of a name and its uses."""
        self._order: list[str] = []
        self._of: dict[Purpose, list[str]] = {}
        for name, uses in used:
            self._order.append(name)
            for use in uses:
                self._of.setdefault(purpose_of(use), []).append(name)

    def serving(self, purpose: str) -> tuple[str, ...]:
        """The names of the things for this purpose, in their order."""
        asked = purpose_of(purpose)
        fit = {name for use, names in self._of.items() if use.serves(asked) for name in names}
        return tuple(filter(fit.__contains__, self._order))


def purpose_of(text: str) -> Purpose:
    """Parse a purpose."""
    words = [word for word in words_of(text) if word not in PURPOSE_WORDS]
    end = words.pop() if words and words[-1] in _STRANDED else ""
    return Purpose(tuple(map(_verb_stem, words)), end)


def _verb_stem(word: str) -> str:
    """A stem that a verb shares with its gerund: "cutting", "cut" -> "cut"."""
    if len(word) >= _SHORTEST_GERUND:
        word = word.removesuffix("ing")
    return word[:-1] if len(word) > 2 and word[-1] == word[-2] else word


def _is_within(some: Words, words: Words) -> bool:
    """Whether some words occur among others, in the same order."""
    rest: Iterator[str] = iter(words)
    return all(word in rest for word in some)
