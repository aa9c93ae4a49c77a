"""What comes of a mission: every branch of object and location resolution, and every failure."""

from dataclasses import dataclass, field
from typing import Any

import pytest
from conftest import four_rooms, run_mission
from hypothesis import given, settings
from hypothesis import strategies as st

from executive.types import DriveTo, Goal, Kind, LookAt, Pick, PutDown, Source, Status

ALL = tuple(place.name for place in four_rooms().places())


def favouring(*best: str, among: tuple[str, ...] = ALL) -> tuple[float, ...]:
    """Scores of a ranking in which these places come first, in this order."""
    return tuple(float(len(best) - best.index(p)) if p in best else -1.0 for p in among)


def listing(*places: str) -> str:
    """A reply in the output format."""
    return '{"places": [' + ", ".join(f'"{p}"' for p in places) + "]}"


@dataclass(frozen=True)
class Case:
    """A mission and what must come of it."""

    says: str
    words: str
    given: dict[str, Any] = field(default_factory=dict)
    status: Status = Status.DONE
    object: str | None = None
    kind: Kind | None = None
    location: str | None = None
    source: Source | None = None
    visited: tuple[str, ...] | None = None
    inquiries: int = 0
    llm_calls: int = 0
    reason: str = ""


NO_DEFAULTS = {"defaults": False}
OKB = {"llm": False}
GENERATE = {"elicit": "generate"}
FRUIT_DEFAULTS = ("dining_table", "counter_wagon", "high_table")
SUGAR_DEFAULTS = ("cabinet_kitchen", "counter_wagon", "high_table")

CASES = [
    Case(
        "the ontology's one place is visited without asking anyone",
        "Find a power_drill.",
        object="power_drill",
        location="shelf_lobby",
        source=Source.ONTOLOGY,
        visited=("shelf_lobby",),
    ),
    Case(
        "the person is asked if the ontology's one place is wrong",
        "Find a power_drill.",
        {"place": {"power_drill": "desk"}},
        location="desk",
        source=Source.USER,
        visited=("shelf_lobby", "desk"),
        inquiries=1,
    ),
    Case(
        "okb asks where without defaults",
        "Find an apple.",
        OKB | NO_DEFAULTS,
        location="dining_table",
        source=Source.USER,
        visited=("dining_table",),
        inquiries=1,
    ),
    Case(
        "okb asks where if there are several defaults",
        "Bring a sugar_box.",
        OKB,
        location="counter_wagon",
        source=Source.USER,
        visited=("counter_wagon",),
        inquiries=1,
    ),
    Case(
        "a ranking of all places is visited in its order until the thing is seen",
        "Take a mug.",
        NO_DEFAULTS | {"replies": [favouring("dining_table", "coffee_table")]},
        location="coffee_table",
        source=Source.LLM,
        visited=("dining_table", "coffee_table"),
        llm_calls=1,
    ),
    Case(
        "several defaults are ranked, and no other place",
        "Bring a sugar_box.",
        {"replies": [favouring("high_table", "counter_wagon", among=SUGAR_DEFAULTS)]},
        location="counter_wagon",
        source=Source.LLM,
        visited=("high_table", "counter_wagon"),
        llm_calls=1,
    ),
    Case(
        "only the top five of a ranking are visited, then the person is asked",
        "Find an apple.",
        NO_DEFAULTS | {"replies": [favouring("bed", "sofa", "desk", "sideboard", "high_table")]},
        location="dining_table",
        source=Source.USER,
        visited=("bed", "sofa", "desk", "sideboard", "high_table", "dining_table"),
        inquiries=1,
        llm_calls=1,
    ),
    Case(
        "a list is taken in the model's order",
        "Find an apple.",
        NO_DEFAULTS | GENERATE | {"replies": [listing("high_table", "dining_table")]},
        location="dining_table",
        source=Source.LLM,
        visited=("high_table", "dining_table"),
        llm_calls=1,
    ),
    Case(
        "an invented place never reaches the robot",
        "Find an apple.",
        NO_DEFAULTS | GENERATE | {"replies": [listing("pantry", "dining_table", "fruit bowl")]},
        location="dining_table",
        source=Source.LLM,
        visited=("dining_table",),
        llm_calls=1,
    ),
    Case(
        "a real place outside the defaults is not visited",
        "Bring a sugar_box.",
        GENERATE | {"replies": [listing("bed", "counter_wagon")]},
        location="counter_wagon",
        source=Source.LLM,
        visited=("counter_wagon",),
        llm_calls=1,
    ),
    Case(
        "a reply that is no JSON is summarized",
        "Find an apple.",
        NO_DEFAULTS | GENERATE | {"replies": ["On the table, I guess.", listing("dining_table")]},
        location="dining_table",
        source=Source.LLM,
        visited=("dining_table",),
        llm_calls=2,
    ),
    Case(
        "a room is expanded into its furniture",
        "Find an apple.",
        NO_DEFAULTS | GENERATE | {"replies": [listing("living_room"), listing("dining_table")]},
        location="dining_table",
        source=Source.LLM,
        visited=("dining_table",),
        llm_calls=2,
    ),
    Case(
        "the model is asked again if nothing it named exists",
        "Find an apple.",
        NO_DEFAULTS | GENERATE | {"replies": [listing("pantry"), listing("dining_table")]},
        location="dining_table",
        source=Source.LLM,
        visited=("dining_table",),
        llm_calls=2,
    ),
    Case(
        "the person is asked if the model invents twice",
        "Find an apple.",
        NO_DEFAULTS | GENERATE | {"replies": [listing("pantry"), listing("cellar")]},
        location="dining_table",
        source=Source.USER,
        visited=("dining_table",),
        inquiries=1,
        llm_calls=2,
    ),
    Case(
        "the person is asked if the model never answers in the format",
        "Find an apple.",
        NO_DEFAULTS | GENERATE | {"replies": ["Hm.", "Well."]},
        location="dining_table",
        source=Source.USER,
        visited=("dining_table",),
        inquiries=1,
        llm_calls=2,
    ),
    Case(
        "the person is asked if the model does not answer in time",
        "Find an apple.",
        NO_DEFAULTS | {"replies": [None]},
        location="dining_table",
        source=Source.USER,
        inquiries=1,
    ),
    Case(
        "the person is asked if the model fails",
        "Find an apple.",
        NO_DEFAULTS | {"replies": []},
        location="dining_table",
        source=Source.USER,
        inquiries=1,
    ),
    Case(
        "a class is asked of the person, never of the model",
        "Find a fruit.",
        NO_DEFAULTS | {"answers": ["peach", "high table"], "replies": [None]},
        object="peach",
        location="high_table",
        inquiries=2,
    ),
    Case(
        "an answer that is still a class is narrowed down",
        "Find some food.",
        OKB | {"answers": ["a fruit", "the pear", "on the high table"]},
        object="pear",
        location="high_table",
        inquiries=3,
    ),
    Case(
        "a synonym names the object",
        "Find a pitcher.",
        OKB,
        object="pitcher_base",
        location="counter_wagon",
        inquiries=1,
    ),
    Case(
        "an unknown thing is asked about, and the answer is taken",
        "Bring a suger_box.",
        OKB | {"answers": ["sugar box", "counter wagon"]},
        object="sugar_box",
        location="counter_wagon",
        inquiries=2,
    ),
    Case(
        "a slip is asked about, and yes is understood",
        "Take a hamer.",
        OKB | {"answers": ["Yes, please."]},
        object="hammer",
        inquiries=1,
    ),
    Case(
        "a slip was none, and the person says so and then what is meant",
        "Take a hamer.",
        OKB | {"answers": ["no", "the power drill"]},
        object="power_drill",
        inquiries=2,
    ),
    Case(
        "what is meant is said with the no",
        "Take a hamer.",
        OKB | {"answers": ["No, the drill!"]},
        object="power_drill",
        inquiries=1,
    ),
    Case(
        "no and the guess is a no",
        "Take a hamer.",
        OKB | {"answers": ["not the hammer", "power drill"]},
        object="power_drill",
        inquiries=2,
    ),
    Case(
        "a slip of a class is a class",
        "Find a fruti.",
        {"answers": ["yes", "pear"], "replies": [favouring("high_table", among=FRUIT_DEFAULTS)]},
        object="pear",
        inquiries=2,
        llm_calls=1,
    ),
    Case(
        "words beside a known name are asked about",
        "Take the red hammer.",
        OKB | {"answers": ["yes"]},
        object="hammer",
        inquiries=1,
    ),
    Case(
        "of several things one is done, and the person says which",
        "Take a power drill and the hammer.",
        OKB | {"answers": ["the hammer"]},
        object="hammer",
        inquiries=1,
    ),
    Case(
        "a wish is a command",
        "I'd like a hammer, please.",
        OKB,
        object="hammer",
    ),
    Case(
        "what the grammar cannot read is ranked, and done if the person agrees",
        "Come with the hammer!",
        {"answers": ["yes"], "replies": [(0.0, 0.5, 2.0)]},
        object="hammer",
        kind=Kind.BRING,
        inquiries=1,
        llm_calls=1,
    ),
    Case(
        "what the grammar cannot read is written by the model, and done if the person agrees",
        "My nails need driving in with a hammer.",
        GENERATE | {"answers": ["yes"], "replies": ['{"kind": "take", "object": "hammer"}']},
        object="hammer",
        kind=Kind.TAKE,
        inquiries=1,
        llm_calls=1,
    ),
    Case(
        "of several things in words that no grammar reads the person chooses one",
        "Has anyone seen hammer and drill?",
        {"answers": ["yes", "drill"], "replies": [(2.0, 0.5, 0.0)]},
        object="power_drill",
        kind=Kind.FIND,
        inquiries=2,
        llm_calls=1,
    ),
    Case(
        "a room as an answer means its furniture",
        "Find a peach.",
        OKB | {"answers": ["in the kitchen"]},
        location="high_table",
        source=Source.USER,
        visited=("cabinet_kitchen", "counter_wagon", "high_table"),
        inquiries=1,
    ),
    Case(
        "an answer that names no place is followed by the question again",
        "Find a peach.",
        OKB | {"answers": ["in the pantry", "high table"]},
        location="high_table",
        inquiries=2,
    ),
    Case(
        "a thing is on the delivery table, and the person says so",
        "Find a peach.",
        OKB | {"answers": ["On the delivery table!"], "place": {"peach": "delivery"}},
        location="delivery",
        source=Source.USER,
        visited=("delivery",),
        inquiries=1,
    ),
    Case(
        "a wrong answer is followed by the question again",
        "Find a peach.",
        OKB | {"answers": ["desk", "high table"]},
        location="high_table",
        visited=("desk", "high_table"),
        inquiries=2,
    ),
]

FAILURES = [
    Case("empty words", "", status=Status.NOT_UNDERSTOOD, reason="I do not understand"),
    Case("senseless words", "Fnord!", status=Status.NOT_UNDERSTOOD, reason="for example"),
    Case(
        "the model's reading of the words is not what was meant",
        "Come with the hammer!",
        {"answers": ["no"], "replies": [(0.0, 0.5, 2.0)]},
        status=Status.NOT_UNDERSTOOD,
        inquiries=1,
        llm_calls=1,
        reason="I do not understand 'Come with the hammer!'",
    ),
    Case(
        "nobody confirms the model's reading of the words",
        "Come with the hammer!",
        {"answers": [None], "replies": [(0.0, 0.5, 2.0)]},
        status=Status.NOT_UNDERSTOOD,
        inquiries=1,
        llm_calls=1,
    ),
    Case(
        "there is no model to read what the grammar cannot",
        "Come with the hammer!",
        OKB | {"answers": ["yes"]},
        status=Status.NOT_UNDERSTOOD,
    ),
    Case(
        "the model does not answer what the words mean",
        "Come with the hammer!",
        {"answers": ["yes"], "replies": [None]},
        status=Status.NOT_UNDERSTOOD,
    ),
    Case(
        "the model reads into the words what does not exist",
        "Come with the hammer!",
        GENERATE | {"answers": ["yes"], "replies": ['{"kind": "bring", "object": "crown"}']},
        status=Status.NOT_UNDERSTOOD,
        llm_calls=1,
    ),
    Case(
        "a slip was none, and the person says no more",
        "Take a hamer.",
        OKB | {"answers": ["no", "I don't know"]},
        status=Status.NOT_DONE,
        inquiries=2,
        reason="I know no 'hamer'",
    ),
    Case(
        "an unknown thing, and the person does not know either",
        "Bring a suger_box.",
        {"answers": ["I don't know"]},
        status=Status.NOT_DONE,
        inquiries=1,
        reason="the nearest that I know is sugar_box",
    ),
    Case(
        "an unknown thing like no other",
        "Bring a zebra.",
        {"answers": []},
        status=Status.NOT_DONE,
        inquiries=1,
        reason="I know no 'zebra', and",
    ),
    Case(
        "answers that make no sense are not waited for without end",
        "Find a fruit.",
        {"answers": ["hm", "hmm", "hmmm", "apple"]},
        status=Status.NOT_DONE,
        inquiries=3,
        reason="did not understand your answer 'hmmm'",
    ),
    Case(
        "the person does not know where",
        "Find an apple.",
        OKB | {"answers": ["no idea"]},
        status=Status.NOT_DONE,
        inquiries=1,
        reason="I do not know where the apple is, and you could not tell me",
    ),
    Case(
        "the person stays silent",
        "Find an apple.",
        OKB | {"answers": [None]},
        status=Status.NOT_DONE,
        inquiries=1,
        reason="nobody answered within 120 s",
    ),
    Case(
        "there is no person",
        "Find an apple.",
        OKB | {"answers": []},
        status=Status.NOT_DONE,
        inquiries=1,
        reason="no more answers",
    ),
    Case(
        "it is nowhere",
        "Find a power_drill.",
        {"answers": ["desk"], "place": {"power_drill": "bed"}},
        status=Status.NOT_DONE,
        visited=("shelf_lobby", "desk"),
        inquiries=1,
        reason="I did not find the power_drill at shelf_lobby, desk",
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
    assert run.outcome.reason == "The power_drill is at shelf_lobby."


def test_take_holds_the_thing() -> None:
    run = run_mission("Take a hammer.")
    assert (run.world.held, run.world.at) == ("hammer", "shelf_lobby")


def test_bring_delivers_the_thing() -> None:
    run = run_mission("Bring a tennis_ball.")
    assert run.world.resting_place("tennis_ball") == "delivery"


def test_failing_far_away_the_robot_comes_back_to_say_so() -> None:
    run = run_mission("Find a power_drill.", place={"power_drill": "bed"}, answers=["no idea"])
    assert run.outcome.status == Status.NOT_DONE
    assert run.world.at == "person"


def test_a_blocked_place_is_passed_over_and_said() -> None:
    run = run_mission(
        "Find a power_drill.",
        fault=lambda goal: "the way is blocked" if goal == DriveTo("shelf_lobby") else None,
        answers=["I don't know"],
    )
    assert run.outcome.visited == ()
    assert "I could not get to shelf_lobby: the way is blocked" in run.outcome.reason


def test_a_missed_grasp_is_tried_once_more_after_another_look() -> None:
    misses = iter(["it slipped from the fingers", None])
    run = run_mission(
        "Take a hammer.", fault=lambda goal: next(misses) if isinstance(goal, Pick) else None
    )
    assert run.outcome.status == Status.DONE
    kinds = [type(goal) for goal in run.goals]
    assert kinds == [DriveTo, LookAt, Pick, DriveTo, LookAt, Pick]
    assert run.outcome.visited == ("shelf_lobby",)


def test_a_grasp_that_keeps_failing_is_reported() -> None:
    run = run_mission("Take a hammer.", fault=lambda g: "it slipped" * isinstance(g, Pick) or None)
    assert (run.outcome.status, run.outcome.reason) == (Status.NOT_DONE, "it slipped")


def test_a_thing_that_cannot_be_put_down_is_reported() -> None:
    def fault(goal: Goal) -> str | None:
        return "the table is full" if isinstance(goal, PutDown) else None

    run = run_mission("Bring a hammer.", fault=fault)
    assert run.outcome.status == Status.NOT_DONE
    assert run.outcome.reason == (
        "I could not put it on the delivery table: the table is full; nor on the coffee_table, "
        "the sofa, the dining_table, and you could not tell me; I still hold the hammer"
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
    assert run.outcome.status == Status.DONE
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
