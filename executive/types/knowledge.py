"""Statements about where things are, and their sources."""

from dataclasses import dataclass
from enum import StrEnum


class Source(StrEnum):
    """Our own sources of statements; a `PlaceSource` of others has its own name."""

    ONTOLOGY = "ontology"
    LLM = "llm"
    USER = "user"
    MEMORY = "memory"
    HABITS = "habits"
    """The habits of the people at home, as the robot has learned them."""


@dataclass(frozen=True, slots=True)
class Candidate:
    """A place where the thing may be.

    Attributes:
        source: who says so: one of `Source`, or the name of a `PlaceSource`.
        probability: in [0, 1]; None if the source gives none.
    """

    place: str
    source: str
    probability: float | None = None

    def __str__(self) -> str:
        """The place, with its probability if there is one."""
        return self.place if self.probability is None else f"{self.place} {self.probability:.2f}"


@dataclass(frozen=True, slots=True)
class Verdict:
    """The names in a model's reply, sorted by a look-up in the ontology.

    Attributes:
        furniture: furniture that exists and is allowed, in the order of the reply.
        rooms: rooms that exist, still to be expanded into furniture.
        dropped: names of nothing in this home.
    """

    furniture: tuple[str, ...]
    rooms: tuple[str, ...] = ()
    dropped: tuple[str, ...] = ()
