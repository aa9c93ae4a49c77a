"""What a robot says of itself is believed only if it has the form that it should have."""

from typing import Any

import pytest
from second_robot import SecondRobot

from executive.ros import peer, reasons
from executive.ros.__main__ import main

TOPICS = ["/tf"]


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
        ("/rosapi/action_servers", {"action_servers": "/go"}, "tells /go as action_servers"),
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


def test_look_says_that_a_message_is_too_large(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    for module in (peer, reasons):
        monkeypatch.setattr(module, "MOST_BYTES", 100)
    with SecondRobot() as robot:
        assert main(["look", robot.url]) == 2
    assert "was lost: it sent a message of more than 100 bytes" in capsys.readouterr().err
