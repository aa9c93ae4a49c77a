"""The search: where the thing may be, where the robot has looked, and where it saw the thing."""

from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Any

from executive.language.wording import Wording
from executive.situation.belief import Whereabouts
from executive.situation.looks import Looks
from executive.situation.snapshot import PART, logged_as
from executive.types.home import DELIVERY
from executive.types.knowledge import Candidate
from executive.types.perception import Detection


@dataclass
class Consultation:
    """One exchange with the language model about where a thing may be."""

    reply: str = ""
    """The model's last reply."""
    names: tuple[str, ...] = ()
    """The names of places in the reply, not yet verified."""
    furniture: list[str] = field(default_factory=list)
    """Places that passed the verification."""
    rooms: list[str] = field(default_factory=list)
    """Rooms that passed, still to be expanded into furniture."""
    room: str = ""
    """The room that is being expanded."""


def _position(detection: Detection | None) -> list[float] | None:
    """The position in `map` (metres); empty if it is not known, None without a detection."""
    return list(detection.position or ()) if detection else None


def _guess(detection: Detection | None) -> dict[str, Any] | None:
    """What may have been seen, and with which confidence."""
    if detection is None:
        return None
    return {"label": detection.label, "confidence": detection.confidence}


@dataclass
class Search:
    """The way from places where a thing may be to the place where it is."""

    default_locations: tuple[str, ...] = field(default=(), metadata=logged_as("among"))
    """The ontology's default locations for the object."""
    consultation: Consultation = field(default_factory=Consultation)
    candidates: tuple[Candidate, ...] = ()
    candidate: Candidate | None = None
    """The place to which the robot drives, or at which it looks, now."""
    sent_to: str = ""
    """The place where an experimenter wants the robot to look next; empty if there is none."""
    view: int = 0
    """The view of that place at which the robot looks."""
    looks: Looks = field(default_factory=Looks, metadata=PART)
    """The results of the looks so far."""
    whereabouts: Whereabouts = field(default_factory=Whereabouts, metadata=PART)
    """Belief and plan, if the search follows a plan."""
    doubtful: Detection | None = field(default=None, metadata=logged_as(plain=_guess))
    """What may be the thing, or a part of it, in the last picture; None if there is no doubt."""
    detection: Detection | None = field(default=None, metadata=logged_as("sighting", _position))
    """The last detection of the thing."""
    found: Candidate | None = None
    """The place where the thing was seen."""
    gone: bool = False
    """Whether the thing was seen, and was not there any more at the next look."""

    @property
    def place(self) -> str:
        """Where the robot is going or looking now; only for those who come after that choice."""
        assert self.candidate is not None
        return self.candidate.place

    @property
    def goes_on(self) -> bool:
        """Whether the robot is going or looking somewhere, and has not seen the thing yet."""
        return self.candidate is not None and self.found is None

    @property
    def is_delivered(self) -> bool:
        """Whether the thing was found at the delivery place."""
        return self.found is not None and self.found.place == DELIVERY

    def look_first(self, candidate: Candidate) -> None:
        """Put a candidate before all others."""
        others = (other for other in self.candidates if other.place != candidate.place)
        self.candidate, self.candidates = candidate, (candidate, *others)

    def not_visited(self, candidates: Iterable[Candidate]) -> tuple[Candidate, ...]:
        """The candidates where the robot has not looked yet."""
        return tuple(c for c in candidates if c.place not in self.looks.visited)

    def so_far(self, thing: str | None, say: Wording) -> str:
        """Where the robot looked for the thing in vain, as a clause; empty if nowhere."""
        return "; ".join(self.looks.clauses(thing or "thing", say))


def candidates_from(places: Iterable[str], source: str) -> tuple[Candidate, ...]:
    """Candidates without probabilities, in the given order."""
    return tuple(Candidate(place, source) for place in places)
