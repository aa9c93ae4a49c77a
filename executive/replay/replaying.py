"""Replays a recorded mission, without robot, model or person.

Only events cause ticks, so the recorded events determine the mission. They are given, at their
times, to a new tree under the same executive, and each tick is compared with the recorded one. So a
recording is a regression test:

    assert replay(Path("runs/20260101T120000Z-find-an-apple")).parting is None
"""

from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from time import perf_counter

from executive.app.parts import Build, Change, build_mission, mission_tree
from executive.errors import InputError
from executive.events import Inbox
from executive.records import Record, Tick, TreeShape
from executive.replay.recorded import kept, recorded_parts
from executive.replay.stand_ins import Absent, RecordedTime
from executive.situation import Before, Situation
from executive.situation.ending import STILL_HELD
from executive.text import counted, printable
from logs.questions.difference import (
    ENDED,
    Aspect,
    Parting,
    aspects_text,
    outcome_aspects,
    tick_aspects,
)
from logs.recording.reader import Run


@dataclass(frozen=True, slots=True)
class Replay:
    """The result of a replay.

    Attributes:
        run: name of the recording.
        ticks: number of ticks that were as recorded.
        recorded_s: mission time of the last of them (s).
        took_s: wall time of the replay (s).
        parting: the first difference from the recording; None if ticks and outcome are the same.
        notes: how the tree has changed since the recording; whether the recording ends early.
    """

    run: str
    ticks: int
    recorded_s: float
    took_s: float
    parting: Parting | None
    notes: tuple[str, ...]

    @property
    def speed(self) -> float:
        """Mission time divided by the replay's wall time."""
        return self.recorded_s / self.took_s

    @property
    def lasted(self) -> bool:
        """Whether enough mission time passed to compute a speed."""
        return self.recorded_s >= 0.1


def replay(folder: Path, build: Build = mission_tree, change: Change | None = None) -> Replay:
    """Replay a recorded mission with a new tree.

    Args:
        folder: the run's folder, or its mcap file.
        build: makes the tree.
        change: replaces parts; None: use the policy that the recording names.

    Raises:
        InputError: if the recording cannot be read, or lacks something that the tree needs.
    """
    began = perf_counter()
    run = Run(folder)
    inbox, situation = Inbox(), Situation.at_start(before=_before(run))
    clock = RecordedTime(tuple(run.turns()), inbox, _requests_before(run))
    judge = Judge(clock, ends_early=run.outcome() is None, exact=_speaks_in_words(run))
    absent = Absent(inbox, situation)
    absent.rests = "policy" not in run.metadata
    parts = recorded_parts(run, inbox, absent, clock, judge, change)
    executive = build_mission(parts, situation, build)
    clock.wait(None)
    executive.run()
    parting = judge.parting or _late_parting(run, clock, situation)
    notes = judge.changes(run.tree())
    if judge.ends_early:
        notes.append("the recording ends early")
    return Replay(run.name, judge.same, judge.time_s, perf_counter() - began, parting, tuple(notes))


class Judge:
    """The Recorder of a replay: compares every tick with the recorded one."""

    def __init__(self, clock: RecordedTime, *, ends_early: bool, exact: bool) -> None:
        """Compare with the turn that the clock plays.

        If the recording `ends_early`, its last turn may be partial. Unless `exact`, messages and
        measured values are not compared (see `tick_aspects`).
        """
        self._clock = clock
        self._exact = exact
        self.ends_early = ends_early
        self._shape = TreeShape(())
        self.same = 0
        """Number of ticks as recorded, so far."""
        self.time_s = 0.0
        """Mission time of the last of them (s)."""
        self.parting: Parting | None = None
        """The first tick that was not as recorded."""

    def record(self, record: Record) -> None:
        """Compare a tick; the first that differs ends the replay."""
        match record:
            case TreeShape():
                self._shape = record
            case Tick() if self.parting is None:
                self._compare(record)

    def changes(self, recorded: TreeShape) -> list[str]:
        """A note for each outermost behaviour that only one of the two trees has."""
        if not recorded.nodes:
            return []  # the recording ends before the tree was recorded
        then, now = ({node.path: None for node in s.nodes} for s in (recorded, self._shape))
        gone, new = _outermost(then, now), _outermost(now, then)
        return [f"behaviour gone since: {path}" for path in gone] + [
            f"behaviour new since: {path}" for path in new
        ]

    def _compare(self, tick: Tick) -> None:
        recorded = self._clock.tick()
        if recorded is None and self.ends_early:
            self._clock.stop("the end of the recording")
            return
        aspects = (
            tuple(tick_aspects(recorded, tick, exact=self._exact))
            if recorded
            else (Aspect("mission", ENDED, f"{tick.cause}, then {tick.tip}"),)
        )
        if aspects:
            self.parting = Parting(tick.number, self._clock.now(), aspects)
            self._clock.stop("the replay, which has parted from the recording")
            return
        self.same += 1
        self.time_s = self._clock.now()


def _speaks_in_words(run: Run) -> bool:
    """Whether the recorded robot spoke in words.

    In early recordings, it decided the same, but said `sugar_box`: its messages cannot be compared.
    """
    return "speaks" in run.metadata


def _before(run: Run) -> Before:
    """The state at the beginning of the recorded mission.

    Raises:
        InputError: if it is malformed.
    """
    try:
        return Before.from_metadata(run.metadata)
    except ValueError as error:
        what = "its metadata do not say of what was spoken before it"
        raise InputError(str(run.path), what) from error


def _outermost(paths: Collection[str], others: Collection[str]) -> Iterator[str]:
    """The paths that are not among `others`, without those inside another such path."""
    lacking = [path for path in paths if path not in others]
    return (path for path in lacking if path.rpartition("/")[0] not in lacking)


def _requests_before(run: Run) -> int:
    number = kept(run, run.metadata, "requests_before")
    if not (number.isdecimal() and len(number) < 19):
        raise InputError(str(run.path), f"its 'requests_before' is no number: {number!r}")
    return int(number)


def _late_parting(run: Run, clock: RecordedTime, situation: Situation) -> Parting | None:
    """A difference after the last tick: the recording goes on, or the outcome differs.

    None if there is none, or the recording ends early and has no outcome.
    """
    while clock.next_turn() is not None:
        pass
    if clock.missed and (tick := clock.missed.tick):
        goes_on = f"{tick.cause}, then {tick.tip}"
        return Parting(tick.number, clock.missed.time_s, (Aspect("mission", goes_on, ENDED),))
    recorded = run.outcome()
    if recorded is None:
        return None
    if STILL_HELD not in recorded.reason:  # early recordings: a stop did not say what is held
        situation.ending.reason = situation.ending.reason.partition(STILL_HELD)[0]
    outcome = situation.outcome(mission_time_s=clock.now(), wall_time_s=0.0, run_dir=None)
    if "thinks" not in run.metadata:  # early recordings: outcomes had no `model_failure`
        outcome = replace(outcome, model_failure=recorded.model_failure)
    if not recorded.tasks:  # early recordings: there was only one task
        outcome = replace(outcome, tasks=())
    aspects = tuple(outcome_aspects(recorded, outcome, exact=_speaks_in_words(run)))
    return Parting(None, recorded.mission_time_s, aspects) if aspects else None


def replay_text(replayed: Replay) -> str:
    """The result of a replay in words."""
    notes = "".join(f"\n  note: {printable(note)}" for note in replayed.notes)
    same = f"{printable(replayed.run)}: {counted(replayed.ticks, 'tick')} as recorded"
    if replayed.parting is None and not replayed.lasted:
        return f"{same}{notes}"
    if replayed.parting is None:
        return (
            f"{same}, {replayed.recorded_s:.1f} s in "
            f"{replayed.took_s:.3f} s ({replayed.speed:.0f} times as fast){notes}"
        )
    at = replayed.parting
    tick = "after the last tick" if at.tick is None else f"at tick {at.tick}"
    return (
        f"{same}; parts {tick}, {at.time_s:.3f} s"
        f"{notes}\n{aspects_text(at.aspects, ('recorded', 'replayed'))}"
    )


def replays_text(replays: Sequence[Replay]) -> str:
    """One line about several replays: how many are as recorded, and how fast they were."""
    same = sum(replayed.parting is None for replayed in replays)
    recorded_s = sum(replayed.recorded_s for replayed in replays)
    took_s = sum(replayed.took_s for replayed in replays)
    text = f"{same} of {counted(len(replays), 'mission')} as recorded"
    speeds = [replayed.speed for replayed in replays if replayed.lasted]
    if not speeds:
        return text
    return (
        f"{text}; {recorded_s:.0f} s in {took_s:.1f} s "
        f"({recorded_s / took_s:.0f} times as fast, the slowest {min(speeds):.0f} times)"
    )
