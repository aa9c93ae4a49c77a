"""A mission as it went, of which any tick can be shown at once.

Of all ticks only what changed is kept: so a long mission takes little room, and to show one of its
ticks means to look up each behaviour's latest change before it.
"""

from bisect import bisect_right
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any, Generic, TypeVar

from executive.events import Intervened
from executive.language.phrases import spoken
from executive.records import (
    EventTaken,
    Finished,
    LlmCall,
    Mishap,
    NodeShape,
    Note,
    Planned,
    Record,
    Tick,
    TreeShape,
    Utterance,
    Verified,
)
from executive.text import printable
from executive.types.outcome import Outcome
from logs.questions.interventions import done
from logs.recording.events import in_words

T = TypeVar("T")

LONGEST = 2000
"""Of a line (characters): what is longer is read in the recording."""
READ = (TreeShape, Tick, Utterance, EventTaken, LlmCall, Verified, Planned, Mishap, Finished)
"""What is read of a recording for a reel."""
STILL = ("INVALID", "")
"""How a behaviour is that was never ticked: its status and what it says."""


class Track(Generic[T]):
    """A value that changes from step to step. One thread writes, any may read."""

    def __init__(self) -> None:
        """No value yet."""
        self.steps: list[int] = []
        self.values: list[T] = []

    def put(self, step: int, value: T) -> None:
        """It is this from here on."""
        if not self.values or self.values[-1] != value:
            self.values.append(value)
            self.steps.append(step)  # last: who reads goes by the steps

    def index(self, step: int) -> int:
        """Which change counts at a step; -1 if none does."""
        return bisect_right(self.steps, step) - 1


@dataclass(frozen=True, slots=True)
class Moment:
    """When a tick was and why."""

    time_s: float
    number: int
    cause: str
    tip: str
    duration_s: float


@dataclass(frozen=True, slots=True)
class Line:
    """Something that happened between two ticks.

    Attributes:
        step: the tick that followed.
        time_s: mission time.
        kind: `said`, `event`, `intervened`, `model`, `plan`, `note`, `mishap`, `end`.
        text: what.
        call: of the model's calls the number of this one, from 0; None if it is none.
    """

    step: int
    time_s: float
    kind: str
    text: str
    call: int | None = None


class Reel:
    """One mission, while it goes on and afterwards. One thread writes, any may read."""

    def __init__(self, name: str) -> None:
        """Nothing has happened; the name is that of its folder, or what else to call it."""
        self.name = name
        self.nodes: tuple[NodeShape, ...] = ()
        self.children: dict[int, list[int]] = {}
        """Of each behaviour those directly in it, by their places in `nodes`."""
        self.moments: list[Moment] = []
        self.lines: list[Line] = []
        self.calls: list[LlmCall] = []
        self.outcome: Outcome | None = None
        self.whole = False
        """Whether nothing comes any more."""
        self.trouble = ""
        """Why it cannot be read, or not further."""
        self._index: dict[str, int] = {}
        self._states: list[Track[tuple[str, str]]] = []
        self._facts: dict[str, Track[Any]] = {}

    # --- what is written ---

    def take(self, time_s: float, record: Record) -> None:
        """What was recorded next, at this mission time."""
        match record:
            case TreeShape():
                self._grow(record)
            case Tick():
                self._tick(time_s, record)
            case Utterance(speaker, text):
                self._add(time_s, "said", f"{speaker}: {text}")
            case EventTaken(Intervened(by) as deed):
                self._add(time_s, "intervened", f"{by}: {done(deed)}")
            case EventTaken(event):
                self._add(time_s, "event", in_words(event))
            case LlmCall(result):
                self.calls.append(record)
                text = f"{result.request.label} ({result.usage.total_s:.1f} s)"
                self._add(time_s, "model", text, len(self.calls) - 1)
            case Verified(label, accepted, rooms, dropped):
                kept = ", ".join((*accepted, *rooms)) or "nothing"
                self._add(time_s, "model", f"{label}: kept {kept}; dropped {len(dropped)}")
            case Planned(text=text):
                self._add(time_s, "plan", text)
            case Note(level, text) if level in ("warning", "error"):
                self._add(time_s, "note", f"{level}: {text}")
            case Mishap(fault, text):
                self._add(time_s, "mishap", f"{fault}: {text}")
            case Finished(outcome):
                self.outcome = outcome
                self._add(time_s, "end", f"{spoken(outcome.status)}: {outcome.reason}")

    def _grow(self, tree: TreeShape) -> None:
        index = {node.path: place for place, node in enumerate(tree.nodes)}
        self.children = {}
        for place, node in enumerate(tree.nodes):
            if node.parent in index:
                self.children.setdefault(index[node.parent], []).append(place)
        self._index, self._states = index, [Track() for _ in tree.nodes]
        self.nodes = tree.nodes

    def _tick(self, time_s: float, tick: Tick) -> None:
        step = len(self.moments)
        for node in tick.nodes:
            if (place := self._index.get(node.path)) is not None:
                track, state = self._states[place], (node.status, node.message)
                if track.values or state != STILL:  # the first tick tells of all, ticked or not
                    track.put(step, state)
        for key, value in tick.situation.items():
            self._facts.setdefault(key, Track()).put(step, value)
        self.moments.append(
            Moment(time_s, tick.number, spoken(tick.cause), tick.tip, tick.duration_s)
        )

    def _add(self, time_s: float, kind: str, text: str, call: int | None = None) -> None:
        said = printable(text[:LONGEST])
        self.lines.append(Line(len(self.moments), time_s, kind, said, call))

    # --- what is read ---

    @property
    def last(self) -> int:
        """The latest step; -1 before the first."""
        return len(self.moments) - 1

    def state(self, place: int, step: int) -> tuple[str, str]:
        """A behaviour's status after a step, and what it says."""
        track = self._states[place]
        at = track.index(step)
        return track.values[at] if at >= 0 else STILL

    def since(self, place: int, step: int) -> int:
        """From which step on a behaviour has been as it is after this one; -1: from the start."""
        track = self._states[place]
        at = track.index(step)
        return track.steps[at] if at >= 0 else -1

    def changes(self, place: int) -> Iterator[tuple[int, str, str]]:
        """Each change of a behaviour: after which step, its status, what it says."""
        track = self._states[place]
        for step, (status, message) in zip(tuple(track.steps), track.values, strict=False):
            yield step, status, message

    def differing(self, step: int, shown: int | None) -> dict[int, tuple[str, str, int]]:
        """The behaviours that are not as after the step that is shown; None: nothing is shown.

        Each with its status, what it says, and since when.
        """
        before = -1 if shown is None else shown
        return {
            place: (*self.state(place, step), self.since(place, step))
            for place, track in enumerate(self._states)
            if track.index(step) != track.index(before)
        }

    def facts(self, step: int, shown: int | None) -> dict[str, Any]:
        """What the mission knew after a step, as far as it is not what it knew after another."""
        before = -1 if shown is None else shown
        return {
            key: track.values[at] if at >= 0 else None
            for key, track in tuple(self._facts.items())
            if (at := track.index(step)) != track.index(before)
        }

    def fact(self, key: str) -> Any:
        """What the mission knows now under this key; None if nothing."""
        track = self._facts.get(key)
        return track.values[-1] if track and track.values else None

    def lines_to(self, step: int, most: int, wanted: Callable[[Line], bool]) -> list[Line]:
        """The latest lines up to a step that are wanted, oldest first; no more than `most`."""
        lines = self.lines
        after = bisect_right(lines, step if step < self.last else step + 1, key=lambda ln: ln.step)
        found: list[Line] = []
        for place in range(after - 1, -1, -1):
            if wanted(lines[place]):
                found.append(lines[place])
                if len(found) == most:
                    break
        return found[::-1]
