"""A reel shows each tick of a mission as it was, from wherever one comes to it."""

import random
from dataclasses import replace

import pytest
from sessions import long_session

from executive.page.experiment.because import because
from executive.page.experiment.reel import Reel
from executive.records import Finished, Tick, TreeShape
from executive.testing.bench import Run, run_mission


@pytest.fixture(scope="module")
def mission() -> Run:
    return run_mission("Bring a fruit", answers=["peach", "sofa", "high_table"], llm=False)


def reel_of(records: list[object]) -> Reel:
    reel = Reel("a mission")
    for number, record in enumerate(records):
        reel.take(float(number), record)
    return reel


@pytest.fixture(scope="module")
def reel(mission: Run) -> Reel:
    return reel_of(mission.notebook.records)


def test_each_behaviour_is_after_each_tick_as_the_tick_tells(mission: Run, reel: Reel) -> None:
    assert len(mission.ticks) == reel.last + 1
    for step, tick in enumerate(mission.ticks):
        told = [(node.status, node.message) for node in tick.nodes]
        assert [reel.state(place, step) for place in range(len(reel.nodes))] == told


def test_what_was_never_ticked_was_not_given_up(mission: Run, reel: Reel) -> None:
    idle = [place for place, node in enumerate(mission.ticks[0].nodes) if node.status == "INVALID"]
    assert idle
    assert {reel.since(place, 0) for place in idle} == {-1}


def test_from_any_tick_to_any_other_only_what_differs_is_told(mission: Run, reel: Reel) -> None:
    shown: dict[int, tuple[str, str]] = {}
    facts: dict[str, object] = {}
    before: int | None = None
    for step in random.Random(1).choices(range(reel.last + 1), k=40):
        shown |= {place: (s, m) for place, (s, m, _) in reel.differing(step, before).items()}
        facts |= reel.facts(step, before)
        assert all(shown[place] == reel.state(place, step) for place in shown)
        assert facts == mission.ticks[step].situation
        assert not reel.differing(step, step)
        before = step


def test_a_long_session_is_told_tick_by_tick_as_well() -> None:
    reel = reel_of(list(long_session(ticks=10_000)))
    ticks = [record for record in long_session(ticks=10_000) if isinstance(record, Tick)]
    for step in (0, 1, 4999, 9999):
        told = [(node.status, node.message) for node in ticks[step].nodes]
        assert [reel.state(place, step) for place in range(len(reel.nodes))] == told


def place_of(reel: Reel, name: str) -> int:
    return next(place for place, node in enumerate(reel.nodes) if node.name == name)


def test_what_runs_does_so_for_the_leaf_that_waits(reel: Reel) -> None:
    chain = because(reel, 0, 0)
    assert [reel.nodes[one["node"]].name for one in chain][-1] == "ask which object"
    assert {one["status"] for one in chain} == {"RUNNING"}


def test_what_failed_did_so_for_what_the_last_in_it_says(reel: Reel) -> None:
    chain = because(reel, place_of(reel, "known object"), 0)
    assert chain[0]["status"] == "FAILURE"
    assert chain[-1]["message"] == "none of them is a favourite"


def test_what_is_not_at_work_has_no_further_reason(reel: Reel) -> None:
    assert len(because(reel, place_of(reel, "not found"), 0)) == 1


def test_lines_are_those_up_to_a_tick_and_the_end_is_at_the_last(reel: Reel) -> None:
    first = [line.text for line in reel.lines_to(0, 100, lambda line: line.kind == "said")]
    assert first[0] == "person: Bring a fruit"
    assert first[1].startswith("robot: Which fruit do you mean")
    assert len(first) == 2
    assert reel.lines_to(reel.last, 1, lambda line: line.kind == "end") or not reel.outcome


def test_an_end_and_a_cause_are_told_in_words() -> None:
    mission = run_mission("xyzzy fribble", llm=False)
    (tick,) = mission.ticks
    told = replace(tick, cause="StopRequested, Saw")
    reel = reel_of([mission.notebook.all(TreeShape)[0], told, Finished(mission.outcome)])
    (end,) = reel.lines_to(reel.last, 1, lambda line: line.kind == "end")
    assert end.text.startswith("not understood: I do not understand")
    assert reel.moments[0].cause == "stop requested, saw"


def test_of_many_lines_the_latest_are_told(reel: Reel) -> None:
    everything = reel.lines_to(reel.last, 1000, lambda line: True)
    assert reel.lines_to(reel.last, 3, lambda line: True) == everything[-3:]


def test_a_reel_without_a_tree_or_ticks_is_empty() -> None:
    reel = reel_of([TreeShape(())])
    assert reel.last == -1
    assert reel.differing(-1, None) == {}
    assert reel.lines_to(-1, 10, lambda line: True) == []
