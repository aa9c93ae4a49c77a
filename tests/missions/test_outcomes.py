"""What comes of a mission: every branch of object and location resolution, and every failure."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from outcome_cases import ALL, CASES, GENERATE, OKB, Case, favouring, listing

from executive.testing.bench import run_mission
from executive.types.commands import SEARCHING
from executive.types.goals import DriveTo, Goal, LookAt, Pick, PutDown
from executive.types.outcome import MissionStatus

FAILURES = [
    Case("empty words", "", status=MissionStatus.NOT_UNDERSTOOD, reason="I do not understand"),
    Case("senseless words", "Fnord!", status=MissionStatus.NOT_UNDERSTOOD, reason="for example"),
    Case(
        "the model's reading of the words is not what was meant",
        "Come with the hammer!",
        {"answers": ["no"], "replies": [favouring("bring", among=SEARCHING)]},
        status=MissionStatus.NOT_UNDERSTOOD,
        inquiries=1,
        llm_calls=1,
        reason="I do not understand 'Come with the hammer!'",
    ),
    Case(
        "nobody confirms the model's reading of the words",
        "Come with the hammer!",
        {"answers": [None], "replies": [favouring("bring", among=SEARCHING)]},
        status=MissionStatus.NOT_UNDERSTOOD,
        inquiries=1,
        llm_calls=1,
    ),
    Case(
        "there is no model to read what the grammar cannot",
        "Come with the hammer!",
        OKB | {"answers": ["yes"]},
        status=MissionStatus.NOT_UNDERSTOOD,
    ),
    Case(
        "the model does not answer what the words mean",
        "Come with the hammer!",
        {"answers": ["yes"], "replies": [None]},
        status=MissionStatus.NOT_UNDERSTOOD,
    ),
    Case(
        "the model reads into the words what does not exist",
        "Come with the hammer!",
        GENERATE | {"answers": ["yes"], "replies": ['{"kind": "bring", "object": "crown"}']},
        status=MissionStatus.NOT_UNDERSTOOD,
        llm_calls=1,
    ),
    Case(
        "a slip was none, and the person says no more",
        "Take a hamer.",
        OKB | {"answers": ["no", "I don't know"]},
        status=MissionStatus.NOT_DONE,
        inquiries=2,
        reason="I know no 'hamer'",
    ),
    Case(
        "an unknown thing, and the person does not know either",
        "Bring a suger_box.",
        {"answers": ["I don't know"]},
        status=MissionStatus.NOT_DONE,
        inquiries=1,
        reason="the nearest that I know is the sugar box",
    ),
    Case(
        "an unknown thing like no other",
        "Bring a zebra.",
        {"answers": []},
        status=MissionStatus.NOT_DONE,
        reason="I know no 'zebra', and",
    ),
    Case(
        "answers that make no sense are not waited for without end",
        "Find a fruit.",
        {"answers": ["hm", "hmm", "hmmm", "apple"]},
        status=MissionStatus.NOT_DONE,
        inquiries=3,
        reason="did not understand your answer 'hmmm'",
    ),
    Case(
        "the person does not know where",
        "Find an apple.",
        OKB | {"answers": ["no idea"]},
        status=MissionStatus.NOT_DONE,
        inquiries=1,
        reason="I do not know where the apple is, and you could not tell me",
    ),
    Case(
        "the person stays silent",
        "Find an apple.",
        OKB | {"answers": [None]},
        status=MissionStatus.NOT_DONE,
        inquiries=1,
        reason="nobody answered within 120 s",
    ),
    Case(
        "there is no person",
        "Find an apple.",
        OKB | {"answers": []},
        status=MissionStatus.NOT_DONE,
        reason="no more answers",
    ),
    Case(
        "it is nowhere",
        "Find a power_drill.",
        {"answers": ["desk"], "place": {"power_drill": "bed"}},
        status=MissionStatus.NOT_DONE,
        visited=("shelf_lobby", "desk"),
        inquiries=1,
        reason="I did not find the power drill on the shelf in the lobby or the desk",
    ),
]


def check(case: Case) -> None:
    run = run_mission(case.words, **case.given)
    outcome = run.outcome
    assert (outcome.status, outcome.inquiries, outcome.llm_calls) == (
        case.status,
        case.inquiries,
        case.llm_calls,
    ), outcome.reason
    assert case.reason in outcome.reason
    for name in ("object", "kind", "location", "source", "visited"):
        expected = getattr(case, name)
        assert expected is None or getattr(outcome, name) == expected
    assert not run.inbox.awaits_anything


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.says)
def test_succeeds_when(case: Case) -> None:
    check(case)


@pytest.mark.parametrize("case", FAILURES, ids=lambda case: case.says)
def test_fails_in_words_when(case: Case) -> None:
    check(case)


def test_find_comes_back_to_the_person() -> None:
    run = run_mission("Find a power_drill.")
    assert run.world.at == "person"
    assert run.outcome.reason == "The power drill is on the shelf in the lobby."


def test_take_holds_the_thing() -> None:
    run = run_mission("Take a hammer.")
    assert (run.world.held, run.world.at) == ("hammer", "shelf_lobby")


def test_bring_delivers_the_thing() -> None:
    run = run_mission("Bring a tennis_ball.")
    assert run.world.resting_place("tennis_ball") == "delivery"


def test_failing_far_away_the_robot_comes_back_to_say_so() -> None:
    run = run_mission("Find a power_drill.", place={"power_drill": "bed"}, answers=["no idea"])
    assert run.outcome.status == MissionStatus.NOT_DONE
    assert run.world.at == "person"


def test_a_blocked_place_is_passed_over_and_said() -> None:
    run = run_mission(
        "Find a power_drill.",
        fault=lambda goal: "the way is blocked" if goal == DriveTo("shelf_lobby") else None,
        answers=["I don't know"],
    )
    assert run.outcome.visited == ()
    assert "I could not get to the shelf in the lobby: the way is blocked" in run.outcome.reason


def test_a_missed_grasp_is_tried_once_more_after_another_look() -> None:
    misses = iter(["it slipped from the fingers", None])
    run = run_mission(
        "Take a hammer.", fault=lambda goal: next(misses) if isinstance(goal, Pick) else None
    )
    assert run.outcome.status == MissionStatus.DONE
    kinds = [type(goal) for goal in run.goals]
    assert kinds == [DriveTo, LookAt, Pick, DriveTo, LookAt, Pick]
    assert run.outcome.visited == ("shelf_lobby",)


def test_a_grasp_that_keeps_failing_is_reported() -> None:
    run = run_mission("Take a hammer.", fault=lambda g: "it slipped" * isinstance(g, Pick) or None)
    assert (run.outcome.status, run.outcome.reason) == (MissionStatus.NOT_DONE, "it slipped")


def test_a_thing_that_cannot_be_put_down_is_reported() -> None:
    def fault(goal: Goal) -> str | None:
        return "the table is full" if isinstance(goal, PutDown) else None

    run = run_mission("Bring a hammer.", fault=fault)
    assert run.outcome.status == MissionStatus.NOT_DONE
    assert run.outcome.reason == (
        "I could not put it on the delivery table: the table is full; nor on the coffee table, "
        "the sofa or the dining table, and you could not tell me; I still hold the hammer"
    )


def test_time_spent_waiting_for_the_model_is_counted_and_no_other() -> None:
    run = run_mission("Find an apple.", defaults=False, replies=[None])
    assert run.outcome.thinking_time_s == 60.0
    assert run.outcome.mission_time_s > 60.0


def test_dropped_names_are_recorded() -> None:
    run = run_mission(
        "Find an apple.",
        defaults=False,
        elicit="generate",
        replies=[listing("pantry", "dining_table")],
    )
    assert run.dropped == ["pantry"]


@settings(max_examples=60, deadline=None)
@given(
    st.lists(st.text(max_size=60) | st.sampled_from([listing("cellar"), listing("kitchen"), ""]))
)
def test_whatever_the_model_writes_the_mission_ends_and_only_real_places_are_visited(
    replies: list[str],
) -> None:
    run = run_mission("Find an apple.", defaults=False, elicit="generate", replies=replies)
    assert run.outcome.status == MissionStatus.DONE
    assert set(run.outcome.visited) <= set(ALL)
    assert not run.inbox.awaits_anything


@settings(max_examples=60, deadline=None)
@given(words=st.text(max_size=40), answers=st.lists(st.text(max_size=20) | st.none(), max_size=4))
def test_whatever_the_person_says_the_mission_ends_in_words(
    words: str, answers: list[str | None]
) -> None:
    run = run_mission(f"Find {words}", answers=answers, llm=False)
    assert run.outcome.reason
    assert not run.inbox.awaits_anything
