"""What is said of where things are, and who says so."""

from dataclasses import dataclass
from enum import StrEnum


class Source(StrEnum):
    """Who an answer came from; a knowledge source of one's own has a name of its own besides."""

    ONTOLOGY = "ontology"
    LLM = "llm"
    USER = "user"
    MEMORY = "memory"
    HABITS = "habits"
    """Of the people at home, as the robot has learned them."""


@dataclass(frozen=True, slots=True)
class Candidate:
    """A place where the thing may be, who says so, and how likely (None where nobody said).

    `source` is one of `Source`, or the name of a `PlaceSource`.
    """

    place: str
    source: str
    probability: float | None = None

    def __str__(self) -> str:
        """The place, with its probability if there is one."""
        return self.place if self.probability is None else f"{self.place} {self.probability:.2f}"


@dataclass(frozen=True, slots=True)
class Verdict:
    """What is left of a reply's names after they were looked up in the ontology.

    `furniture` exists (and is allowed), in the order of the reply; `rooms` exist and have yet to
    be expanded into furniture; `dropped` are the names of nothing here.
    """

    furniture: tuple[str, ...]
    rooms: tuple[str, ...] = ()
    dropped: tuple[str, ...] = ()
