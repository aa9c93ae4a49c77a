"""What an experimenter does is an event like any other: the tree goes by it, and nobody is told."""

from collections.abc import Callable

import pytest

from executive.events import Deed, Inbox, Intervened
from executive.records import Intervention
from executive.testing.bench import Run, run_mission
from executive.types.goals import Goal
from executive.types.outcome import MissionStatus
from kb.facts import FactStore

DONE, NOT_DONE = MissionStatus.DONE, MissionStatus.NOT_DONE
ANNA = "Anna"


def stepping_in(deed: Deed, became: str, at: int) -> Callable[[Goal, Inbox], None]:
    """Does it as the robot begins with this goal, counted from 1."""
    begun: list[Goal] = []

    def during(goal: Goal, inbox: Inbox) -> None:
        begun.append(goal)
        if len(begun) == at:
            inbox.post(Intervened(ANNA, deed, "as it was", became))

    return during


def run(deed: Deed, became: str, at: int = 1, search: str = "plan") -> Run:
    return run_mission(
        "Find the hammer",
        llm=False,
        search=search,
        during=stepping_in(deed, became, at),
        facts=FactStore.believing({"hammer": ["desk"]}),
    )


@pytest.mark.parametrize("search", ["plan", "paper"])
def test_sent_elsewhere_on_its_way_the_robot_looks_there_instead(search: str) -> None:
    mission = run(Deed.PLACE, "shelf_lobby", search=search)
    assert (mission.outcome.status, mission.outcome.visited) == (DONE, ("shelf_lobby",))
    assert mission.outcome.source == "experimenter"


@pytest.mark.parametrize("search", ["plan", "paper"])
def test_sent_elsewhere_while_it_looks_the_robot_goes_there_next(search: str) -> None:
    mission = run(Deed.PLACE, "shelf_lobby", at=2, search=search)
    assert mission.outcome.visited[:2] == ("desk", "shelf_lobby")


def test_where_there_is_no_such_place_the_robot_goes_on_by_itself() -> None:
    mission = run(Deed.PLACE, "moon")
    assert mission.outcome.status == DONE
    assert "moon" not in mission.outcome.visited


def test_what_is_seen_already_is_not_looked_for_elsewhere() -> None:
    mission = run_mission(
        "Bring the hammer",
        llm=False,
        during=stepping_in(Deed.PLACE, "sofa", at=3),
        facts=FactStore.believing({"hammer": ["shelf_lobby"]}),
    )
    assert (mission.outcome.status, mission.outcome.visited) == (DONE, ("shelf_lobby",))


@pytest.mark.parametrize("deed", [Deed.ANSWER, Deed.HOLD, Deed.WORDS])
def test_what_is_said_otherwise_changes_no_decision(deed: Deed) -> None:
    plain = run_mission(
        "Find the hammer", llm=False, facts=FactStore.believing({"hammer": ["desk"]})
    )
    mission = run(deed, "Hello")
    assert mission.outcome.visited == plain.outcome.visited
    assert len(mission.ticks) == len(plain.ticks) + 1


def test_who_stepped_in_is_recorded_beside_the_event() -> None:
    mission = run(Deed.WORDS, "Hello")
    assert mission.notebook.all(Intervention) == [Intervention(ANNA, "words", "as it was", "Hello")]
