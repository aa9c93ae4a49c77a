"""Furniture and things of a home, other places, and what all of them are called."""

from dataclasses import dataclass

PERSON = "person"
"""Where the robot stands when it speaks with the person; not furniture."""
DELIVERY = "delivery"
"""The place near the person where brought things are put down; not searched like furniture."""
FLOOR = "floor"
"""The floor around the robot, wherever it stands: where to look for what fell from the hand."""
HAND = "hand"
"""The place of a thing that the robot holds."""
SOMETHING = "something"
"""The thing in the hand, if the fingers feel one and nobody knows which."""


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
    """What the robot calls it ("Anna's desk"); empty: use the name."""
    room_label: str = ""
    """The same for the room."""


@dataclass(frozen=True, slots=True)
class Thing:
    """An object that the home file declares because the ontology does not have it."""

    name: str
    kind: str
    """Its class in the ontology: `Kitchenware`, `Toy`, ..."""
    color: str = ""
    """The name of its colour, one of `executive.colors.COLORS`; empty if the file gives none."""


@dataclass(frozen=True, slots=True)
class Called:
    """What an object, a class or a piece of furniture is called in a sentence."""

    words: str
    """Without an article: "sugar box"."""
    plural: bool = False
    """Whether the verb is "are", as for scissors."""
    bare: bool = False
    """Whether it takes no article, like a class of things: "fruit"."""
    preposition: str = "on"
    """Of furniture: whether things are "in" or "on" it."""
    room: str = ""
    """Of furniture: what its room is called; empty if `words` say it."""
    says_room: bool = False
    """Whether the words alone are ambiguous, so that the room must be said."""


@dataclass(frozen=True, slots=True)
class OtherColor:
    """Things with the name that the person said, but with none of the colours that they said."""

    wanted: tuple[str, ...]
    """The colours that the person said."""
    actual: tuple[tuple[str, tuple[str, ...]], ...]
    """Each thing with its colours."""
