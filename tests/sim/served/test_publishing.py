"""Pictures that another process draws: nobody waits for them, and each tells when it was taken."""

import queue
from collections.abc import Callable
from concurrent.futures import Future
from typing import Any

import numpy as np
import pytest
from served import Raw, place_goal, served

from executive.types.geometry import Pose
from executive.types.perception import Frame, Intrinsics
from sim.pictures.coming import ComingFrame, NotDrawnError
from sim.served.offered import COLOR, DEPTH, DRIVE
from sim.served.publishing import Publisher

LENS = Intrinsics(4, 3, 5.0, 5.0, 1.5, 1.0)
PIXELS = (np.zeros((3, 4, 3), np.uint8), np.ones((3, 4), np.float32))


class Scene:
    """A robot with a camera whose pictures are drawn when the test says so."""

    draws_beside = True

    def __init__(self) -> None:
        self.camera = self
        self.coming: list[Future[Any]] = []
        self.works = True
        self.time_ns = 0
        self.orders: queue.SimpleQueue[Callable[[], None]] = queue.SimpleQueue()
        self.told: list[tuple[str, int]] = []
        self.publisher = Publisher(self, self._hear, lambda: self.time_ns, self.orders.put)

    def capture(self) -> Frame:
        if not self.works:
            return Frame(0, *PIXELS, LENS, Pose())
        self.coming.append(Future())
        return ComingFrame(0, LENS, Pose(), self.coming[-1])

    def obey(self) -> None:
        while not self.orders.empty():
            self.orders.get()()

    def _hear(self, topic: str, message: dict[str, Any]) -> None:
        self.told.append((topic, message["header"]["stamp"]["nanosec"]))


@pytest.fixture
def scene() -> Scene:
    return Scene()


def test_a_picture_is_told_when_it_is_drawn_with_the_time_when_it_was_taken(scene: Scene) -> None:
    scene.publisher.want(COLOR)
    scene.publisher.want(DEPTH)
    assert not scene.told
    scene.time_ns = 7
    scene.publisher.forget_picture()
    scene.coming[0].set_result(PIXELS)
    scene.obey()
    assert scene.told == [(COLOR, 0), (DEPTH, 0)]
    assert len(scene.coming) == 1


def test_what_nobody_wants_any_more_is_not_told(scene: Scene) -> None:
    scene.publisher.want(COLOR)
    scene.publisher.leave_out(COLOR)
    scene.coming[0].set_result(PIXELS)
    scene.obey()
    assert not scene.told


def test_for_a_picture_that_will_never_be_there_another_one_is_taken(scene: Scene) -> None:
    scene.publisher.want(COLOR)
    scene.works, scene.time_ns = False, 7
    scene.coming[0].set_exception(NotDrawnError())
    scene.obey()
    assert scene.told == [(COLOR, 7)]


def test_who_takes_pictures_has_the_next_drawn_before_it_is_wanted(scene: Scene) -> None:
    scene.publisher.expect_picture()
    assert not scene.coming
    scene.publisher.want(COLOR)
    scene.coming[0].set_result(PIXELS)
    scene.publisher.forget_picture()
    scene.publisher.expect_picture()
    scene.publisher.want(COLOR)
    assert len(scene.coming) == 2


def test_no_picture_is_drawn_in_advance_while_another_one_is_drawn(scene: Scene) -> None:
    scene.publisher.want(COLOR)
    scene.publisher.forget_picture()
    scene.publisher.expect_picture()
    assert len(scene.coming) == 1


def test_the_robot_goes_on_while_a_picture_of_it_is_drawn(scene: Scene) -> None:
    with served() as robot, Raw(robot) as client:
        robot.body.camera = scene
        client.say("subscribe", topic=COLOR)
        assert client.do(DRIVE, place_goal("desk"))["status"] == 4
        assert scene.coming
        assert not any(said["op"] == "publish" for said in client.heard)
        scene.coming[-1].set_result(PIXELS)
        assert client.hear_of("publish", topic=COLOR)
