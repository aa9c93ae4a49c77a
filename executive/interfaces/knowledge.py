"""Sources of knowledge: the ontology, the robot's memory, and sources of others."""

from collections.abc import Iterable, Mapping, Sequence
from typing import Protocol

from executive.belief import Statement
from executive.types.home import Called, OtherColor, Place


class Knowledge(Protocol):
    """The ontology: the known things, their names, and where they usually are."""

    def places(self) -> tuple[Place, ...]:
        """All furniture of the home, in the home file's order."""
        ...

    def has_place(self, name: str) -> bool:
        """Whether the home has a piece of furniture with this name."""
        ...

    def called(self, name: str) -> Called | None:
        """What an object, a class or a piece of furniture is called; None if it is unknown."""
        ...

    def objects_named(self, words: str) -> tuple[str, ...]:
        """All objects that the words may mean: none, one, or several ("fruit", "the red one")."""
        ...

    def other_color(self, words: str) -> OtherColor | None:
        """What the words mean without their colour: for "blue mug", the mug that is red.

        None if they name no colour, or something has it, or nothing matches without it.
        """
        ...

    def objects_for(self, purpose: str) -> tuple[str, ...]:
        """The objects for this purpose: "to drink from", "clean the bathroom with", "nails"."""
        ...

    def colors(self, name: str) -> tuple[str, ...]:
        """The names of an object's colours, the main one first."""
        ...

    def uses(self, name: str) -> tuple[str, ...]:
        """The purposes of an object: "to drink from", "for tea"."""
        ...

    def nearest_names(self, words: str) -> tuple[str, ...]:
        """The known names most similar to the words, best first (at most 3)."""
        ...

    def near_name(self, words: str) -> str | None:
        """The known name that the words most likely misspell; None if that is unclear."""
        ...

    def names_in(self, words: str) -> tuple[str, ...]:
        """The names of objects and classes that occur in a text, in order."""
        ...

    def preferred(self, names: Sequence[str]) -> tuple[str, ...]:
        """The objects among `names` that the resident prefers; empty if the resident is unknown."""
        ...

    def usual_places(self, name: str) -> tuple[str, ...]:
        """Default locations of the object, or of its nearest class, that exist in this home."""
        ...

    def likely_places(self, name: str) -> Mapping[str, float]:
        """The share of the object's default locations for each place of this home.

        A default location that was recorded for this home matches the place of that name; any
        other matches the places of its kind. The sum is at most 1: less if this home has no place
        for some of them.
        """
        ...

    def places_named(self, words: str) -> tuple[str, ...]:
        """The furniture that the words name, in order; a room counts as all its furniture."""
        ...

    def is_place(self, words: str) -> bool:
        """Whether the words name only furniture or rooms: not so for "Anna in the kitchen"."""
        ...


class Facts(Protocol):
    """The memory: what was seen, said and done in this mission and before. Never raises."""

    def saw(self, names: Iterable[str], place: str) -> None:
        """Note that these objects were seen at the place."""
        ...

    def missed(self, name: str, place: str) -> None:
        """Note that the object was looked for at the place and is not there."""
        ...

    def heard(self, name: str, places: Iterable[str]) -> None:
        """Note that the person said it is at one of these places, the likeliest first."""
        ...

    def heard_not(self, name: str, places: Iterable[str]) -> None:
        """Note that the person said it is at none of these places."""
        ...

    def took(self, name: str, place: str) -> None:
        """Note that the robot took the object from the place."""
        ...

    def put(self, name: str, place: str) -> None:
        """Note that the robot put the object down at the place."""
        ...

    def looked(self, place: str) -> None:
        """Note that all of the place was looked at: objects not seen there are not there."""
        ...

    def places_of(self, name: str) -> tuple[str, ...]:
        """Where it was seen or said to be, latest first, except where a later look refutes it."""
        ...

    def places_denied(self, name: str) -> tuple[str, ...]:
        """Where the person said it is not, unless it was seen or said to be there since."""
        ...

    def beliefs(self) -> Mapping[str, Sequence[str]]:
        """Each object with a believed place, and its places; recordings keep this."""
        ...

    def denials(self) -> Mapping[str, Sequence[str]]:
        """Each object with denied places, and these places; recordings keep this."""
        ...

    def origins(self) -> Mapping[str, Sequence[str]]:
        """Each object that the robot took, and from where, the latest first."""
        ...


class Experience(Protocol):
    """What the robot has learned of where things are: how long sightings stay valid, and habits."""

    def learn(self) -> None:
        """Learn from what was seen since the last call; called before a mission, never in one."""
        ...

    def recalled(self, name: str) -> Sequence[Statement]:
        """What memory and habits say about where a thing is now; must return within milliseconds.

        Empty if it was never seen. The most trusted statement comes first; the trust in each is a
        share of the probability that those before it leave.
        """
        ...


class PlaceSource(Protocol):
    """A further source of where things are: a memory, a calendar, a list on the refrigerator.

    It is asked at the start of a search, before the ontology and the language model. `places_of`
    runs on the ticking thread and blocks it, so that even a stop is not heard meanwhile: it must
    return within milliseconds. Fetch slow data (a network, a large file) beforehand.
    """

    @property
    def name(self) -> str:
        """Name of the source in logs, outcomes and the tree, one word: `calendar`.

        It must be unique, and differ from the values of `Source`, from `person` and from `eyes`.
        """
        ...

    @property
    def says(self) -> str:
        """How to name the source to the person, as a clause: "your calendar says so"."""
        ...

    def places_of(self, name: str) -> tuple[str, ...]:
        """Where the object may be, likeliest first; the robot visits only places of the home."""
        ...
