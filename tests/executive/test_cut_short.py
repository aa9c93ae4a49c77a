"""Whatever cuts a mission short, the robot is told to halt, and the recording replays the same."""

import io
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
from houses import OKB, House
from hypothesis import given, settings
from hypothesis import strategies as st

from executive.app.session import Session
from executive.config import Settings
from executive.events import Broke, StopRequested
from executive.replay.replaying import replay
from executive.types.goals import DriveTo, Goal, Halt, Pick
from executive.types.outcome import MissionStatus
from executive.types.results import Failed
from logs.recording.reader import Run
from trees.looking import SeeTarget


@pytest.fixture
def house(tmp_path: Path) -> Iterator[House]:
    house = House(tmp_path)
    yield house
    house.session.close()


def broken(*arguments: object) -> Any:
    raise ConnectionError("driver gone")


# --- stops ---


def test_the_first_of_several_stops_is_told(house: House) -> None:
    stops = iter(("the person", "SIGTERM", "Ctrl-C"))
    house.during = lambda goal: house.inbox.post(StopRequested(next(stops)))
    assert house.run().reason == "stopped by the person"
    assert [e.by for e in house.events() if isinstance(e, StopRequested)] == [
        "the person",
        "SIGTERM",
    ]


def test_several_stops_at_once_are_one(house: House) -> None:
    house.during = lambda goal: [house.inbox.post(StopRequested(by)) for by in "ab"] and None
    assert house.run().reason == "stopped by a"


def test_a_stop_before_the_mission_stops_it_before_anything_is_done(house: House) -> None:
    house.inbox.post(StopRequested("SIGTERM"))
    assert house.run().status == MissionStatus.STOPPED
    assert house.goals == [Halt()]


def test_a_stop_after_all_is_done_undoes_nothing_and_stops_no_other_mission(house: House) -> None:
    tell = house.session.parts.user.tell

    def told(text: str) -> None:
        tell(text)
        if text.startswith("I took"):
            house.inbox.post(StopRequested("the person"))

    house.session.parts.user.tell = told  # type: ignore[method-assign]
    assert house.run().status == MissionStatus.DONE
    assert isinstance(house.events()[-1], StopRequested)
    assert house.run("Bring the power_drill").status == MissionStatus.DONE


def test_what_an_earlier_mission_asked_for_is_not_delivered_to_the_next(house: House) -> None:
    late = house.inbox.open()
    house.inbox.end(late, Failed("too late"))
    assert house.run().status == MissionStatus.DONE
    assert "too late" not in str(house.events())


def carries(house: House) -> bool:
    """Whether the robot drives with something in its hand."""
    return isinstance(house.goals[-1], DriveTo) and any(isinstance(g, Pick) for g in house.goals)


def test_what_is_in_the_hand_when_it_is_stopped_is_told(house: House) -> None:
    def stop(goal: Goal) -> None:
        if carries(house):
            house.inbox.post(StopRequested("the person"))

    house.during = stop
    stopped = house.run("Bring a power_drill")
    assert stopped.reason == "stopped by the person; I still hold the power drill"
    assert stopped.tasks[0].reason == stopped.reason


def test_what_fell_while_it_came_to_rest_is_not_told_as_held(house: House) -> None:
    def stop(goal: Goal) -> None:
        if carries(house):
            house.inbox.post(StopRequested("the person"))
            house.world.held = None

    house.during = stop
    assert house.run("Bring a power_drill").reason == "stopped by the person"


# --- what raises on the way down ---


def test_where_the_driver_cannot_call_off_the_robot_is_halted(house: House) -> None:
    house.session.parts.robot.cancel = broken  # type: ignore[method-assign]
    house.stop_at(DriveTo)
    assert house.run().reason == "stopped by the person"
    assert house.goals[-1] == Halt()
    assert not house.world.busy


def test_a_halt_that_fails_is_tried_again(house: House) -> None:
    fails = iter((True, False))
    house.stop_at(DriveTo)
    house.world.fault = lambda goal: (
        "my brake slips" if isinstance(goal, Halt) and next(fails) else None
    )
    assert house.run().reason == "stopped by the person"
    assert house.goals[-2:] == [Halt(), Halt()]


def test_a_robot_that_cannot_halt_is_told_of(house: House) -> None:
    house.stop_at(DriveTo)
    house.world.fault = lambda goal: "my brake slips" if isinstance(goal, Halt) else None
    why = "stopped by the person; I may not be at rest: my brake slips"
    assert house.run().reason == why


def test_a_halt_that_does_not_end_is_told_of(house: House, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sim.fake.REST_S", 100.0)
    house.stop_at(DriveTo)
    assert house.run().reason == "stopped by the person; I may not be at rest"


def test_a_robot_that_was_left_restless_is_halted_after_the_next_mission(house: House) -> None:
    house.stop_at(DriveTo)
    house.world.fault = lambda goal: "my brake slips" if isinstance(goal, Halt) else None
    house.run()
    house.world.fault, house.during = lambda goal: None, lambda goal: None
    house.goals.clear()
    house.run("Find a unicorn")
    assert house.goals == [Halt()]


def test_a_drive_that_was_given_up_is_followed_by_a_halt(house: House) -> None:
    house.world.fault = lambda goal: "the way is blocked" if isinstance(goal, DriveTo) else None
    assert house.run().status == MissionStatus.NOT_DONE
    assert house.goals[-1] == Halt()


# --- what raises elsewhere ---


def test_a_world_that_breaks_ends_the_mission_not_the_program(house: House) -> None:
    def fault(goal: Goal) -> str | None:
        return broken() if isinstance(goal, DriveTo) else None

    house.world.fault = fault
    assert house.run().reason == "internal error: ConnectionError: driver gone"
    assert house.goals[-1] == Halt()
    assert Broke("internal error: ConnectionError: driver gone") in house.events()


def test_time_that_does_not_pass_any_more_is_borne(
    house: House, monkeypatch: pytest.MonkeyPatch
) -> None:
    def stuck(deadline: float | None) -> None:
        if house.goals:
            raise RuntimeError("no time")
        wait(deadline)

    wait = house.session.parts.clock.wait
    monkeypatch.setattr(house.session.parts.clock, "wait", stuck)
    assert house.run().reason == "internal error: RuntimeError: no time; I may not be at rest"


def test_what_a_behaviour_did_before_it_raised_counts_for_nothing(
    house: House, monkeypatch: pytest.MonkeyPatch
) -> None:
    def halfway(self: SeeTarget, result: object) -> Any:
        self.situation.dialogue.inquiries = 17
        self.situation.search.looks.reached("the moon")
        raise ValueError("oops")

    monkeypatch.setattr(SeeTarget, "ended", halfway)
    outcome = house.session.run("Take a power_drill")
    monkeypatch.undo()
    assert outcome.reason == "internal error: ValueError: oops"
    assert outcome.inquiries == 0
    assert outcome.visited == ("shelf_lobby",)
    assert house.session.folder
    assert replay(house.session.folder).parting is None


def test_a_question_that_was_put_before_the_tree_broke_is_withdrawn(
    house: House, monkeypatch: pytest.MonkeyPatch
) -> None:
    withdrawn: list[int] = []
    monkeypatch.setattr(house.session.parts.user, "cancel", withdrawn.append)
    monkeypatch.setattr("trees.person.AskWhere.update", broken)
    house.session.run("Take an apple")
    assert len(withdrawn) == 1
    assert not house.inbox.awaits_anything


def test_a_second_signal_ends_it_at_once_with_the_robot_told_to_halt(house: House) -> None:
    def interrupt(goal: Goal) -> None:
        if isinstance(goal, DriveTo):
            raise KeyboardInterrupt

    house.during = interrupt
    with pytest.raises(KeyboardInterrupt):
        house.session.run("Take a power_drill")
    assert house.goals[-1] == Halt()
    assert not house.inbox.awaits_anything
    assert house.session.folder
    assert Run(house.session.folder).whole


class BrokenSink:
    """A log that is of no use."""

    write = flush = close = broken


def test_logs_that_break_cost_no_mission(tmp_path: Path) -> None:
    session = Session(
        Settings(**{**OKB, "runs": tmp_path}),  # type: ignore[arg-type]
        out=io.StringIO(),
        sinks=[BrokenSink()],
    )
    assert session.run("Take a power_drill").status == MissionStatus.DONE


def test_a_world_that_cannot_be_drawn_costs_no_mission(
    house: House, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(house.world, "describe", broken)
    assert house.run("Find a unicorn").status == MissionStatus.NOT_DONE


# --- all of it, at random ---

CALLS = ["robot.start", "robot.cancel", "robot.views", "eyes.see", "eyes.cancel", "user.ask"]
OWNERS: dict[str, Callable[[Session], Any]] = {
    "robot": lambda session: session.parts.robot,
    "eyes": lambda session: session.parts.perception,
    "user": lambda session: session.parts.user,
    "world": lambda session: session.world,
    "knowledge": lambda session: session.parts.knowledge,
}
CALLS += ["user.tell", "user.cancel", "world.advance", "world.describe", "knowledge.usual_places"]
WORDS = ["Bring an apple", "Take a power_drill", "Find the mug", "Bring the hammer", "Nonsense"]


@contextmanager
def mischief(house: House, plan: dict[int, str]) -> Iterator[None]:
    """At the calls with these numbers, raise or say stop."""
    count = 0

    def troubled(call: Callable[..., Any]) -> Callable[..., Any]:
        def instead(*arguments: Any, **named: Any) -> Any:
            nonlocal count
            count += 1
            match plan.get(count):
                case "raise":
                    broken()
                case "stop":
                    house.inbox.post(StopRequested(f"call {count}"))
                case "raise after":
                    call(*arguments, **named)
                    broken()
            return call(*arguments, **named)

        return instead

    with pytest.MonkeyPatch.context() as patch:
        for path in CALLS:
            part, name = path.split(".")
            owner = OWNERS[part](house.session)
            patch.setattr(owner, name, troubled(getattr(owner, name)))
        yield


@given(
    commands=st.lists(st.sampled_from(WORDS), min_size=1, max_size=3),
    plan=st.dictionaries(
        st.integers(1, 60), st.sampled_from(["raise", "raise after", "stop"]), max_size=12
    ),
)
@settings(max_examples=15)
def test_whatever_goes_wrong_there_is_an_outcome_and_it_replays(
    commands: list[str], plan: dict[int, str], tmp_path_factory: pytest.TempPathFactory
) -> None:
    house = House(tmp_path_factory.mktemp("runs"))
    with mischief(house, plan):
        for words in commands:
            outcome = house.run(words)
            assert outcome.reason
            believed, held = house.session._before.in_hand, house.world.held
            assert believed == held
    house.goals.clear()
    house.run("Find the mug")
    assert not house.world.busy
