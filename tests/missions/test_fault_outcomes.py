"""What comes of a mission in the instant world when something is ordered to go wrong."""

from dataclasses import dataclass, field
from typing import Any

import pytest

from executive.records import Mishap
from executive.testing.bench import Run, run_mission
from executive.types.goals import DriveTo, LookAt, Pick
from executive.types.knowledge import Source
from executive.types.outcome import MissionStatus


@dataclass(frozen=True)
class Case:
    """A mission with faults, and what must come of it."""

    says: str
    words: str
    mishaps: tuple[str, ...]
    given: dict[str, Any] = field(default_factory=dict)
    status: MissionStatus = MissionStatus.DONE
    location: str | None = None
    source: Source | None = None
    inquiries: int = 0
    strikes: int = 1
    ends_at: str | None = None
    reason: str = ""


CASES = [
    Case(
        "a thing moved on the way is asked for and found where it is now",
        "Find a power_drill.",
        ("moved=power_drill:desk@1",),
        location="desk",
        source=Source.USER,
        inquiries=1,
    ),
    Case(
        "a thing moved while the robot reaches for it is searched again",
        "Bring a hammer.",
        ("moved=hammer:sideboard@8",),
        location="sideboard",
        source=Source.USER,
        inquiries=1,
        ends_at="delivery",
    ),
    Case(
        "a thing that the robot has is not moved",
        "Bring a hammer.",
        ("moved=hammer:sideboard@20",),
        ends_at="delivery",
    ),
    Case(
        "a shut door is driven around",
        "Find a power_drill.",
        ("blocked=bedroom-lobby",),
        location="shelf_lobby",
        strikes=0,
    ),
    Case(
        "a grasp that slips is tried again after another look",
        "Take a hammer.",
        ("slip=1@0-16",),
        strikes=1,
    ),
    Case(
        "what falls on the way is picked up from the floor and brought",
        "Bring a hammer.",
        ("drop@10",),
        ends_at="delivery",
    ),
    Case(
        "a camera that is blind for a while is believed again later",
        "Find a power_drill.",
        ("blind@0-7.2",),
        location="shelf_lobby",
        source=Source.USER,
        inquiries=1,
    ),
    Case(
        "a noisy camera does not matter to a detector that is never wrong",
        "Find a power_drill.",
        ("noise=0.05",),
        location="shelf_lobby",
    ),
    Case(
        "a thing that was overlooked is found at the second look",
        "Find a power_drill.",
        ("miss=1@0-7.2",),
        location="shelf_lobby",
        source=Source.USER,
        inquiries=1,
        strikes=3,
    ),
]

FAILURES = [
    Case(
        "all doors to a room are shut",
        "Find a power_drill.",
        ("blocked=kitchen-lobby", "blocked=bedroom-lobby"),
        {"answers": ["I don't know"]},
        status=MissionStatus.NOT_DONE,
        inquiries=1,
        strikes=2,
        reason="I could not get to the shelf in the lobby: the way to the shelf in the lobby is "
        "blocked",
    ),
    Case(
        "the fingers always slip",
        "Take a hammer.",
        ("slip=1",),
        status=MissionStatus.NOT_DONE,
        strikes=3,
        reason="the hammer slipped from my fingers",
    ),
    Case(
        "a joint is stuck",
        "Take a hammer.",
        ("stuck=joint3",),
        status=MissionStatus.NOT_DONE,
        strikes=3,
        reason="joint3 is stuck",
    ),
    Case(
        "what fell is not seen, because the camera has gone blind",
        "Bring a hammer.",
        ("drop@10", "blind@12"),
        status=MissionStatus.NOT_DONE,
        strikes=2,
        reason="the hammer fell from my hand, and my camera shows nothing",
    ),
    Case(
        "the camera is blind all the time",
        "Find a power_drill.",
        ("blind",),
        {"answers": ["shelf_lobby"]},
        status=MissionStatus.NOT_DONE,
        inquiries=1,
        reason="I could not look at the shelf in the lobby: my camera shows nothing",
    ),
]


def check(case: Case) -> None:
    run = run_mission(case.words, mishaps=case.mishaps, **case.given)
    outcome = run.outcome
    assert (outcome.status, outcome.inquiries) == (case.status, case.inquiries), outcome.reason
    assert case.reason in outcome.reason
    assert case.location in (None, outcome.location)
    assert case.source in (None, outcome.source)
    if case.ends_at:
        assert run.world.resting_place(str(outcome.object)) == case.ends_at
    assert len(strikes(run)) == case.strikes, strikes(run)
    assert not run.inbox.awaits_anything


def strikes(run: Run) -> list[Mishap]:
    return run.notebook.all(Mishap)


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.says)
def test_the_mission_is_done_when(case: Case) -> None:
    check(case)


@pytest.mark.parametrize("case", FAILURES, ids=lambda case: case.says)
def test_it_fails_in_words_when(case: Case) -> None:
    check(case)


def test_a_confused_detector_makes_it_look_for_the_thing_elsewhere() -> None:
    run = run_mission("Find a power_drill.", mishaps=["confuse=1@0-7.2"])
    assert run.outcome.status == MissionStatus.DONE
    assert run.outcome.visited == ("shelf_lobby", "shelf_lobby")


def test_after_a_slip_the_robot_looks_before_it_grasps_again() -> None:
    run = run_mission("Take a hammer.", mishaps=["slip=1@0-16"])
    assert [type(goal) for goal in run.goals] == [DriveTo, LookAt, Pick, DriveTo, LookAt, Pick]


def test_chances_follow_the_seed() -> None:
    def struck(seed: int) -> list[bool]:
        runs = (run_mission("Take a hammer.", mishaps=["slip=0.5"], seed=seed) for _ in range(2))
        first, second = ([len(strikes(run)), run.outcome.mission_time_s] for run in runs)
        assert first == second
        return first

    assert len({tuple(struck(seed)) for seed in range(6)}) > 1


def test_without_a_fault_nothing_strikes() -> None:
    assert not strikes(run_mission("Take a hammer."))
