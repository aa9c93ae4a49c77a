"""What this mission knows so far: the one place that behaviours read from and write to."""

from dataclasses import dataclass, field, is_dataclass
from functools import cache
from typing import Any, Self

from executive.events import (
    Broke,
    DeadlinePassed,
    Ended,
    Event,
    HandFelt,
    Started,
    StopRequested,
)
from executive.situation.dialogue import Dialogue
from executive.situation.ending import Ending
from executive.situation.hand import Hand
from executive.situation.model import ModelUse
from executive.situation.request import Request
from executive.situation.search import Search
from executive.situation.snapshot import PART, snapshot
from executive.types import Outcome, Replied, Scored


@dataclass
class Situation:
    """Facts of one mission, in parts.

    Events are folded in by the loop before each tick; everything else is set by behaviours.
    """

    request: Request = field(default_factory=Request, metadata=PART)
    search: Search = field(default_factory=Search, metadata=PART)
    hand: Hand = field(default_factory=Hand, metadata=PART)
    dialogue: Dialogue = field(default_factory=Dialogue, metadata=PART)
    model: ModelUse = field(default_factory=ModelUse, metadata=PART)
    ending: Ending = field(default_factory=Ending, metadata=PART)

    @classmethod
    def at_start(
        cls, words: str = "", *, in_hand: str | None = None, restless: bool = False
    ) -> Self:
        """What is known before the first tick: the words, and in what state the robot was left."""
        return cls(
            request=Request(words), hand=Hand(in_hand=in_hand), ending=Ending(restless=restless)
        )

    def fold(self, event: Event) -> None:
        """Take in what happened."""
        match event:
            case Started(words):
                self.request.words = words
            case Ended(result=Replied() | Scored()):
                self.model.calls += 1
            case StopRequested(by):
                self.ending.stop(by)
            case Broke(reason):
                self.ending.break_off(reason)
            case HandFelt(holding):
                self.hand.feel(holding)
            case Ended() | DeadlinePassed():
                pass

    @property
    def has_it(self) -> bool:
        """Whether what was asked for is in the hand."""
        return self.hand.in_hand is not None and self.hand.in_hand == self.request.object

    def saved(self) -> Self:
        """A copy, for `restore`."""
        twin: Self = _copied(self)
        return twin

    def restore(self, saved: Self) -> None:
        """Know again what was known then, and nothing else; the parts are the same as before."""
        for name, part in vars(self).items():
            vars(part).update(vars(getattr(saved, name)))

    def snapshot(self) -> dict[str, Any]:
        """Everything that fits in a log line: plain values, no pictures."""
        return snapshot(self)

    def outcome(self, *, mission_time_s: float, wall_time_s: float, run_dir: str | None) -> Outcome:
        """The mission's result."""
        command, found = self.request.command, self.search.found
        return Outcome(
            command=self.request.words,
            kind=command.kind if command else None,
            target=command.target if command else None,
            object=self.request.object,
            status=self.ending.status,
            reason=self.ending.why,
            source=found.source if found else None,
            location=found.place if found else None,
            inquiries=self.dialogue.inquiries,
            visited=tuple(self.search.looks.visited),
            llm_calls=self.model.calls,
            candidates=self.search.candidates,
            mission_time_s=round(mission_time_s, 3),
            thinking_time_s=round(self.model.thinking_time_s, 3),
            wall_time_s=round(wall_time_s, 3),
            run_dir=run_dir,
            model_failure=self.model.failure,
            goals=self.request.goals,
        )


def _copied(value: Any) -> Any:
    """A copy of what may be changed in place; the rest as it is."""
    kind = value.__class__
    if kind is list or kind is set:
        return kind(map(_copied, value))
    if kind is dict:
        return {name: _copied(item) for name, item in value.items()}
    if _changes(kind):
        twin = kind.__new__(kind)
        vars(twin).update({name: _copied(item) for name, item in vars(value).items()})
        return twin
    return value


@cache
def _changes(kind: type) -> bool:
    """Whether things of this type are dataclasses whose fields may be set."""
    return is_dataclass(kind) and not kind.__dataclass_params__.frozen  # type: ignore[attr-defined]
