"""What this mission knows so far: the one place that behaviours read from and write to."""

from collections.abc import Iterable
from copy import copy
from dataclasses import asdict, dataclass, field, is_dataclass
from typing import Any

from executive.events import (
    Broke,
    DeadlinePassed,
    Ended,
    Event,
    HandFelt,
    Started,
    StopRequested,
)
from executive.looks import Looks
from executive.types import (
    DELIVERY,
    SOMETHING,
    Candidate,
    Command,
    CommandKind,
    Detection,
    MissionStatus,
    Outcome,
    Replied,
    Result,
    Scored,
)


@dataclass
class Consultation:
    """One exchange with the language model about where a thing may be."""

    reply: str = ""
    """What it last wrote."""
    names: tuple[str, ...] = ()
    """The places that the reply names, not yet verified."""
    furniture: list[str] = field(default_factory=list)
    """Places that passed the verification."""
    rooms: list[str] = field(default_factory=list)
    """Rooms that passed, still to be expanded into furniture."""
    room: str = ""
    """The room that is being expanded."""


@dataclass
class Situation:
    """Facts of one mission, in the order in which they become known.

    Events are folded in by the loop before each tick; everything else is set by behaviours.
    """

    words: str = ""
    command: Command | None = None
    options: tuple[str, ...] = ()
    """Objects that the target may mean."""
    several: bool = False
    """Whether the target names several things at once."""
    guess: str = ""
    """A known name that the target may be a slip of, or that is all of it that is known."""
    object: str | None = None
    default_locations: tuple[str, ...] = ()
    """The ontology's default locations for the object."""
    consultation: Consultation = field(default_factory=Consultation)
    candidates: tuple[Candidate, ...] = ()
    candidate: Candidate | None = None
    """Where the robot is going or looking now."""
    view: int = 0
    looks: Looks = field(default_factory=Looks)
    """Where the thing was looked for, and what came of it."""
    doubtful: Detection | None = None
    """What may be the thing, or a part of it, in the last picture; None if it was surely seen."""
    detection: Detection | None = None
    """The thing, as last seen."""
    found: Candidate | None = None
    """Where the thing was seen."""
    in_hand: str | None = None
    """The thing that the robot holds, from this mission or one before it."""
    felt: bool | None = None
    """Whether the fingers felt a thing when they were asked last; None: they cannot tell."""
    reached_for: str = ""
    """The thing that the robot tried to pick up last."""
    gone: bool = False
    """Whether the thing was seen, and then was there no more."""
    lost: str = ""
    """What happened to the thing that fell from the hand, as a clause; empty if it did not."""
    spot: str = ""
    """Where the robot looks for what fell from its hand."""
    surfaces: tuple[str, ...] = ()
    """Where the person says that the thing in the hand may be put down."""
    surface: str = ""
    """Where the robot is going to put it down."""
    unplaced: dict[str, str] = field(default_factory=dict)
    """Places where what is in the hand could not be put down, and why."""
    put_at: str = ""
    """Where the robot has put down what it held; empty if it has not."""
    away: bool = False
    """Whether the robot has left the person."""
    inquiries: int = 0
    no_help: str = ""
    """Why the person cannot or will not help, as a clause; empty if they may."""
    llm_calls: int = 0
    thinking_time_s: float = 0.0
    model_failure: str = ""
    """Why the language model was of no help, as a clause; empty if it was, or was not asked."""
    status: MissionStatus = MissionStatus.NOT_DONE
    reason: str = ""
    """What is told at the end: what was done, or why it was not."""
    stopped_by: str = ""
    broke: str = ""
    """Why the program itself failed; empty if it did not."""
    decided: bool = False
    """Whether the tree has decided how the mission ends."""
    restless: bool = False
    """Whether the robot did not do what it was told last, so that it may not stand still."""
    results: dict[int, Result] = field(default_factory=dict)
    """Ends of requests that no behaviour has read yet."""
    deadlines: dict[str, float] = field(default_factory=dict)
    """When (mission time, s) the behaviours that wait will wait no longer."""

    def fold(self, event: Event) -> None:
        """Take in what happened."""
        match event:
            case Started(words):
                self.words = words
            case Ended(request, result):
                self.results[request] = result
                if isinstance(result, Replied | Scored):
                    self.llm_calls += 1
            case StopRequested(by) if not self.is_over:
                self.stopped_by = by
                self.status, self.reason = MissionStatus.STOPPED, f"stopped by {by}"
            case Broke(reason) if not self.is_over:
                self.broke = reason
                self.status, self.reason = MissionStatus.NOT_DONE, reason
            case HandFelt(holding):
                self._feel(holding)
            case DeadlinePassed() | StopRequested() | Broke():
                pass

    def _feel(self, holding: bool | None) -> None:
        """What is in the hand is what the fingers feel; its name is that of what they reached for.

        What was in it before stays in it as long as something does, or they cannot tell.
        """
        self.felt = holding
        if holding is False:
            self.in_hand = None
        elif holding and self.in_hand is None:
            self.in_hand = self.reached_for or SOMETHING

    def stay_restless(self, why: str = "") -> None:
        """It is not known that the robot stands still: say so."""
        self.restless = True
        self.reason += "; I may not be at rest" + (f": {why}" if why.strip() else "")

    @property
    def is_cut_short(self) -> bool:
        """Whether the mission ends without a decision: stopped, or the program failed."""
        return bool(self.stopped_by or self.broke)

    @property
    def is_over(self) -> bool:
        """Whether it is settled how the mission ends: what comes later does not change that."""
        return self.decided or self.is_cut_short

    def asks_to(self, kind: CommandKind) -> bool:
        """Whether this kind of deed was asked for."""
        return self.command is not None and self.command.kind == kind

    @property
    def has_it(self) -> bool:
        """Whether what was asked for is in the hand."""
        return self.in_hand is not None and self.in_hand == self.object

    @property
    def is_delivered(self) -> bool:
        """Whether the thing was found at the delivery place."""
        return self.found is not None and self.found.place == DELIVERY

    @property
    def next_deadline(self) -> float | None:
        """The earliest time (mission time, s) at which a tick is due without an event."""
        return min(self.deadlines.values(), default=None)

    def not_visited(self, candidates: Iterable[Candidate]) -> tuple[Candidate, ...]:
        """The candidates less the places where the robot has looked already."""
        return tuple(c for c in candidates if c.place not in self.looks.visited)

    @property
    def search_so_far(self) -> str:
        """Where the thing was looked for in vain, as a clause; empty if nowhere."""
        return "; ".join(self.looks.clauses(self.object or "thing"))

    @property
    def not_put_down(self) -> str:
        """Where what is in the hand could not be put down, and why, as a clause; empty if so."""
        (place, why), *others = self.unplaced.items() or [("", "")]
        if not others:
            return why
        also = ", ".join(table(other) for other, _ in others)
        return f"I could not put it on {table(place)}: {why}; nor on {also}"

    @property
    def why(self) -> str:
        """The reason that is told at the end; never empty."""
        if self.reason:
            return self.reason
        return f"the mission ended as {self.status.replace('_', ' ')}, and nothing said why"

    def saved(self) -> "Situation":
        """A copy, for `restore`."""
        twin: Situation = _copied(self)
        return twin

    def restore(self, saved: "Situation") -> None:
        """Know again what was known then, and nothing else."""
        vars(self).update(vars(saved))

    def snapshot(self) -> dict[str, Any]:
        """Everything that fits in a log line: plain values, no pictures."""
        return {
            "command": asdict(self.command) if self.command else None,
            "options": list(self.options),
            "object": self.object,
            "among": list(self.default_locations),
            "consultation": asdict(self.consultation),
            "candidates": [asdict(c) for c in self.candidates],
            "candidate": asdict(self.candidate) if self.candidate else None,
            "view": self.view,
            "visited": list(self.looks.visited),
            "unreached": dict(self.looks.unreached),
            "unseen": dict(self.looks.unseen),
            "sighting": list(self.detection.position or ()) if self.detection else None,
            "found": asdict(self.found) if self.found else None,
            "in_hand": self.in_hand,
            "gone": self.gone,
            "lost": self.lost,
            "put_at": self.put_at,
            "inquiries": self.inquiries,
            "llm_calls": self.llm_calls,
            "status": self.status,
            "reason": self.reason,
            "deadlines": dict(self.deadlines),
        }

    def outcome(self, *, mission_time_s: float, wall_time_s: float, run_dir: str | None) -> Outcome:
        """The mission's result."""
        return Outcome(
            command=self.words,
            kind=self.command.kind if self.command else None,
            target=self.command.target if self.command else None,
            object=self.object,
            status=self.status,
            reason=self.why,
            source=self.found.source if self.found else None,
            location=self.found.place if self.found else None,
            inquiries=self.inquiries,
            visited=tuple(self.looks.visited),
            llm_calls=self.llm_calls,
            candidates=self.candidates,
            mission_time_s=round(mission_time_s, 3),
            thinking_time_s=round(self.thinking_time_s, 3),
            wall_time_s=round(wall_time_s, 3),
            run_dir=run_dir,
            model_failure=self.model_failure,
        )


def _copied(value: Any) -> Any:
    """A copy of what may be changed in place; the rest as it is."""
    kind = type(value)
    if kind is list or kind is set:
        return kind(map(_copied, value))
    if kind is dict:
        return {name: _copied(item) for name, item in value.items()}
    if is_dataclass(kind) and not kind.__dataclass_params__.frozen:  # type: ignore[attr-defined]
        twin = copy(value)
        vars(twin).update({name: _copied(item) for name, item in vars(value).items()})
        return twin
    return value


def table(place: str) -> str:
    """A piece of furniture as it is called in a sentence."""
    return "the delivery table" if place == DELIVERY else f"the {place}"


def candidates_from(places: Iterable[str], source: str) -> tuple[Candidate, ...]:
    """Candidates without probabilities, in the given order."""
    return tuple(Candidate(place, source) for place in places)
