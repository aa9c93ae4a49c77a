"""Missions that are searched by a belief and a plan."""

from collections.abc import Callable
from functools import partial
from math import inf

import pytest

from executive.belief import ELSEWHERE
from executive.records import Planned, Utterance, WaysTold
from executive.testing import bench
from executive.testing.bench import Run, four_rooms
from executive.types.goals import DriveTo, Goal, LookAt
from executive.types.outcome import MissionStatus
from executive.types.perception import Detection, Frame
from kb.facts import FactStore
from kb.ontology.ontology import Ontology
from sim.fake import FakeDetector
from trees.hearing import ONTOLOGY_TRUST

run_mission = partial(bench.run_mission, search="plan")
HOME = [place.name for place in four_rooms().places()]


def scores(**likely: float) -> list[float]:
    """Of a ranking that has these places likeliest."""
    return [likely.get(place, -6.0) for place in HOME]


def plans(run: Run) -> list[Planned]:
    found: list[Planned] = run.notebook.all(Planned)
    return found


def said(run: Run) -> list[str]:
    return [one.text for one in run.notebook.all(Utterance) if one.speaker == "robot"]


def test_what_lies_on_the_way_is_looked_at_before_what_is_a_little_likelier() -> None:
    near_and_far = scores(sofa=0.0, desk=0.1)
    run = run_mission("Find the mug", replies=[near_and_far], defaults=False, place={"mug": "desk"})
    assert run.outcome.visited == ("sofa", "desk")
    assert run.outcome.inquiries == 0


def test_the_ontology_is_believed_as_far_as_the_home_has_what_it_speaks_of(monkeypatch) -> None:
    heard = {"desk": 0.4, "sofa": 0.2}
    monkeypatch.setattr(Ontology, "likely_places", lambda self, name: heard)
    first = plans(run_mission("Find the mug", llm=False))[0]
    said = dict(zip(first.places, first.says, strict=True))
    assert f"ontology {ONTOLOGY_TRUST * 0.4:.2f}" in said["desk"]
    assert f"ontology {ONTOLOGY_TRUST * 0.2:.2f}" in said["sofa"]
    assert first.elsewhere == pytest.approx((1 - ONTOLOGY_TRUST * 0.6) * ELSEWHERE)


def test_with_a_free_question_the_person_is_asked_at_once() -> None:
    run = run_mission("Find the mug", llm=False, defaults=False, parameters={"question_s": 0.0})
    assert (run.outcome.inquiries, len(run.outcome.visited)) == (1, 1)
    assert run.outcome.source == "user"
    assert plans(run)[0].decision == "ask"


def test_where_the_person_says_that_it_is_not_is_looked_at_last() -> None:
    facts = FactStore()
    facts.saw(["mug"], "coffee_table")
    facts.heard_not("mug", ["coffee_table"])
    run = run_mission("Find the mug", llm=False, answers=["I don't know"], facts=facts)
    assert run.outcome.status == MissionStatus.DONE
    assert run.outcome.visited[-1] == "coffee_table"
    assert {*run.outcome.visited} == {*HOME}


def test_a_silent_person_is_not_asked_again_and_all_is_looked_at() -> None:
    run = run_mission(
        "Find the mug",
        llm=False,
        defaults=False,
        answers=["I don't know"],
        parameters={"question_s": 0.0},
    )
    assert run.outcome.status == MissionStatus.DONE
    assert run.outcome.inquiries == 1
    assert plans(run)[1].may_ask is False


def test_nobody_is_asked_until_all_was_looked_at_if_a_question_is_dear() -> None:
    run = run_mission(
        "Find the mug",
        llm=False,
        defaults=False,
        place={"mug": "delivery"},
        answers=["I don't know"],
        parameters={"question_s": 1e9},
    )
    assert sorted(run.outcome.visited) == sorted(HOME)
    assert run.outcome.inquiries == 1
    assert run.outcome.reason.endswith("and you could not tell me")


def test_what_the_memory_has_is_looked_at_first_and_no_model_is_asked() -> None:
    facts = FactStore.believing({"mug": ["bed"]})
    run = run_mission("Find the mug", facts=facts, place={"mug": "bed"}, defaults=False)
    assert run.outcome.visited == ("bed",)
    assert (run.outcome.source, run.outcome.llm_calls) == ("memory", 0)


def test_a_look_in_vain_changes_the_plan_and_then_the_model_is_asked() -> None:
    facts = FactStore.believing({"mug": ["bed"]})
    run = run_mission(
        "Find the mug",
        facts=facts,
        replies=[scores(desk=0.0)],
        place={"mug": "desk"},
        defaults=False,
    )
    assert run.outcome.visited == ("bed", "desk")
    assert run.outcome.llm_calls == 1
    first, second = plans(run)[:2]
    assert first.probabilities[first.places.index("bed")] > 0.9
    assert second.probabilities[second.places.index("bed")] < 0.2


def no_way_to(place: str) -> Callable[[Goal], str | None]:
    return lambda goal: "the way is blocked" if goal == DriveTo(place) else None


def test_a_blocked_way_is_planned_around() -> None:
    shut = no_way_to("coffee_table")
    run = run_mission("Find the mug", llm=False, defaults=False, fault=shut, place={"mug": "sofa"})
    assert run.outcome.status == MissionStatus.DONE
    assert "coffee_table" not in run.outcome.visited
    assert "coffee_table" not in plans(run)[-1].order


@pytest.mark.parametrize(
    ("goal", "why_not"),
    [
        (DriveTo("bed"), "I could not get to the bed: the way is blocked"),
        (LookAt("bed", 0), "I could not look at the bed: the way is blocked"),
    ],
)
def test_what_the_person_says_is_where_nobody_can_look_is_not_searched_elsewhere(
    goal: Goal, why_not: str
) -> None:
    run = run_mission(
        "Find the mug",
        llm=False,
        defaults=False,
        answers=["on the bed"],
        fault={goal: "the way is blocked"}.get,
        parameters={"question_s": 0.0},
        place={"mug": "desk"},
    )
    assert (run.outcome.status, run.outcome.reason) == (MissionStatus.NOT_DONE, why_not)


def test_of_several_places_that_the_person_says_each_is_looked_at() -> None:
    run = run_mission(
        "Find the mug",
        llm=False,
        defaults=False,
        answers=["on the bed or on the sofa"],
        fault=no_way_to("bed"),
        parameters={"question_s": 0.0},
        place={"mug": "sofa"},
    )
    assert (run.outcome.status, run.outcome.visited) == (MissionStatus.DONE, ("sofa",))


def test_that_a_place_is_out_of_reach_is_told() -> None:
    shut, place = no_way_to("coffee_table"), {"mug": "counter_wagon"}
    run = run_mission("Find the mug", llm=False, fault=shut, place=place)
    assert (run.outcome.inquiries, run.outcome.visited) == (0, ("dining_table", "counter_wagon"))
    assert said(run)[1] == "I could not get to the coffee table: the way is blocked."


def test_with_nobody_to_ask_the_likeliest_of_the_places_in_reach_is_next() -> None:
    facts = FactStore()
    facts.heard("power_drill", ["bed"])
    silent = run_mission(
        "Find the power drill", llm=False, facts=facts, fault=no_way_to("bed"), answers=["I can't"]
    )
    assert silent.outcome.visited == ("shelf_lobby",)


class OverlooksOnce(FakeDetector):
    """Sees nothing in the first picture."""

    looked = False

    def detect(self, frame: Frame) -> tuple[Detection, ...]:
        self.looked, before = True, self.looked
        return super().detect(frame) if before else ()


def test_the_answer_is_believed_even_of_a_place_that_was_looked_at() -> None:
    run = run_mission(
        "Find the mug",
        replies=[scores(coffee_table=0.0)],
        defaults=False,
        detector=OverlooksOnce,
        parameters={"question_s": 1.0},
    )
    assert run.outcome.visited == ("coffee_table", "coffee_table")
    assert run.outcome.source == "user"


def test_among_the_likeliest_it_is_planned_and_the_others_come_in_when_those_are_done() -> None:
    run = run_mission(
        "Find the mug",
        llm=False,
        defaults=False,
        place={"mug": "delivery"},
        answers=["I don't know"],
        parameters={"planned": 3, "question_s": 1e9},
    )
    assert max(len(one.order) for one in plans(run)) == 3
    assert set(HOME) <= set(run.outcome.visited)


def test_every_probability_keeps_who_gave_how_much() -> None:
    run = run_mission("Find the mug", replies=[scores(desk=0.0)], place={"mug": "coffee_table"})
    belief = run.ticks[-1].situation["belief"]
    for place in belief["places"]:
        assert sum(place["shares"].values()) == pytest.approx(place["probability"], abs=1e-3)
    assert {"ontology", "llm"} <= {s for place in belief["places"] for s in place["shares"]}


def test_of_the_default_locations_the_model_says_which_is_likeliest() -> None:
    run = run_mission("Find the mug", replies=[scores(dining_table=0.0)])
    assert plans(run)[1].places[0] == "dining_table"


def test_a_list_that_the_model_writes_is_verified_and_counts() -> None:
    run = run_mission(
        "Find the mug",
        replies=['{"places": ["pantry", "bookshelf_bedroom"]}'],
        elicit="generate",
        defaults=False,
        place={"mug": "bookshelf_bedroom"},
    )
    assert run.dropped == ["pantry"]
    with_list = plans(run)[1]
    assert with_list.places[0] == "bookshelf_bedroom"
    assert with_list.says[0].startswith("llm 0.75")


def test_a_model_that_fails_is_asked_once_and_the_search_goes_on() -> None:
    run = run_mission("Find the mug", replies=[], defaults=False, place={"mug": "bed"})
    assert run.outcome.status == MissionStatus.DONE
    assert len(run.model.requests) == 1  # type: ignore[union-attr]


def test_the_person_is_told_the_next_places_once() -> None:
    run = run_mission("Find the mug", llm=False, defaults=False, place={"mug": "refrigerator"})
    told = [text for text in said(run) if text.startswith("I look for")]
    assert len(told) < len(run.outcome.visited)
    assert told[0].endswith(": it may be anywhere.")


def test_a_decision_says_what_looking_on_and_asking_would_cost() -> None:
    run = run_mission("Find the mug", llm=False, defaults=False, parameters={"question_s": 0.0})
    assert plans(run)[0].text.startswith("I ask, because looking on would cost ")


def test_a_decision_says_how_far_each_place_is_so_that_its_order_can_be_understood() -> None:
    near_and_far = scores(sofa=0.0, desk=0.1)
    run = run_mission("Find the mug", replies=[near_and_far], defaults=False, place={"mug": "desk"})
    first, second = plans(run)[-2:]
    away = dict(zip(first.places, first.away, strict=True))
    assert away["sofa"] < away["desk"]
    assert dict(zip(second.places, second.away, strict=True))["sofa"] == -1.0


def test_the_ways_that_were_told_are_recorded_once() -> None:
    run = run_mission("Find the mug", llm=False, defaults=False, place={"mug": "bed"})
    pairs = [(w.start, place) for w in run.notebook.all(WaysTold) for place in w.places]
    assert len(pairs) == len(set(pairs)) > len(HOME)


def test_a_robot_that_cannot_tell_its_ways_searches_all_the_same() -> None:
    run = run_mission(
        "Find the mug",
        llm=False,
        defaults=False,
        place={"mug": "bed"},
        change=lambda parts: hiding_ways(parts),
    )
    assert run.outcome.status == MissionStatus.DONE


def hiding_ways(parts):  # type: ignore[no-untyped-def]
    parts.robot.seconds = lambda start, place: float("nan")
    return parts


def test_a_home_without_any_way_has_the_person_asked() -> None:
    def locked_in(parts):  # type: ignore[no-untyped-def]
        parts.robot.seconds = lambda start, place: inf
        return parts

    run = run_mission("Find the mug", llm=False, defaults=False, change=locked_in)
    assert plans(run)[0].decision == "ask"
