"""Finds things by their appearance: "the yellow bottle", "the red one"."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from enum import Flag, auto
from itertools import chain

from executive.colors import COLORS, OTHER_SPELLINGS
from executive.language.phrases import MOST_WORDS, words_of
from executive.types.home import OtherColor

LONGEST = 20
"""Words; a longer text is not treated as a description."""
MOST_TOLD = 6
"""Things that are told to have another colour; if more would match, that helps nobody."""


class Role(Flag):
    """The role of a word in a description."""

    NAME = auto()
    PRONOUN = auto()
    COLOR = auto()
    SHAPE = auto()


PROPERTY = Role.COLOR | Role.SHAPE


@dataclass(frozen=True, slots=True)
class Look:
    """The appearance of an object: colours and shapes in all languages; `said`: colours to say."""

    name: str
    colors: tuple[str, ...]
    shapes: tuple[str, ...]
    said: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Description:
    """The names, colours and shapes in a description; each is written as one word."""

    names: list[str] = field(default_factory=list)
    colors: list[str] = field(default_factory=list)
    shapes: list[str] = field(default_factory=list)


class Descriptions:
    """Finds the objects that match a description.

    Every word counts: if one is neither a name nor a property, nothing matches.
    """

    def __init__(
        self,
        named: Mapping[str, Sequence[str]],
        looks: Iterable[Look],
        pronouns: Iterable[str],
    ) -> None:
        """Index the words.

        Args:
            named: names (as one word), with the objects of this name.
            looks: the appearance of each object.
            pronouns: words that stand for any object.
        """
        self._named = named
        self._looks = {look.name: look for look in looks}
        every = list(self._looks.values())
        self._colors = {joined(c): c for look in every for c in (*look.colors, *look.said)}
        for color in (*COLORS, *OTHER_SPELLINGS) if self._colors else ():
            self._colors.setdefault(joined(color), color)
        self._of_color = {n: _spellings(look.colors) for n, look in self._looks.items()}
        self._of_shape = {n: set(map(joined, look.shapes)) for n, look in self._looks.items()}
        self._roles: dict[str, Role] = {}
        for role, pieces in (
            (Role.NAME, named),
            (Role.PRONOUN, map(joined, pronouns)),
            (Role.COLOR, self._colors),
            (Role.SHAPE, chain.from_iterable(self._of_shape.values())),
        ):
            for piece in pieces:
                self._roles[piece] = self._roles.get(piece, Role(0)) | role

    def find(self, words: str) -> tuple[str, ...]:
        """The objects that match the words, which must contain a property."""
        description = self._read(words)
        return tuple(self._colored(description)) if description else ()

    def other_color(self, words: str) -> OtherColor | None:
        """The objects that would match but for the colour in the words.

        None if any object matches, if there are more than `MOST_TOLD`, or if one has no colour.
        """
        description = self._read(words)
        if not description or not description.colors or any(self._colored(description)):
            return None
        shaped = [self._looks[name] for name in self._shaped(description)]
        if not 0 < len(shaped) <= MOST_TOLD or not all(look.said for look in shaped):
            return None
        wanted = tuple(self._colors[color] for color in description.colors)
        return OtherColor(wanted, tuple((look.name, look.said) for look in shaped))

    # --- inside ---

    def _colored(self, description: Description) -> Iterator[str]:
        for name in self._shaped(description):
            if self._of_color[name].issuperset(description.colors):
                yield name

    def _shaped(self, description: Description) -> Iterator[str]:
        among = self._named[description.names[0]] if description.names else self._looks
        for name in among:
            if self._of_shape[name].issuperset(description.shapes):
                yield name

    def _read(self, words: str) -> Description | None:
        """Parse a description; None for an unknown word, no property, or several names."""
        pieces = list(self._pieces(words))
        described = Description()
        into = {
            Role.NAME: described.names,
            Role.COLOR: described.colors,
            Role.SHAPE: described.shapes,
        }
        noun = any(not roles & PROPERTY for _, roles in pieces)
        for number, (piece, roles) in enumerate(pieces, start=1):
            role = _one_of(roles, may_name=number == len(pieces) and not noun)
            if role is None:
                return None
            into.get(role, []).append(piece)
        if len(described.names) > 1 or not (described.colors or described.shapes):
            return None
        return described

    def _pieces(self, words: str) -> Iterator[tuple[str, Role]]:
        """The longest known pieces from the left, with their roles; ends after an unknown one."""
        rest, begin = words_of(words), 0
        if len(rest) > LONGEST:
            rest = ()
        while begin < len(rest):
            for end in range(min(begin + MOST_WORDS, len(rest)), begin, -1):
                if roles := self._roles.get(piece := "".join(rest[begin:end]), Role(0)):
                    break
            yield piece, roles
            begin = end if roles else len(rest)


def joined(text: str) -> str:
    """The stems of a text, joined to one word."""
    return "".join(words_of(text))


def _spellings(colors: Iterable[str]) -> set[str]:
    """The colours as one word each, in all spellings."""
    known = set(map(joined, colors))
    return known | {also for also, color in OTHER_SPELLINGS.items() if color in known}


def _one_of(roles: Role, *, may_name: bool) -> Role | None:
    """The role of a word: a property, if possible; but the orange in "the red orange" is a name."""
    if may_name and Role.NAME in roles:
        return Role.NAME
    for role in (Role.COLOR, Role.SHAPE, Role.PRONOUN, Role.NAME):
        if role in roles:
            return role
    return None
