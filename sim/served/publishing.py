"""Tells what the robot knows of itself and sees, to whoever wants it."""

from collections.abc import Callable, Iterable

from executive.ros.protocol import Message
from executive.types import Frame
from sim.served import messages, offered
from sim.served.bodies import Body
from sim.served.offered import CLOCK, PICTURES, STATE

Publish = Callable[[str, Message], None]


class Publisher:
    """Publishes what is wanted. Belongs to the thread of the simulation."""

    def __init__(self, body: Body, publish: Publish) -> None:
        """Nobody wants anything yet."""
        self._body = body
        self._publish = publish
        self._wanted: set[str] = set()
        self._frame: Frame | None = None

    def want(self, topic: str, time_ns: int) -> None:
        """Publish this topic from now on, and once now; a picture with what belongs to it."""
        self._wanted.add(topic)
        if topic in PICTURES:
            self.tell_state(time_ns)
        self._tell((topic,), time_ns)

    def leave_out(self, topic: str) -> None:
        """Nobody wants it any more."""
        self._wanted.discard(topic)

    def forget_picture(self) -> None:
        """Something may have changed: what is seen next is a new picture."""
        self._frame = None

    def tell_time(self, time_ns: int) -> None:
        """Only the clock."""
        self._tell((CLOCK,), time_ns)

    def tell_state(self, time_ns: int) -> None:
        """All but the pictures."""
        self._tell(STATE, time_ns)

    def tell_pictures(self, time_ns: int) -> None:
        """What the camera sees now."""
        self._tell(PICTURES, time_ns)

    @property
    def shows_pictures(self) -> bool:
        """Whether anybody wants them."""
        return not self._wanted.isdisjoint(PICTURES)

    def _tell(self, topics: Iterable[str], time_ns: int) -> None:
        for topic in topics:
            if topic in self._wanted:
                self._publish(topic, self._message(topic, time_ns))

    def _message(self, topic: str, time_ns: int) -> Message:
        body = self._body
        match topic:
            case offered.CLOCK:
                return messages.clock(time_ns)
            case offered.TF:
                return messages.transforms(time_ns, body.frames())
            case offered.TF_STATIC:
                return messages.fixed_transforms()
            case offered.ODOMETRY:
                return messages.odometry(time_ns, body.pose, body.velocity)
            case offered.JOINTS:
                return messages.joint_states(time_ns, body.joints())
            case offered.TOUCH:
                return messages.touch(body.holding)
            case offered.COLOR:
                return messages.color_image(time_ns, self._picture())
            case offered.DEPTH:
                return messages.depth_image(time_ns, self._picture())
            case _:
                return messages.camera_info(time_ns, self._picture().intrinsics)

    def _picture(self) -> Frame:
        """One for all topics, as long as nothing changes."""
        if self._frame is None:
            self._frame = self._body.camera.capture()
        return self._frame
