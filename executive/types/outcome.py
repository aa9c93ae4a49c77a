"""What came of a mission and of its tasks."""

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
    """What came of one of the tasks of a mission; its fields are as those of `Outcome`."""

    kind: CommandKind
    target: str
    object: str | None
    status: MissionStatus
    reason: str
    location: str | None
    goals: tuple[str, ...] = ()
    visited: tuple[str, ...] = ()
    things: tuple[str, ...] = ()
    """Of a question: the things that were seen, and are the answer to it."""
    among: tuple[str, ...] = ()
    """Of a question: the things that it was about."""
    parts: "tuple[TaskOutcome, ...]" = ()
    """Of a task with several things: what came of each that was begun."""
    put_at: str = ""
    """Where the thing was put down; empty if it was not."""


@dataclass(frozen=True, slots=True)
class Outcome:
    """One mission's result: what `--json` prints and `outcome.json` keeps.

    If there were several tasks, each is in `tasks`; `kind`, `target`, `object`, `source`,
    `location`, `candidates` and `goals` are those of the last one that was begun, and `done` is
    only said if all of them were.
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
    """Why the language model was of no help, as a clause; empty if it was, or was not asked."""
    goals: tuple[str, ...] = ()
    """The furniture that would do as the place where the thing, or the robot, was to go."""
    tasks: tuple[TaskOutcome, ...] = ()
    """What came of each task, in the order in which they ended; those not begun come last."""
