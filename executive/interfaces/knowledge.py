"""What the robot knows: of the home, of what it saw, and from others."""

from collections.abc import Iterable, Mapping, Sequence
from typing import Protocol

from executive.belief import Statement
from executive.types.home import Called, OtherColor, Place


class Knowledge(Protocol):
    """The ontology: which things there are, what they are called, where they usually are."""

    def places(self) -> tuple[Place, ...]:
        """Every piece of furniture of the home, in the home file's order."""
        ...

    def has_place(self, name: str) -> bool:
        """Whether a piece of furniture of this name is in the home."""
        ...

    def called(self, name: str) -> Called | None:
        """How one speaks of an object, a class or a piece of furniture; None if it is unknown."""
        ...

    def objects_named(self, words: str) -> tuple[str, ...]:
        """The objects that the words may mean: none, one, or several ("fruit", "the red one")."""
        ...

    def other_color(self, words: str) -> OtherColor | None:
        """What the words would mean if they did not say the colour: "blue mug", and it is red."""
        ...

    def objects_for(self, purpose: str) -> tuple[str, ...]:
        """The objects that are for this: "to drink from", "clean the bathroom with", "nails"."""
        ...

    def colors(self, name: str) -> tuple[str, ...]:
        """The colours of an object, the chief one first, as they are said."""
        ...

    def uses(self, name: str) -> tuple[str, ...]:
        """What an object is for: "to drink from", "for tea"."""
        ...

    def nearest_names(self, words: str) -> tuple[str, ...]:
        """Known names that look most like the words, best first (at most 3)."""
        ...

    def near_name(self, words: str) -> str | None:
        """The one known name that the words are most likely a slip of, if it is clear."""
        ...

    def names_in(self, words: str) -> tuple[str, ...]:
        """The names of objects and classes that a text has in it, in their order."""
        ...

    def preferred(self, names: Sequence[str]) -> tuple[str, ...]:
        """Those of the objects that the person at home prefers; none if nobody knows who it is."""
        ...

    def usual_places(self, name: str) -> tuple[str, ...]:
        """Default locations of the object or its nearest class, as far as this home has them."""
        ...

    def likely_places(self, name: str) -> Mapping[str, float]:
        """The share of its default locations that each place of this home stands for.

        By its name, as far as what recorded them means this home, and else by its kind. In all at
        most 1: less, if this home has nothing of the kind of some of them.
        """
        ...

    def places_named(self, words: str) -> tuple[str, ...]:
        """Furniture that the words name, in their order; a room stands for its furniture."""
        ...

    def is_place(self, words: str) -> bool:
        """Whether they name furniture or rooms, and nothing else: not "Anna in the kitchen"."""
        ...


class Facts(Protocol):
    """What was seen, said and done so far, in this mission and before it. Never raises."""

    def saw(self, names: Iterable[str], place: str) -> None:
        """These objects were seen there."""
        ...

    def missed(self, name: str, place: str) -> None:
        """It was looked for there, and is not there."""
        ...

    def heard(self, name: str, places: Iterable[str]) -> None:
        """The person said that it is at one of these places, the likeliest first."""
        ...

    def heard_not(self, name: str, places: Iterable[str]) -> None:
        """The person said that it is at none of these places."""
        ...

    def took(self, name: str, place: str) -> None:
        """The robot has it, from there."""
        ...

    def put(self, name: str, place: str) -> None:
        """The robot has put it down there."""
        ...

    def looked(self, place: str) -> None:
        """All of the place was looked at: what was not seen there is not there."""
        ...

    def places_of(self, name: str) -> tuple[str, ...]:
        """Where it was seen or said to be, freshest first, as far as no later look contradicts."""
        ...

    def places_denied(self, name: str) -> tuple[str, ...]:
        """Where the person said that it is not, until it is seen, or said to be there."""
        ...

    def beliefs(self) -> Mapping[str, Sequence[str]]:
        """Each object that is believed to be anywhere, and where: what a recording keeps."""
        ...

    def denials(self) -> Mapping[str, Sequence[str]]:
        """Each object that the person said is not somewhere, and where: a recording keeps it."""
        ...

    def origins(self) -> Mapping[str, Sequence[str]]:
        """Each object that the robot took, and from where, the last time first."""
        ...


class Experience(Protocol):
    """What the robot has learned of where things are: how long a sighting is worth, and habits."""

    def learn(self) -> None:
        """Learn from what was seen since the last time; called before a mission, not in it."""
        ...

    def recalled(self, name: str) -> Sequence[Statement]:
        """What memory and habits say of where a thing is now; answers within milliseconds.

        Nothing if it was never seen. The most trusted first; the part of each is of what those
        before it have left.
        """
        ...


class PlaceSource(Protocol):
    """Something that knows where things are: a memory, a calendar, a list on the refrigerator.

    It is asked at the start of a search, before the ontology and the language model, and on the
    ticking thread, where nothing is heard meanwhile, not even a stop: `places_of` has to answer
    within milliseconds. What is slow (a network, a large file) is fetched beforehand.
    """

    @property
    def name(self) -> str:
        """Who says so, in a word: `calendar`. It stands in logs, outcomes and the tree.

        No two sources have the same, and none is called like a `Source`, `person` or `eyes`.
        """
        ...

    @property
    def says(self) -> str:
        """How the person is told who says so, as a clause: "your calendar says so"."""
        ...

    def places_of(self, name: str) -> tuple[str, ...]:
        """Where the object may be, the likeliest first; only places of the home are visited."""
        ...
