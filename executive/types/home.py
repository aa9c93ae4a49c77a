"""What is in a home, where else the robot or a thing may be, and what all that is called."""

from dataclasses import dataclass

PERSON = "person"
"""Where the robot stands when it speaks with the person; it is no furniture."""
DELIVERY = "delivery"
"""The place by the person where brought things are put down; it is no furniture to search."""
FLOOR = "floor"
"""The floor around the robot, wherever it is: a place to look at, for what fell from the hand."""
HAND = "hand"
"""Where a thing is that the robot holds, for those who ask where it is."""
SOMETHING = "something"
"""In the hand, as far as the fingers feel, but nobody knows what."""


@dataclass(frozen=True, slots=True)
class Place:
    """A piece of furniture that things may be on or in, as the home file names it."""

    name: str
    kind: str
    """Its class in the ontology: `Table`, `Cabinet`, `Shelf`, ..."""
    room: str
    """Name of the room that it stands in."""
    room_kind: str
    """The room's class in the ontology: `Kitchen`, `Bedroom`, ..."""
    label: str = ""
    """What the robot calls it ("Anna's desk"); empty: what its name says."""
    room_label: str = ""
    """The same of the room."""


@dataclass(frozen=True, slots=True)
class Thing:
    """An object that the home file declares, since no file of the ontology does."""

    name: str
    kind: str
    """Its class in the ontology: `Kitchenware`, `Toy`, ..."""
    color: str = ""
    """What its colour is called, one of `executive.colors.COLORS`; empty if nobody gave one."""


@dataclass(frozen=True, slots=True)
class Called:
    """What a thing or a piece of furniture is called when one speaks of it."""

    words: str
    """Without an article: "sugar box"."""
    plural: bool = False
    """Whether one says "are" of it, as of scissors."""
    bare: bool = False
    """Whether it has no article, as a class of things: "fruit"."""
    preposition: str = "on"
    """How things are with it, if it is furniture: "in" or "on"."""
    room: str = ""
    """What the room is called that it stands in; empty if the words say so, or it is a thing."""
    says_room: bool = False
    """Whether nobody would know it without the room."""


@dataclass(frozen=True, slots=True)
class OtherColor:
    """Things that are called as was said, and have none of the colours that were said."""

    wanted: tuple[str, ...]
    """The colours that were said."""
    actual: tuple[tuple[str, tuple[str, ...]], ...]
    """Each thing, and its own colours."""
