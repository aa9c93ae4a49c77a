"""What pages are told of, they get: the pictures of the camera."""

import json
from dataclasses import replace

import cv2
import numpy as np
import pytest

from executive.events import Broke, Started, StopRequested
from executive.page.board import Board
from executive.page.sink import PageSink
from executive.records import EventTaken, Finished, Picture, Seen
from executive.testing.bench import run_mission
from executive.types.geometry import Pose
from executive.types.perception import Frame, Intrinsics
from logs.recorder import Stamp

NOW = Stamp(0.0, 0)
POSE = Pose((0.0, 0.0, 1.0), (0.0, 0.0, 0.0, 1.0))


def pictures(sink: PageSink, *numbers: int) -> None:
    """They are taken at once, so that pages are told of the first one only."""
    for number in numbers:
        color = np.full((8, 8, 3), number, np.uint8)
        depth = np.ones((8, 8), np.float32)
        frame = Frame(number, color, depth, Intrinsics(8, 8, 8.0, 8.0, 4.0, 4.0), POSE)
        sink.write(NOW, Picture(frame))


def told(board: Board) -> dict[str, object]:
    return next(json.loads(one.json) for one in board.since(0) if one.name == "camera")


def test_a_picture_that_is_shown_is_there_however_many_are_taken_after_it() -> None:
    sink = PageSink(board := Board())
    pictures(sink, 1, 2, 3, 4)
    assert told(board)["number"] == 1
    content = sink.picture(1)
    assert content is not None
    assert cv2.imdecode(np.frombuffer(content, np.uint8), cv2.IMREAD_COLOR).mean() == 1
    assert sink.picture(2) is None


def test_a_picture_is_shown_with_what_is_recognised_in_it_a_moment_later() -> None:
    sink = PageSink(board := Board())
    pictures(sink, 1, 2, 3)
    assert told(board)["seen"] is None
    sink.write(NOW, Seen(2, ()))
    assert told(board) == {"number": 2, "width": 8, "height": 8, "seen": []}
    assert sink.picture(2) is not None


@pytest.mark.parametrize(
    ("cut", "told"),
    [(None, ""), (StopRequested("the person"), "I hold it"), (Broke(""), "I hold it")],
)
def test_how_a_mission_ended_is_told_where_the_robot_could_not(
    cut: StopRequested | Broke | None, told: str
) -> None:
    outcome = replace(run_mission("Find the moon", llm=False).outcome, reason="I hold it.")
    sink = PageSink(board := Board())
    sink.write(NOW, EventTaken(Started("Find the moon")))
    if cut:
        sink.write(NOW, EventTaken(cut))
    sink.write(NOW, Finished(outcome))
    last = next(json.loads(one.json) for one in board.since(0) if one.name == "outcome")
    assert last["untold"] == told


def test_for_two_pages_a_picture_is_made_once() -> None:
    sink = PageSink(Board())
    pictures(sink, 1)
    assert sink.picture(1) is sink.picture(1)
    pictures(sink, 2)
    sink.write(NOW, Seen(2, ()))
    assert (first := sink.picture(1)) is not None
    sink.picture(2)
    assert sink.picture(1) is first
