"""Outcomes of a mission and of its tasks."""

from dataclasses import dataclass
from enum import StrEnum

from executive.types.commands import CommandKind
from executive.types.knowledge import Candidate


class MissionStatus(StrEnum):
    """How a mission ended."""

    DONE = "done"
    NOT_DONE = "not_done"
    NOT_UNDERSTOOD = "not_understood"
    STOPPED = "stopped"


@dataclass(frozen=True, slots=True)
class TaskOutcome:
    """The outcome of one task of a mission; fields as in `Outcome`."""

    kind: CommandKind
    target: str
    object: str | None
    status: MissionStatus
    reason: str
    location: str | None
    goals: tuple[str, ...] = ()
    visited: tuple[str, ...] = ()
    things: tuple[str, ...] = ()
    """Of a question: the things that were seen and answer it."""
    among: tuple[str, ...] = ()
    """Of a question: the things that it was about."""
    parts: "tuple[TaskOutcome, ...]" = ()
    """Of a task with several things: the outcome of each part that was begun."""
    put_at: str = ""
    """Where the thing was put down; empty if it was not."""


@dataclass(frozen=True, slots=True)
class Outcome:
    """The outcome of one mission: `--json` prints it, and `outcome.json` keeps it.

    Of a mission with several tasks, `kind`, `target`, `object`, `source`, `location`, `candidates`
    and `goals` are those of the last task that was begun; `status` is `DONE` only if all tasks were
    done.
    """

    command: str
    kind: CommandKind | None
    target: str | None
    object: str | None
    status: MissionStatus
    reason: str
    source: str | None
    location: str | None
    inquiries: int
    visited: tuple[str, ...]
    llm_calls: int
    candidates: tuple[Candidate, ...]
    mission_time_s: float
    thinking_time_s: float
    wall_time_s: float
    run_dir: str | None
    model_failure: str = ""
    """Why the language model did not help, as a clause; empty if it did, or was not asked."""
    goals: tuple[str, ...] = ()
    """The furniture that was acceptable as the goal of the thing, or of the robot."""
    tasks: tuple[TaskOutcome, ...] = ()
    """The outcome of each task, in the order in which they ended; those not begun come last."""
