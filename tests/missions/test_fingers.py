"""What the robot believes of its hand is what the fingers feel."""

import io
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from executive.app.parts import Change, as_they_are
from executive.app.session import Session
from executive.config import KnowledgeSystem, Settings
from executive.events import HandFelt, Inbox, StopRequested
from executive.replay.replaying import replay
from executive.situation import Hand
from executive.types.goals import Goal, Pick, PutDown
from executive.types.home import SOMETHING
from executive.types.outcome import MissionStatus, Outcome
from executive.types.results import Failed, Result
from logs.recording.reader import Run
from sim.fake import FakeWorld

Ending = Callable[[FakeWorld, Result], Result]


class House:
    """A session in the instant world in which goals can be made to end otherwise."""

    def __init__(self, runs: Path, change: Change = as_they_are) -> None:
        self.inbox = Inbox()
        self.session = Session(
            Settings(
                world="fake", llm="none", knowledge=KnowledgeSystem.OKB, user="oracle", runs=runs
            ),
            inbox=self.inbox,
            out=io.StringIO(),
            change=change,
        )
        assert isinstance(self.session.world, FakeWorld)
        self.world = self.session.world
        self.changes: dict[type[Goal], Ending] = {}
        self._start = self.session.parts.robot.start
        self.session.parts.robot.start = self._changed  # type: ignore[method-assign]

    def _changed(self, goal: Goal) -> int:
        """Start a goal; if its kind is to end otherwise, it does so once."""
        request = self._start(goal)
        if change := self.changes.pop(type(goal), None):
            (due,) = (due for due in self.world._agenda if due.request == request)
            finish = due.finish
            due.finish = lambda: change(self.world, finish())
        return request

    def run(self, words: str) -> Outcome:
        """Run a mission; afterwards the robot knows what it holds, and the recording replays."""
        outcome = self.session.run(words)
        assert self.session._before.in_hand == self.world.held
        assert self.session.folder
        assert replay(self.session.folder).parting is None
        return outcome

    def felt(self) -> list[bool]:
        assert self.session.folder
        events = (at.value for at in Run(self.session.folder).events())
        return [event.holding for event in events if isinstance(event, HandFelt)]


@pytest.fixture
def house(tmp_path: Path) -> Iterator[House]:
    house = House(tmp_path)
    yield house
    house.session.close()


def fails(world: FakeWorld, result: Result) -> Result:
    return Failed("I cannot fold my arm without touching anything")


def slips(world: FakeWorld, result: Result) -> Result:
    assert world.held
    world.things["hammer"], world.held = "floor", None
    return result


def test_a_thing_that_was_gripped_as_the_mission_was_stopped_is_in_the_hand(house: House) -> None:
    def stop(world: FakeWorld, result: Result) -> Result:
        house.inbox.post(StopRequested("the person"))
        return result

    house.changes[Pick] = stop
    assert house.run("Take the apple").status == MissionStatus.STOPPED
    assert house.session._before.in_hand == "apple"
    assert house.run("Bring the apple").visited == ()
    assert house.world.resting_place("apple") == "delivery"


def test_a_thing_that_was_let_go_as_the_mission_was_stopped_is_not(house: House) -> None:
    def stop(world: FakeWorld, result: Result) -> Result:
        house.inbox.post(StopRequested("the person"))
        return result

    house.changes[PutDown] = stop
    assert house.run("Bring the apple").status == MissionStatus.STOPPED
    assert house.felt() == [False, True, False]


def test_a_pick_that_failed_with_the_thing_in_the_hand_got_hold_of_it(house: House) -> None:
    house.changes[Pick] = fails
    assert house.run("Bring the hammer").status == MissionStatus.DONE


def test_a_pick_that_is_said_to_have_worked_with_an_empty_hand_has_not(house: House) -> None:
    house.changes[Pick] = slips
    outcome = house.run("Take the hammer")
    assert outcome.status == MissionStatus.NOT_DONE


def test_a_put_down_that_failed_after_the_hand_opened_leaves_it_empty(house: House) -> None:
    house.changes[PutDown] = fails
    house.run("Bring the hammer")
    assert house.world.resting_place("hammer") == "delivery"


def test_what_someone_took_from_the_hand_between_missions_is_not_in_it(house: House) -> None:
    house.run("Take the hammer")
    house.world.things["hammer"], house.world.held = "desk", None
    assert house.run("Take the mug").status == MissionStatus.DONE


def test_what_someone_put_into_the_hand_is_something(house: House) -> None:
    del house.world.things["hammer"]
    house.world.held = "hammer"
    house.session.run("Find the mug")
    assert house.session._before.in_hand == SOMETHING
    assert house.session.folder
    assert replay(house.session.folder).parting is None
    assert house.run("Put it down").status == MissionStatus.DONE


@pytest.mark.parametrize(
    ("before", "reached_for", "holding", "after"),
    [
        (None, "mug", True, "mug"),
        (None, "", True, SOMETHING),
        ("mug", "apple", True, "mug"),
        ("mug", "mug", False, None),
    ],
)
def test_what_is_felt_is_what_was_held_or_else_reached_for(
    before: str | None, reached_for: str, holding: bool, after: str | None
) -> None:
    hand = Hand(in_hand=before, reached_for=reached_for)
    hand.feel(holding)
    assert hand.in_hand == after


def test_a_robot_that_cannot_feel_is_believed(tmp_path: Path) -> None:
    class Numb:
        def __init__(self, robot: Any) -> None:
            self._robot = robot
            self.start, self.cancel, self.views = robot.start, robot.cancel, robot.views

        @property
        def holding(self) -> None:
            return None

    house = House(tmp_path, lambda parts: replace(parts, robot=Numb(parts.robot)))
    assert house.run("Take the hammer").status == MissionStatus.DONE
    assert house.felt() == []
    assert house.run("Bring the hammer").reason == "Here is the hammer."


@pytest.mark.physics
@pytest.mark.parametrize("fault", [(), ("stuck=joint7@17.9-27",)])
def test_in_physics_what_is_believed_is_true(fault: tuple[str, ...], tmp_path: Path) -> None:
    session = Session(
        Settings(
            llm="none",
            knowledge=KnowledgeSystem.OKB,
            user="oracle",
            detector="simulated",
            camera_hz=0.0,
            seed=1,
            fault=fault,
            runs=tmp_path,
        ),
        out=io.StringIO(),
    )
    for words in ("Bring a mustard_bottle", "Take a pitcher_base"):
        session.run(words)
        assert session._before.in_hand == session.world.held
        assert session.folder
        assert replay(session.folder).parting is None
    session.close()
