"""A robot that cannot be reached any more ends the mission: that is said once, nothing is tried."""

from collections.abc import Callable
from contextlib import ExitStack
from dataclasses import replace
from pathlib import Path

import pytest
from patience import until
from served import served

from executive.app.parts import Parts
from executive.app.session import Session
from executive.config import load_settings
from executive.events import BodyTold, Inbox
from executive.interfaces.robot import Robot
from executive.replay import replay
from executive.ros.profile import profile_text
from executive.types.goals import DriveTo, Goal, LookAt, Pick
from executive.types.outcome import MissionStatus
from executive.types.results import Failed
from executive.user import Nobody
from logs.questions.why import why
from logs.recording.reader import Run

GONE = Failed("there is no link to the robot", unreachable=True)


class Listener(Nobody):
    """Keeps what the robot says."""

    def __init__(self, inbox: Inbox) -> None:
        super().__init__(inbox)
        self.said: list[str] = []
        self.when_it_is_said: Callable[[str], object] = lambda text: None

    def tell(self, text: str) -> None:
        self.said.append(text)
        self.when_it_is_said(text)


class CutOff:
    """A robot that is gone from a goal of this kind on."""

    def __init__(self, robot: Robot, inbox: Inbox, kind: type) -> None:
        self._robot, self._inbox, self._kind = robot, inbox, kind
        self.goals: list[Goal] = []
        self.cancel, self.views, self.seconds = robot.cancel, robot.views, robot.seconds

    @property
    def holding(self) -> bool | None:
        return self._robot.holding

    def start(self, goal: Goal) -> int:
        self.goals.append(goal)
        if not isinstance(goal, self._kind):
            return self._robot.start(goal)
        request = self._inbox.open(real=True)
        self._inbox.end(request, GONE)
        return request


def profile_that_waits(seconds: float, folder: Path) -> str:
    """Where the served robot's profile is, with so long to wait for a link that is lost."""
    text, _ = profile_text("served_instant")
    file = folder / "waits.toml"
    file.write_text(f"link_wait_s = {seconds}\n{text.decode()}")
    return str(file)


@pytest.mark.parametrize("kind", [DriveTo, LookAt, Pick])
@pytest.mark.parametrize("words", ["Bring a mug and find an apple", "Bring all fruit"])
def test_nothing_is_tried_without_a_robot(tmp_path: Path, words: str, kind: type) -> None:
    inbox = Inbox()
    listener, robots = Listener(inbox), []

    def change(parts: Parts) -> Parts:
        robots.append(CutOff(parts.robot, inbox, kind))
        return replace(parts, robot=robots[0])

    settings = load_settings(world="fake", llm="none", runs=tmp_path)
    with Session(settings, inbox=inbox, user=listener, change=change) as session:
        outcome = session.run(words)
        assert session.folder
    assert outcome.status == MissionStatus.NOT_DONE
    assert outcome.reason == "there is no link to the robot"
    assert listener.said[-1] == "Sorry: there is no link to the robot."
    assert [isinstance(goal, kind) for goal in robots[0].goals].count(True) == 1
    assert outcome.tasks
    assert all(task.status == MissionStatus.NOT_DONE for task in outcome.tasks)
    assert replay(session.folder, change=change).parting is None
    looks = [one.answer for one in why(Run(session.folder)) if one.question.startswith("look at")]
    assert "not seen there" not in looks


def test_the_next_mission_has_a_robot_that_came_back(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("executive.ros.actions.LINK_S", 0.1)
    inbox, profile = Inbox(), profile_that_waits(0.3, tmp_path)
    listener = Listener(inbox)
    with ExitStack() as gone, ExitStack() as anew:
        there = gone.enter_context(served(speed=1.0))
        url = there.server.address
        settings = load_settings(robot=url, profile=profile, llm="none", runs=tmp_path)
        with Session(settings, inbox=inbox, user=listener, recorded=False) as session:
            listener.when_it_is_said = lambda text: gone.close()
            outcome = session.run("Find a mug")
            assert outcome.reason.startswith("I waited 0.3 s, and there is no link to the robot")
            assert "I may not be at rest: I cannot be told to stop" in outcome.reason
            assert len([text for text in listener.said if "no link" in text]) == 1
            anew.enter_context(served(port=int(url.rpartition(":")[2])))
            until(lambda: session.run("Find a mug").status == MissionStatus.DONE, "a robot")


def test_that_the_link_is_lost_and_back_is_told_and_replays(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("executive.ros.actions.LINK_S", 0.1)
    inbox, profile = Inbox(), profile_that_waits(300, tmp_path)
    listener = Listener(inbox)
    with ExitStack() as gone, ExitStack() as anew:
        url = gone.enter_context(served(speed=1.0)).server.address
        port = int(url.rpartition(":")[2])

        def hear(text: str) -> None:
            if "lost the link" in text:
                anew.enter_context(served(port=port))
            gone.close()  # as soon as it has said where it looks

        listener.when_it_is_said = hear
        settings = load_settings(robot=url, profile=profile, llm="none", runs=tmp_path)
        with Session(settings, inbox=inbox, user=listener) as session:
            assert session.run("Find a mug").status == MissionStatus.DONE
            assert session.folder
    _, lost, back, *_ = listener.said
    assert lost == "I lost the link to my robot: I wait for it, 300 s at most."
    assert back == "There is a link to my robot again: I go on."
    assert replay(session.folder).parting is None
    assert [event for event in Run(session.folder).events() if isinstance(event.value, BodyTold)]
