"""Publishes the robot's state and pictures on the topics that have subscribers."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import partial

from executive.ros import moveit
from executive.ros.protocol import Message
from executive.types.perception import Frame
from sim.pictures.coming import ComingFrame, NotDrawnError
from sim.served import messages, offered
from sim.served.bodies import Body
from sim.served.offered import CLOCK, PICTURES, STATE

Publish = Callable[[str, Message], None]
Order = Callable[[], None]


@dataclass(frozen=True, slots=True, eq=False)
class _Shot:
    """A frame, and the time when it was taken (ns)."""

    frame: Frame
    time_ns: int

    @property
    def is_drawn(self) -> bool:
        return not isinstance(self.frame, ComingFrame) or self.frame.is_drawn


class Publisher:
    """Publishes topics with subscribers. Use it only on the simulation's thread.

    It does not wait for a picture that another process draws: a callback publishes it when it is
    drawn.
    """

    def __init__(
        self,
        body: Body,
        publish: Publish,
        now_ns: Callable[[], int],
        later: Callable[[Order], None],
    ) -> None:
        """Begin without subscribers.

        Args:
            body: the robot.
            publish: sends a message on a topic.
            now_ns: returns the simulated time (ns).
            later: queues an order for the simulation's thread; callable from any thread.
        """
        self._body = body
        self._publish = publish
        self._now_ns = now_ns
        self._later = later
        self._wanted: set[str] = set()
        self._takes_pictures = False
        self._newest: _Shot | None = None
        self._drawing: list[_Shot] = []

    def want(self, topic: str) -> None:
        """Publish a topic once now and from now on; a picture's topic with the state before it."""
        self._wanted.add(topic)
        if topic in PICTURES:
            self._takes_pictures = True
            self.tell_state()
        self._tell((topic,))

    def leave_out(self, topic: str) -> None:
        """Stop publishing a topic."""
        self._wanted.discard(topic)

    def forget_picture(self) -> None:
        """The scene may have changed: take a new picture next time."""
        self._newest = None

    def expect_picture(self) -> None:
        """Start a picture of now, which will be wanted soon if pictures ever were.

        Only if another process draws it, and has no other picture to draw.
        """
        if self._takes_pictures and self._body.draws_beside and not self.is_drawing:
            self._picture()

    def tell_time(self) -> None:
        """Publish the clock."""
        self._tell((CLOCK,))

    def tell_state(self) -> None:
        """Publish the state, without pictures."""
        self._tell(STATE)

    def tell_pictures(self) -> None:
        """Publish what the camera sees now."""
        self._tell(PICTURES)

    @property
    def shows_pictures(self) -> bool:
        """Whether a picture topic has subscribers."""
        return not self._wanted.isdisjoint(PICTURES)

    @property
    def is_drawing(self) -> bool:
        """Whether a picture is still being drawn."""
        self._drawing = [shot for shot in self._drawing if not shot.is_drawn]
        return bool(self._drawing)

    def _tell(self, topics: Iterable[str]) -> None:
        for topic in topics:
            if topic not in self._wanted:
                continue
            if topic in PICTURES:
                self._show(topic, self._picture())
            else:
                self._publish(topic, self._message(topic))

    def _message(self, topic: str) -> Message:
        body, time_ns = self._body, self._now_ns()
        match topic:
            case offered.CLOCK:
                return messages.clock(time_ns)
            case offered.TF:
                return messages.transforms(time_ns, body.frames())
            case offered.TF_STATIC:
                return messages.fixed_transforms()
            case offered.ODOMETRY:
                return messages.odometry(time_ns, body.pose, body.velocity)
            case moveit.SEMANTICS:
                return messages.text(offered.SRDF)
            case offered.JOINTS:
                return messages.joint_states(time_ns, body.joints())
            case _:
                return messages.touch(body.holding)

    # --- pictures ---

    def _picture(self) -> _Shot:
        """The newest picture; all topics share it until `forget_picture`."""
        if self._newest is None:
            self._newest = _Shot(self._body.camera.capture(), self._now_ns())
            self._drawing.append(self._newest)
        return self._newest

    def _show(self, topic: str, shot: _Shot) -> None:
        """Publish a picture, when it is drawn."""
        frame = shot.frame
        if isinstance(frame, ComingFrame) and not frame.is_drawn:
            frame.when_drawn(partial(self._later, partial(self._show_drawn, topic, shot)))
        else:
            self._show_drawn(topic, shot)

    def _show_drawn(self, topic: str, shot: _Shot) -> None:
        if topic not in self._wanted:
            return
        try:
            message = _message_of(topic, shot)
        except NotDrawnError:
            self._take_another(topic, shot)
        else:
            self._publish(topic, message)

    def _take_another(self, topic: str, shot: _Shot) -> None:
        """The drawing process has failed: draw a new picture in this process."""
        if self._newest is shot:
            self._newest = None
        self.tell_state()
        self._tell((topic,))


def _message_of(topic: str, shot: _Shot) -> Message:
    match topic:
        case offered.COLOR:
            return messages.color_image(shot.time_ns, shot.frame)
        case offered.DEPTH:
            return messages.depth_image(shot.time_ns, shot.frame)
        case _:
            return messages.camera_info(shot.time_ns, shot.frame.intrinsics)
