"""While the language model thinks about where a thing may be, the search goes on."""

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from replays import recorded
from thinking import Slow, slow

from executive.events import Inbox, StopRequested
from executive.records import Tick, Utterance
from executive.replay import replay
from executive.testing import bench
from executive.testing.bench import Run, four_rooms
from executive.types.goals import DriveTo, Goal
from executive.types.knowledge import Source
from executive.types.outcome import MissionStatus
from logs.questions.decision import why_text
from logs.questions.why import why
from logs.recording.reader import Run as Recorded

HOME = [place.name for place in four_rooms().places()]
FAR = '{"places": ["bookshelf_bedroom"]}'
ROOMY = [place for place in HOME if place != "dining_table"]
"""Where there is room for the mug."""
NEAR = "coffee_table"
"""Where the robot goes when nothing is known: it is nearest."""


def scores(**likely: float) -> list[float]:
    return [likely.get(place, -6.0) for place in HOME]


def mission(words: str = "Find the mug", *, thinking_s: float = 1.0, **given: Any) -> Run:
    """With a model that writes its list so slowly."""
    given = {"replies": [FAR], "elicit": "generate", "place": {"mug": "bookshelf_bedroom"}} | given
    thinks = slow(given.pop("replies"), thinking_s)
    return bench.run_mission(words, defaults=False, change=thinks, **{"search": "plan", **given})


def drives(run: Run) -> list[str]:
    return [goal.place for goal in run.goals if isinstance(goal, DriveTo)]


def said(run: Run) -> list[str]:
    return [one.text for one in run.notebook.all(Utterance) if one.speaker == "robot"]


def running(tick: Tick) -> set[str]:
    return {node.path.rpartition("/")[2] for node in tick.nodes if node.status == "RUNNING"}


def saying(words: str) -> Callable[[Goal, Inbox], None]:
    """Says it when the robot first sets out."""
    left = [words]

    def during(goal: Goal, inbox: Inbox) -> None:
        if left:
            inbox.hear(left.pop())

    return during


def test_the_tree_shows_the_list_and_the_drive_at_once() -> None:
    run = mission()
    assert {"think while moving", "inquire", "drive"} <= running(run.ticks[0])


def test_a_better_list_redirects_the_robot() -> None:
    run = mission(thinking_s=0.5)
    assert drives(run)[:2] == [NEAR, "bookshelf_bedroom"]
    assert run.outcome.visited == ("bookshelf_bedroom",)
    assert run.outcome.source == Source.LLM


def test_what_the_person_is_told_changes_with_the_plan() -> None:
    first, second, *_ = said(mission(thinking_s=0.5))
    assert first == (
        "I look for the mug on the coffee table, and think about where it may be meanwhile."
    )
    assert second.startswith("I look for the mug on the bookshelf in the bedroom: ")


def test_a_list_that_agrees_does_not_interrupt_the_drive() -> None:
    run = mission(replies=['{"places": ["coffee_table"]}'], thinking_s=0.5, place={"mug": NEAR})
    assert drives(run) == [NEAR, "person"]


def test_a_look_under_way_is_finished_when_the_list_comes() -> None:
    moment = mission(thinking_s=100.0, place={"mug": NEAR}).outcome.mission_time_s
    run = mission(thinking_s=moment / 2 - 0.2, place={"mug": NEAR})
    assert run.outcome.visited == (NEAR,)


def test_several_places_are_looked_at_while_a_long_list_is_written() -> None:
    run = mission(thinking_s=8.0)
    assert len(run.outcome.visited) > 2
    assert run.outcome.visited[-1] == "bookshelf_bedroom"
    assert len(set(run.outcome.visited)) == len(run.outcome.visited)


def test_what_is_seen_before_the_list_is_there_ends_the_thinking() -> None:
    models: list[Slow] = []
    thinks = slow([FAR], 50.0, models)
    run = bench.run_mission(
        "Find the mug",
        search="plan",
        elicit="generate",
        defaults=False,
        place={"mug": NEAR},
        change=thinks,
    )
    assert (run.outcome.status, run.outcome.visited) == (MissionStatus.DONE, (NEAR,))
    assert models[0].cancelled == 1


def test_it_takes_no_longer_than_to_think_first_where_the_list_agrees() -> None:
    at_once, later = (
        mission(replies=['{"places": ["coffee_table"]}'], thinking_s=s, place={"mug": NEAR})
        for s in (0.0, 0.6)
    )
    assert later.outcome.mission_time_s == pytest.approx(at_once.outcome.mission_time_s)


def test_nobody_is_asked_before_the_model_has_answered() -> None:
    run = mission(parameters={"question_s": 0.0}, thinking_s=3.0)
    assert "wait for it" in running(run.ticks[0])
    assert "drive" not in running(run.ticks[0])
    assert run.outcome.inquiries == 1
    assert drives(run) == ["bookshelf_bedroom", "person"]


def test_a_model_that_fails_on_the_way_leaves_the_robot_on_its_way() -> None:
    run = mission(replies=[], thinking_s=1.0, place={"mug": NEAR})
    assert run.outcome.status == MissionStatus.DONE
    assert drives(run) == [NEAR, "person"]


def test_a_stop_ends_both() -> None:
    def stop(goal: Goal, inbox: Inbox) -> None:
        inbox.post(StopRequested("the person"))

    run = mission(thinking_s=1.0, during=stop)
    assert run.outcome.status == MissionStatus.STOPPED
    assert not run.inbox.awaits_anything
    assert run.world.drive is None


def test_a_correction_ends_both() -> None:
    run = mission(thinking_s=1.0, replies=[FAR, FAR], during=saying("No, the hammer"))
    assert [(task.object, task.status) for task in run.outcome.tasks] == [
        ("hammer", MissionStatus.DONE)
    ]


def test_a_question_is_answered_while_both_go_on() -> None:
    run = mission(thinking_s=0.5, during=saying("What are you doing?"))
    assert "I ask the language model and drive to the coffee table, to find the mug." in said(run)
    assert run.outcome.visited == ("bookshelf_bedroom",)


def test_by_the_papers_stages_the_robot_thinks_before_it_moves() -> None:
    run = mission(search="paper", thinking_s=1.0)
    assert drives(run) == ["bookshelf_bedroom", "person"]
    assert not any("think while moving" in node.path for node in run.ticks[0].nodes)


@settings(max_examples=25, deadline=None)
@given(
    thinking_s=st.floats(0.0, 30.0),
    named=st.lists(st.sampled_from([*HOME, "pantry", "kitchen"]), max_size=5),
    truth=st.sampled_from(ROOMY),
    question_s=st.sampled_from([0.0, 20.0, 60.0, 1e6]),
)
def test_whatever_comes_when_it_is_found_and_no_place_is_looked_at_twice(
    thinking_s: float, named: list[str], truth: str, question_s: float
) -> None:
    listed = str(named).replace("'", '"')
    run = mission(
        replies=[f'{{"places": {listed}}}'] * 4,
        thinking_s=thinking_s,
        place={"mug": truth},
        parameters={"question_s": question_s},
    )
    assert run.outcome.status == MissionStatus.DONE
    assert run.outcome.location == truth
    assert len(set(run.outcome.visited)) == len(run.outcome.visited)
    assert not run.inbox.awaits_anything


@settings(max_examples=12, deadline=None)
@given(thinking_s=st.floats(0.0, 5.0), likely=st.sampled_from(HOME), truth=st.sampled_from(ROOMY))
def test_with_a_ranking_little_is_driven_in_vain(
    thinking_s: float, likely: str, truth: str
) -> None:
    """At most there and back again, as long as it thought."""
    given = {"replies": [scores(**{likely: 3.0})], "elicit": "rank", "place": {"mug": truth}}
    at_once, later = (mission(thinking_s=s, **given) for s in (0.0, thinking_s))
    lost = later.outcome.mission_time_s - at_once.outcome.mission_time_s
    if later.outcome.visited == at_once.outcome.visited:
        assert lost <= 2 * thinking_s + 1e-6


@pytest.mark.parametrize("thinking_s", [0.0, 1.0, 4.0, 12.0])
def test_a_mission_of_both_replays(tmp_path: Path, thinking_s: float) -> None:
    run = recorded(
        tmp_path,
        "Find the mug",
        search="plan",
        elicit="generate",
        defaults=False,
        place={"mug": "bookshelf_bedroom"},
        change=slow([FAR], thinking_s),
    )
    again = replay(run)
    assert (again.parting, again.notes) == (None, ())


def test_why_tells_the_plan_before_and_after_the_list(tmp_path: Path) -> None:
    run = recorded(
        tmp_path,
        "Find the mug",
        search="plan",
        elicit="generate",
        defaults=False,
        place={"mug": "bookshelf_bedroom"},
        change=slow([FAR], 0.5),
    )
    told = why_text(why(Recorded(run)))
    assert "    0.000  look or ask: I look at coffee_table" in told
    assert "    0.500  look or ask: I look at bookshelf_bedroom" in told
    assert re.search(r"\(anywhere \S+\), \d+ s away instead of \d", told)
