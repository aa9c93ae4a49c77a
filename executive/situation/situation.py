"""The situation: all that a mission knows, and the one place where behaviours read and write it."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, is_dataclass, replace
from functools import cache
from typing import Any, Self

from executive.events import (
    ON,
    BodyTold,
    Broke,
    DeadlinePassed,
    Deed,
    Ended,
    Event,
    HandFelt,
    Heard,
    Intervened,
    Listened,
    Started,
    StopRequested,
)
from executive.situation.agenda import Agenda
from executive.situation.before import FIRST, Before
from executive.situation.dialogue import Dialogue
from executive.situation.ending import Ending
from executive.situation.hand import Hand
from executive.situation.model import ModelUse
from executive.situation.request import Request
from executive.situation.search import Search
from executive.situation.snapshot import PART, snapshot
from executive.situation.steering import Steering
from executive.situation.survey import Survey
from executive.types.commands import Command, CommandKind
from executive.types.outcome import MissionStatus, Outcome, TaskOutcome
from executive.types.results import Failed, Replied, Scored

NOT_BEGUN = "I did not get to it"
ONE_AT_A_TIME = "I took it, and put it away again: I hold one thing at a time"


@dataclass
class Situation:
    """What one mission knows, in parts.

    The loop folds events in before each tick; behaviours set everything else. When the next of
    several tasks begins, what was found out for the one before is forgotten.
    """

    agenda: Agenda = field(default_factory=Agenda, metadata=PART)
    request: Request = field(default_factory=Request, metadata=PART)
    search: Search = field(default_factory=Search, metadata=PART)
    survey: Survey = field(default_factory=Survey, metadata=PART)
    hand: Hand = field(default_factory=Hand, metadata=PART)
    dialogue: Dialogue = field(default_factory=Dialogue, metadata=PART)
    model: ModelUse = field(default_factory=ModelUse, metadata=PART)
    ending: Ending = field(default_factory=Ending, metadata=PART)
    steering: Steering = field(default_factory=Steering, metadata=PART)

    @classmethod
    def at_start(cls, words: str = "", before: Before = FIRST) -> Self:
        """The situation before the first tick: the words, and what earlier missions have left."""
        return cls(
            request=Request(words),
            hand=Hand(in_hand=before.in_hand),
            dialogue=Dialogue(at=before.at, spoken=before.spoken),
            ending=Ending(restless=before.restless),
        )

    def at_end(self, before: Before) -> Before:
        """What the mission leaves to the next one; `before` is what it began with."""
        stands = self.dialogue.stands
        return replace(
            before,
            in_hand=self.hand.in_hand,
            restless=self.ending.restless,
            at=self.dialogue.at,
            stands=before.stands if stands is None else stands,
        )

    def fold(self, event: Event) -> None:
        """Take an event in."""
        match event:
            case Started(words):
                self.request.words = words
            case Ended(result=Replied() | Scored()):
                self.model.calls += 1
            case Ended(result=Failed(reason, unreachable=True)):
                self.ending.unreachable = reason
            case StopRequested(by):
                self.ending.stop(by)
            case Broke(reason):
                self.ending.break_off(reason)
            case Heard(words):
                self.dialogue.heard.append(words)
            case BodyTold(words):
                self.dialogue.news.append(words)
            case HandFelt(holding):
                self.hand.feel(holding)
            case Intervened(deed=Deed.HOLD_PLACE, became=on):
                self.steering.holds = on == ON
            case Intervened(deed=Deed.PLACE, became=place) if self.steering.choice:
                self.steering.instead = place
            case Intervened(deed=Deed.PLACE, became=place) if self.search.goes_on:
                self.search.sent_to = place
            case Ended() | DeadlinePassed() | Intervened() | Listened():
                pass

    def begin(self, command: Command) -> None:
        """Begin a task: forget what was found out for another one."""
        hand = self.hand
        held = Hand(in_hand=hand.in_hand, felt=hand.felt, reached_for=hand.reached_for)
        _renew(self.request, Request(self.request.words, command))
        _renew(self.search, Search())
        _renew(self.survey, Survey())
        _renew(hand, held)
        _renew(self.ending, Ending(restless=self.ending.restless))
        self.dialogue.no_help = ""

    def end_task(self) -> None:
        """Note the outcome of the current task, unless it is done in parts."""
        if self.request.command and not self._is_split:
            self.agenda.end(self._of_task(self.request.command))

    def conclude(self) -> None:
        """Note how the whole mission ended: of several tasks, it is done if all of them are."""
        self.agenda.ended = ended = list(self._held_still(self.agenda.ended))
        if len(ended) > 1 or any(task.parts for task in ended):
            all_done = all(task.status == MissionStatus.DONE for task in ended)
            self.ending.status = MissionStatus.DONE if all_done else MissionStatus.NOT_DONE
            self.ending.reason = task_by_task(ended) if len(ended) > 1 else ended[0].reason

    def _held_still(self, ended: Sequence[TaskOutcome]) -> Iterator[TaskOutcome]:
        """The same; but a thing that was taken, and put away for another one, was not taken."""
        for number, task in enumerate(ended, start=1):
            taken = task.kind == CommandKind.TAKE and task.status == MissionStatus.DONE
            if not taken or task.object == self.hand.in_hand:
                yield task
            elif any(later.object == task.object for later in ended[number:]):
                yield task  # a later task has put it somewhere
            else:
                yield replace(task, status=MissionStatus.NOT_DONE, reason=ONE_AT_A_TIME)

    @property
    def has_it(self) -> bool:
        """Whether the thing that is meant is in the hand."""
        return self.hand.in_hand is not None and self.hand.in_hand == self.request.object

    def saved(self) -> Self:
        """A deep copy, for `restore`."""
        twin: Self = _copied(self)
        return twin

    def restore(self, saved: Self) -> None:
        """Return to a saved copy; the parts stay the same objects, because behaviours hold them."""
        for name, part in vars(self).items():
            vars(part).update(vars(getattr(saved, name)))

    def snapshot(self) -> dict[str, Any]:
        """Everything as plain values for the log, without pictures."""
        return snapshot(self)

    def outcome(self, *, mission_time_s: float, wall_time_s: float, run_dir: str | None) -> Outcome:
        """The outcome of the mission."""
        found = self.search.found
        if (
            self.ending.decided and self.agenda.ended
        ):  # not a part of a task, which nobody asked for
            last: Command | TaskOutcome | None = self.agenda.ended[-1]
        else:
            last = self.request.command
        return Outcome(
            command=self.request.words,
            kind=last.kind if last else None,
            target=last.target if last else None,
            object=self.request.object,
            status=self.ending.status,
            reason=self.ending.why,
            source=found.source if found else None,
            location=found.place if found else None,
            inquiries=self.dialogue.inquiries,
            visited=self._visited(),
            llm_calls=self.model.calls,
            candidates=self.search.candidates,
            mission_time_s=round(mission_time_s, 3),
            thinking_time_s=round(self.model.thinking_time_s, 3),
            wall_time_s=round(wall_time_s, 3),
            run_dir=run_dir,
            model_failure=self.model.failure,
            goals=self.request.goals,
            tasks=(*self.agenda.ended, *self._unfinished()),
        )

    def _visited(self) -> tuple[str, ...]:
        """The places that all tasks have visited; the current one counts until it has ended."""
        at_hand = () if self.agenda.ended and not self._is_at_hand else self.search.looks.visited
        return (*self.agenda.visited(), *at_hand)

    def _unfinished(self) -> Iterator[TaskOutcome]:
        """The current task and those not begun, if the mission was cut short."""
        command, wholes, tasks = self.request.command, self.agenda.wholes, self.agenda.tasks
        at_hand = [self._of_task(command)] if self._is_at_hand and command else []
        if wholes:
            ended = [part for whole in wholes for part in whole.parts]
            others = [self._cut_short(task.command, NOT_BEGUN) for task in tasks if task.depth]
            parts = (*ended, *at_hand, *others)
            whole = self._cut_short(wholes[0].command, self.ending.why)
            yield replace(whole, parts=parts, visited=tuple(p for t in parts for p in t.visited))
        else:
            yield from at_hand
        yield from (self._cut_short(task.command, NOT_BEGUN) for task in tasks if not task.depth)

    def _cut_short(self, command: Command, why: str) -> TaskOutcome:
        kind, target = command.kind, command.target
        return TaskOutcome(kind, target, None, self.ending.status, why, None)

    @property
    def _is_split(self) -> bool:
        """Whether the current task is done in parts, and none of them has begun yet."""
        wholes = self.agenda.wholes
        return bool(wholes) and wholes[-1].command is self.request.command

    @property
    def _is_at_hand(self) -> bool:
        """Whether a task has begun and not ended."""
        return self.request.command is not None and not self.ending.decided

    def _of_task(self, command: Command) -> TaskOutcome:
        found, answers = self.search.found, not command.kind.means.searches
        return TaskOutcome(
            kind=command.kind,
            target=command.target,
            object=self.request.object,
            status=self.ending.status,
            reason=self.ending.why,
            location=found.place if found else None,
            goals=self.request.goals,
            visited=tuple(self.search.looks.visited),
            things=tuple(self.survey.found) if answers else (),
            among=(self.survey.about or ()) if answers else (),
            put_at=self.hand.put_at,
        )


def task_by_task(ended: Sequence[TaskOutcome]) -> str:
    """The outcomes of several tasks, numbered, one sentence each."""
    return " ".join(
        f"{number}. {'' if task.status == MissionStatus.DONE else 'Not done: '}{_ended(task)}"
        for number, task in enumerate(ended, start=1)
    )


def _ended(task: TaskOutcome) -> str:
    return task.reason if task.reason.endswith((".", "!", "?", "…")) else f"{task.reason}."


def _renew(part: Any, fresh: Any) -> None:
    """Reset a part to a fresh one; it stays the same object, because behaviours hold it."""
    vars(part).update(vars(fresh))


def _copied(value: Any) -> Any:
    """A copy of a value that can be changed in place; any other value itself."""
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
    """Whether a type is a dataclass that is not frozen."""
    return is_dataclass(kind) and not kind.__dataclass_params__.frozen  # type: ignore[attr-defined]
