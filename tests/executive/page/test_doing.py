"""What the page says of what the robot is doing is what the behaviours declare."""

from typing import Any

import pytest

from executive.page.doing import Doing
from executive.page.places import Places
from executive.records import Tick, TreeShape
from executive.testing.bench import Run, run_mission


@pytest.fixture(scope="module")
def mission() -> Run:
    return run_mission("Bring a fruit", answers=["peach", "sofa", "high_table"], llm=False)


@pytest.fixture(scope="module")
def told(mission: Run) -> list[dict[str, Any]]:
    doing = Doing(mission.notebook.all(TreeShape)[0])
    return [doing.now(tick) for tick in mission.ticks]


def test_each_activity_of_a_mission_is_told_in_its_order(told: list[dict[str, Any]]) -> None:
    activities = [now["activity"] for now in told if now["activity"]]
    in_order = [a for a, before in zip(activities, ["", *activities], strict=False) if a != before]
    search = ["driving", "looking"]
    assert in_order == ["asking", *search, "asking", *search, "handling", "driving", "handling"]


def test_on_the_way_to_a_place_it_is_told_which_and_for_what(told: list[dict[str, Any]]) -> None:
    on_the_way = [now for now in told if now["activity"] == "driving" and now["searching"]]
    assert [now["place"] for now in on_the_way] == ["sofa", "high_table"]
    assert {now["thing"] for now in on_the_way} == {"peach"}


def test_with_a_thing_in_the_hand_no_place_of_the_search_is_told(
    told: list[dict[str, Any]],
) -> None:
    carrying = [now for now in told if now["activity"] == "driving" and now["held"]]
    assert carrying
    assert not any(now["place"] for now in carrying)


def last_places(ticks: list[Tick]) -> dict[str, str]:
    places = Places()
    for tick in ticks:
        found = places.after(tick.situation, searching=True)
    assert found == places.at_the_end() or places.at_the_end()
    ended = places.at_the_end() or {}
    return {one["place"]: (one["state"], *one["sources"]) for one in ended["places"]}


def test_in_the_end_each_place_has_what_came_of_it_and_who_named_it(mission: Run) -> None:
    assert last_places(mission.ticks) == {
        "high_table": ("found", "user"),
        "sofa": ("empty", "user"),
    }


def test_a_place_that_is_not_searched_any_more_is_not_where_the_robot_is(mission: Run) -> None:
    at_sofa = next(t for t in mission.ticks if t.situation.get("candidate"))
    looked = {**at_sofa.situation, "visited": ["sofa"]}
    states = [
        Places().after(looked, searching=searching)["places"][0]["state"]
        for searching in (True, False)
    ]
    assert states == ["current", "empty"]


def test_a_belief_is_shown_with_its_sources_and_the_plan_with_its_order() -> None:
    shown = Places().after(
        {
            "object": "mug",
            "belief": {
                "places": [
                    {"place": "desk", "probability": 0.7, "shares": {"memory": 0.6, "llm": 0.1}},
                    {"place": "sofa", "probability": 0.2, "shares": {"llm": 0.2}},
                    {"place": "bed", "probability": 0.001, "shares": {"llm": 0.001}},
                ]
            },
            "plan": {"order": ["sofa", "desk"], "ask_after": 2},
        },
        searching=True,
    )
    told = [(one["place"], one["chance"], one["turn"]) for one in shown["places"]]
    assert told == [("desk", 0.7, 2), ("sofa", 0.2, 1)]
    assert shown["places"][0]["sources"] == {"memory": 0.6, "llm": 0.1}
    assert shown["ask_after"] == 2
