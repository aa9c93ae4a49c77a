"""An experimenter holds where the robot looks next, while the language model writes its list."""

from collections.abc import Iterable
from functools import partial
from pathlib import Path
from typing import Any

import pytest
from replays import recorded
from thinking import slow

from executive.app.parts import Change, Parts
from executive.events import OFF, ON, Deed, Inbox, Intervened
from executive.records import Utterance
from executive.replay import replay
from executive.testing import bench
from executive.testing.bench import Run
from executive.types.goals import DriveTo
from executive.types.outcome import MissionStatus
from executive.types.results import Failed, Result
from sim.fake import FakeRobot

LIST = '{"places": ["bookshelf_bedroom"]}'
FIRST, LISTED = "coffee_table", "bookshelf_bedroom"
"""Where the robot goes when nothing is known, and where by the list."""
THINKING_S = 0.5
MISSION = {"search": "plan", "elicit": "generate", "defaults": False, "place": {"mug": LISTED}}


def posted(inbox: Inbox, event: Intervened) -> Result:
    inbox.post(event)
    return Failed("nobody waits for this")


def held(*orders: tuple[float, str]) -> Change:
    """Choices are held; at these times (s) the robot is let go to a place, or everywhere: OFF."""

    def change(parts: Parts) -> Parts:
        assert isinstance(parts.robot, FakeRobot)
        for at_s, order in orders:
            deed = Deed.HOLD_PLACE if order == OFF else Deed.PLACE
            event = Intervened("Anna", deed, "", order)
            parts.robot._world.schedule(at_s, partial(posted, parts.inbox, event))
        parts.inbox.post(Intervened("Anna", Deed.HOLD_PLACE, "", ON))
        return slow([LIST] * 4, THINKING_S)(parts)

    return change


def mission(*orders: tuple[float, str], **given: Any) -> Run:
    run = bench.run_mission("Find the mug", change=held(*orders), **{**MISSION, **given})
    assert run.outcome.status == MissionStatus.DONE
    return run


def drives(run: Run) -> list[str]:
    return [goal.place for goal in run.goals if isinstance(goal, DriveTo)][:-1]


def waited(run: Run) -> list[str]:
    """The places that waited, one after the other."""
    choices = [tick.situation.get("held_choice") for tick in run.ticks]
    return [*dict.fromkeys(choice["place"] for choice in choices if choice)]


def told(run: Run) -> list[str]:
    texts = [one.text for one in run.notebook.all(Utterance) if one.speaker == "robot"]
    return [text for text in texts if text.startswith("I look")]


def test_what_waits_is_what_the_robot_would_do_with_the_list() -> None:
    run = mission((1.0, OFF))
    assert waited(run) == [FIRST, LISTED]
    assert drives(run) == [LISTED]
    [once] = told(run)
    assert "bookshelf in the bedroom" in once


def test_before_the_list_is_there_it_is_let_go_and_turns_round_by_the_list() -> None:
    run = mission((0.2, FIRST), (0.3, OFF))
    assert waited(run) == [FIRST]
    assert drives(run) == [FIRST, LISTED]


@pytest.mark.parametrize("at_s", [0.2, 1.0])
def test_it_is_sent_elsewhere_whatever_the_list_says(at_s: float) -> None:
    run = mission((at_s, "desk"), (at_s + 0.1, OFF))
    assert drives(run)[0] == "desk"
    assert told(run)[0].startswith("I look for the mug on the desk")
    assert run.outcome.location == LISTED


def test_who_lets_go_what_was_shown_before_the_list_came_is_obeyed() -> None:
    run = mission((1.0, FIRST), (1.1, OFF))
    assert waited(run) == [FIRST, LISTED]
    assert drives(run) == [FIRST, LISTED]


ORDERS: tuple[Iterable[tuple[float, str]], ...] = (
    [(1.0, OFF)],
    [(0.2, FIRST), (0.3, OFF)],
    [(0.2, "desk"), (0.7, "sofa"), (9.0, OFF)],
    [(1.0, "desk"), (1.1, OFF)],
    [(1.0, FIRST), (1.1, OFF)],
    [(THINKING_S, FIRST), (THINKING_S, OFF)],
)


@pytest.mark.parametrize("orders", ORDERS)
def test_it_replays_tick_for_tick(tmp_path: Path, orders: Iterable[tuple[float, str]]) -> None:
    run = recorded(tmp_path, "Find the mug", change=held(*orders), **MISSION)
    again = replay(run)
    assert (again.parting, again.notes) == (None, ())
