"""What a robot says of itself is believed only if it has the form that it should have."""

from typing import Any

import pytest
from second_robot import SecondRobot

from executive.ros import peer, reasons
from executive.ros.__main__ import main

TOPICS = ["/tf"]
SERVERS = "/rosapi/action_servers"


class Babbler(SecondRobot):
    """Its rosapi answers something else."""

    def __init__(self, service: str, values: dict[str, Any]) -> None:
        super().__init__()
        self._wrong = service, values

    def _answer(self, service: str, args: dict[str, Any]) -> dict[str, Any]:
        wrong, values = self._wrong
        return values if service == wrong else super()._answer(service, args)


@pytest.mark.parametrize(
    ("service", "values", "why"),
    [
        ("/rosapi/topics", {"topics": 5, "types": []}, "/rosapi/topics tells 5 as topics"),
        ("/rosapi/topics", {"topics": TOPICS, "types": [7]}, "/rosapi/topics tells 7 as types"),
        ("/rosapi/topics", {"topics": TOPICS, "types": []}, "tells 1 topics, but 0 types"),
        ("/rosapi/topics", {"topics": TOPICS}, "/rosapi/topics tells None as types"),
        ("/rosapi/services", {"services": {"a": 1}}, "as services"),
        (SERVERS, {"action_servers": "/go"}, "tells /go as action_servers"),
    ],
)
def test_look_says_what_is_wrong_with_what_it_was_told(
    service: str, values: dict[str, Any], why: str, capsys: pytest.CaptureFixture[str]
) -> None:
    with Babbler(service, values) as robot:
        assert main(["look", robot.url]) == 2
    said = capsys.readouterr()
    assert why in said.err
    assert not said.out


def test_actions_that_rosapi_cannot_list_are_known_by_their_topics(
    capsys: pytest.CaptureFixture[str],
) -> None:
    with Babbler(SERVERS, {}) as robot:
        assert main(["look", robot.url]) == 0
    assert "#   /acme/way  nav2_msgs/action/ComputePathToPose\n" in capsys.readouterr().out


def test_a_robot_that_tells_of_no_actions_says_so(capsys: pytest.CaptureFixture[str]) -> None:
    robot = Babbler(SERVERS, {})
    robot.actions = {}
    with robot:
        assert main(["look", robot.url]) == 2
    said = capsys.readouterr().err
    assert (
        "the robot does not tell which action servers it has: /rosapi/action_servers failed" in said
    )
    assert "rosapi runs there, of rosbridge 2.0 or later" in said


def test_look_says_that_a_message_is_too_large(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    for module in (peer, reasons):
        monkeypatch.setattr(module, "MOST_BYTES", 100)
    with SecondRobot() as robot:
        assert main(["look", robot.url]) == 2
    assert "was lost: it sent a message of more than 100 bytes" in capsys.readouterr().err
