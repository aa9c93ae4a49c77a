"""Recordings from before behaviours declared what they mean are understood as they were then."""

from pathlib import Path

from executive.records import Activity
from logs.questions.decision import why_text
from logs.questions.why import why
from logs.recording.reader import Run

FROM_BEFORE = Path(__file__).parent / "from_before"


def test_who_said_what_and_where_the_robot_looked_is_told_as_it_was_then() -> None:
    assert why_text(why(Run(FROM_BEFORE))) + "\n" == (FROM_BEFORE / "why.txt").read_text()


def test_what_the_robot_did_and_the_parts_of_the_mission_are_known() -> None:
    nodes = Run(FROM_BEFORE).tree().nodes
    assert {node.activity for node in nodes} == {*Activity, ""}
    stages = [node.name for node in nodes if node.stage]
    assert stages[:2] == ["understand", "about a thing to look for"]
    assert stages[-2:] == ["if away", "apologise"]
