"""What a nasty tester did to stops, hands and the ends of missions."""

import json
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any, ClassVar

import pytest
from houses import House

from executive.__main__ import converse
from executive.events import THE_PERSON, StopRequested
from executive.language.control import Control, control
from executive.types.goals import DriveTo, Goal, Halt, Pick, PutDown
from executive.types.outcome import MissionStatus, Outcome
from executive.types.results import Failed, Succeeded


@pytest.fixture
def house(tmp_path: Path) -> Iterator[House]:
    house = House(tmp_path)
    yield house
    house.session.close()


def written(house: House) -> dict[str, Any]:
    assert house.session.folder
    return dict(json.loads((house.session.folder / "outcome.json").read_text()))


# --- words ---


@pytest.mark.parametrize(
    "words",
    [
        *("\U0001f6d1", "\u270b", "\u23f9\ufe0f", "the cat \U0001f6d1", "dont move", "DONT!"),
        *("thats enough", "Stahp!", "be careful", "woah", "do not continue", "don't proceed"),
        *("Why don't you stop?!", "why won't you stop", "would you mind stopping", "cancelled"),
    ],
)
def test_a_stop_is_heard_in_signs_slang_and_without_apostrophes(words: str) -> None:
    assert control(words) is Control.STOP


@pytest.mark.parametrize("words", ["dont stop", "I dont know", "Why did you stop?", "thats it"])
def test_without_an_apostrophe_a_denial_is_one_nevertheless(words: str) -> None:
    assert control(words) is None


# --- who stops, and when ---


class _Typing:
    """A session in which two commands are typed, and the first is done as a signal comes."""

    commands: ClassVar = ["Find the mug", "Find the apple"]

    def __init__(self, house: House) -> None:
        self.house = house
        self.left = list(self.commands)
        self.is_recorded = house.session.is_recorded

    @property
    def stopped_by(self) -> str:
        return self.house.session.stopped_by

    def next_command(self, console: None, prompt: str) -> str | None:
        return self.left.pop(0) if self.left else None

    def talk(self, words: str) -> str:
        return ""

    def run(self, words: str) -> Outcome:
        return self.house.run(words)


@pytest.mark.parametrize(("by", "left"), [("SIGTERM", ["Find the apple"]), (THE_PERSON, [])])
def test_a_signal_that_comes_as_all_is_done_ends_the_conversation(
    by: str, left: list[str], house: House
) -> None:
    def tell(text: str) -> None:
        if text.startswith("The mug is on"):
            house.inbox.post(StopRequested(by))

    house.session.parts.user.tell = tell  # type: ignore[method-assign]
    typing = _Typing(house)
    code = converse(typing, None, as_json=False)  # type: ignore[arg-type]
    assert (code, typing.left) == (130 if left else 0, left)


def test_a_signal_after_the_persons_stop_ends_the_session_too(house: House) -> None:
    def stop(goal: Goal) -> None:
        house.inbox.post(StopRequested("SIGTERM" if isinstance(goal, Halt) else THE_PERSON))

    house.during = stop
    assert house.run().reason == f"stopped by {THE_PERSON}"
    assert house.session.stopped_by == "SIGTERM"


@pytest.mark.parametrize("kind", [DriveTo, Halt])
def test_what_a_second_interrupt_ends_has_an_outcome_and_replays(
    kind: type[Goal], house: House, monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupt(goal: Goal) -> None:
        if kind is Halt:
            house.inbox.post(StopRequested("Ctrl-C"))
        if isinstance(goal, kind):
            house.during = lambda goal: None
            raise KeyboardInterrupt

    house.during = interrupt
    with pytest.raises(KeyboardInterrupt):
        house.session.run("Find the mug")
    assert isinstance(house.goals[-1], Halt)
    assert written(house)["reason"] == "stopped by Ctrl-C; I may not be at rest"
    monkeypatch.setattr(house.session, "run", lambda words: Outcome(**written(house)))
    house.run()  # nothing but the checks
    assert house.session._before.restless


def test_an_interrupt_while_the_logs_are_closed_leaves_them_whole(
    house: House, monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupted() -> None:
        monkeypatch.undo()
        raise KeyboardInterrupt

    opened = house.session.recorder.open

    def open_and_wait(*arguments: Any) -> None:
        opened(*arguments)
        monkeypatch.setattr(house.session.recorder, "close", interrupted)

    house.session.recorder.open = open_and_wait  # type: ignore[method-assign]
    with pytest.raises(KeyboardInterrupt):
        house.session.run("Find the mug")
    assert written(house)["status"] == "done"
    monkeypatch.setattr(house.session, "run", lambda words: Outcome(**written(house)))
    house.run()  # nothing but the checks


@pytest.mark.parametrize("error", [RuntimeError("no world"), KeyboardInterrupt()])
def test_what_fails_before_anything_began_has_an_outcome_too(
    error: BaseException, house: House, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fail(**parts: object) -> None:
        raise error

    monkeypatch.setattr("executive.app.session.build_mission", lambda *a, **k: fail())
    if isinstance(error, Exception):
        assert house.session.run("Find the mug").status == MissionStatus.NOT_DONE
    else:
        with pytest.raises(KeyboardInterrupt):
            house.session.run("Find the mug")
    assert isinstance(house.goals[-1], Halt)
    assert written(house)["reason"].endswith("; I may not be at rest")
    monkeypatch.undo()
    assert house.run("Find the mug").status == MissionStatus.DONE


# --- the hand ---


def stands_in(house: House, kind: type[Goal], *, grips: bool = False, ends: Any = None) -> None:
    """For goals of this kind: they may grip the thing, and end so, or never."""
    start = house.session.parts.robot.start

    def other(goal: Goal) -> int:
        if not isinstance(goal, kind):
            return start(goal)
        if grips and isinstance(goal, Pick):
            house.world.things.pop(goal.detection.label, None)
            house.world.held = goal.detection.label
        request = house.inbox.open()
        if ends:
            house.inbox.end(request, ends)
        return request

    house.session.parts.robot.start = other  # type: ignore[method-assign]


def hand_is_known(house: House) -> bool:
    return house.session._before.in_hand == house.world.held


def test_a_pick_that_takes_too_long_with_the_thing_in_the_hand_got_hold_of_it(
    house: House,
) -> None:
    stands_in(house, Pick, grips=True)
    assert house.run("Take the mug").reason == "I took the mug from the coffee table and hold it."
    assert hand_is_known(house)
    assert isinstance(house.goals[-1], Halt)


def test_a_pick_that_takes_too_long_with_nothing_in_the_hand_failed(house: House) -> None:
    stands_in(house, Pick)
    reason = house.run("Take the mug").reason
    assert reason == "I could not pick up the mug: it took longer than 120 s"
    assert hand_is_known(house)


def test_what_the_fingers_do_not_let_go_of_was_not_brought(house: House) -> None:
    stands_in(house, PutDown, ends=Succeeded())
    outcome = house.run("Bring the mug")
    assert outcome.status == MissionStatus.NOT_DONE
    assert "my fingers do not let go of it" in outcome.reason
    assert "I still hold the mug" in outcome.reason
    assert hand_is_known(house)


@pytest.mark.parametrize("number", range(1, 7))
def test_fingers_that_cannot_tell_any_more_are_not_asked_what_they_felt(
    number: int, tmp_path: Path
) -> None:
    asked = 0

    class Numb:
        def __init__(self, robot: Any) -> None:
            self.start, self.cancel, self.views = robot.start, robot.cancel, robot.views

        @property
        def holding(self) -> bool:
            nonlocal asked
            asked += 1
            if asked >= number:
                raise ConnectionError("no touch")
            return house.world.held is not None

    house = House(tmp_path, lambda parts: replace(parts, robot=Numb(parts.robot)))
    assert house.run("Bring the mug").status == MissionStatus.DONE
    assert hand_is_known(house)


def test_with_no_room_anywhere_it_says_what_it_still_holds(house: House) -> None:
    stands_in(house, PutDown, ends=Failed("there is no free spot"))
    house.run("Bring the mug")
    assert house.run("Take the hammer").reason.endswith("; I still hold the mug")


@pytest.mark.parametrize("views", [0, -1, None, "many"])
def test_a_place_has_at_least_one_view(views: Any, tmp_path: Path) -> None:
    class Odd:
        def __init__(self, robot: Any) -> None:
            self.start, self.cancel, self.holding = robot.start, robot.cancel, None

        def views(self, place: str) -> Any:
            return views

    house = House(tmp_path, lambda parts: replace(parts, robot=Odd(parts.robot)))
    assert house.run("Find the mug").status == MissionStatus.DONE


def test_what_was_let_go_of_too_late_is_said_to_be_out_of_the_hand(house: House) -> None:
    house.run("Take the mug")
    start = house.session.parts.robot.start

    def lets_go_and_hangs(goal: Goal) -> int:
        if not isinstance(goal, PutDown):
            return start(goal)
        house.world.things["mug"], house.world.held = goal.place, None
        return house.inbox.open()

    house.session.parts.robot.start = lets_go_and_hangs  # type: ignore[method-assign]
    assert house.run("Put it down").reason == (
        "I could not put it down on the delivery table: it took longer than 120 s; "
        "the mug is not in my hand any more"
    )
    assert hand_is_known(house)


def test_a_stop_before_words_that_are_too_long_does_not_stop_the_next_mission(house: House) -> None:
    house.inbox.post(StopRequested("SIGTERM"))
    assert house.session.run("x" * 3000).status == MissionStatus.NOT_UNDERSTOOD
    assert house.session.stopped_by == "SIGTERM"
    assert house.session.run("Find the mug").status == MissionStatus.DONE
