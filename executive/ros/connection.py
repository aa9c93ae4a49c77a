"""All that a robot over the wire consists of, put together and let go of again."""

from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass

from executive.clock import RealClock
from executive.errors import InputError
from executive.events import BodyTold, Inbox
from executive.guards import in_words
from executive.heap import keep_what_is_freed
from executive.interfaces.runtime import Clock
from executive.ros.address import ROS2, Address
from executive.ros.arm import Hands, NoHands
from executive.ros.camera import LateError, Shutter, WireCamera
from executive.ros.checking import faults
from executive.ros.clock import GoalClock, RobotClock
from executive.ros.deeds import Deeds, Places, Remote
from executive.ros.link import Link, LinkError
from executive.ros.losses import Losses
from executive.ros.profile import Profile
from executive.ros.rclpy_link import RclpyLink
from executive.ros.robot import WireRobot
from executive.ros.rosbridge import RosbridgeLink
from executive.ros.senses import Senses
from executive.ros.stopping import Brake
from executive.ros.thread import WireThread
from executive.types.geometry import Pose

CONNECTING_S = 6.0
CLOSING_S = 1.5
MORE_TIME = "see that it is published there; over a slow link, give camera.late_s more"
RIGHT = "see docs/own-robot.md, or take our robot: python -m sim serve"


@dataclass(frozen=True)
class Line:
    """An open link, on a thread of its own."""

    wire: WireThread
    link: Link

    def close(self) -> None:
        """Let go of it."""
        with suppress(Exception):  # what cannot be closed in order is closed nevertheless
            self.wire.start(self.link.close()).result(CLOSING_S)
        self.wire.close()


@dataclass(frozen=True)
class Connection:
    """A robot over the wire."""

    line: Line
    robot: WireRobot
    camera: WireCamera
    clock: Clock
    tell: Callable[[], None]
    """Tells where the base is, if that is known."""

    def close(self) -> None:
        """Let go of it."""
        self.line.close()


def dial(address: Address, within_s: float = CONNECTING_S) -> Line:
    """Open a link.

    Raises:
        InputError: if nobody answers there.
    """
    wire = WireThread()

    async def link() -> Link:
        made = RclpyLink() if address.url == ROS2 else RosbridgeLink(address)
        await made.ready(within_s)
        return made

    try:
        return Line(wire, wire.run(link()))
    except LinkError as error:
        wire.close()
        raise InputError(f"--robot {address}".rstrip(":"), in_words(error), RIGHT) from None


def connect(
    address: Address,
    profile: Profile,
    places: Places,
    inbox: Inbox,
    where: str,
    ways: Callable[[str, str], float],
    told: Callable[[Pose], None] = lambda pose: None,
    hands: Hands | None = None,
) -> Connection:
    """Open a link to a robot and hold the profile against it; nothing moves.

    Args:
        address: where the robot is.
        profile: what it has.
        places: the home.
        inbox: where the ends of its goals go, and what it has to tell.
        where: what the profile is called in messages.
        ways: how long it takes from one place to another one (s).
        told: is given where the base is in the map, now and then, on the thread that ticks.
        hands: how things are held, for a robot that has motions but no skills; None: not known.

    Raises:
        InputError: if nobody answers there, or the profile does not fit the robot.
    """
    keep_what_is_freed()
    line = dial(address)

    async def sense() -> tuple[Senses, Brake, list[InputError]]:
        senses = Senses(line.link, profile)
        brake = Brake(line.link, profile, senses)
        return senses, brake, await faults(line.link, profile, senses, where)

    try:
        senses, brake, found = line.wire.run(sense())
        if found:
            raise found[0]
    except BaseException:
        line.close()
        raise

    def tell() -> None:
        if (pose := senses.base) is not None:
            told(pose)

    def tell_the_person(words: str) -> None:
        inbox.post(BodyTold(words))

    losses = Losses(line.link, profile.link_wait_s, brake.settled, tell_the_person)
    camera = WireCamera(line.wire, Shutter(line.link, profile, senses), losses)
    remote = Remote(line.link, profile, senses, brake, losses)
    deeds = Deeds(remote, places, hands or NoHands(), camera.points)
    robot = WireRobot(line.wire, remote, deeds, inbox, ways, tell)
    return Connection(line, robot, camera, _clock(profile, inbox, robot, senses), tell)


def check(address: Address, profile: Profile, where: str) -> list[InputError]:
    """All that is wrong with a profile for the robot at an address; a picture is taken, too.

    Raises:
        InputError: if nobody answers there.
    """
    line = dial(address)

    async def hold() -> list[InputError]:
        senses = Senses(line.link, profile)
        if found := await faults(line.link, profile, senses, where):
            return found
        try:
            await Shutter(line.link, profile, senses).take()
        except LinkError as error:
            right = MORE_TIME if isinstance(error, LateError) else ""
            return [InputError(where, f"camera: {in_words(error)}", right)]
        return []

    try:
        return line.wire.run(hold())
    finally:
        line.close()


def _clock(profile: Profile, inbox: Inbox, robot: WireRobot, senses: Senses) -> Clock:
    if profile.clock is None:
        return RealClock(inbox)
    if profile.clock.counts_while_idle:
        return RobotClock(inbox, senses)
    return GoalClock(inbox, robot)
