"""What the robot says about itself all the time: frames, motion, hand and clock."""

import asyncio
import logging
import math
import time
from collections.abc import Callable
from contextlib import suppress

from executive.ros.frames import BACK_S, FrameTree
from executive.ros.link import Link
from executive.ros.messages import FRAMES_TYPE, seconds, stamp_of, vector
from executive.ros.packets import PacketError, numbers
from executive.ros.profile import Profile
from executive.ros.protocol import Message
from executive.types.geometry import Pose

RESTING_M_S, RESTING_RAD_S = 0.01, 0.02
"""What is slower is at rest."""

MOST_JOINTS = 2000
"""So many names are remembered."""
LEAP_S = 60.0
"""A clock that goes further at once was set: that time has not passed."""
FEELING_S = 0.3
"""So long it may take until the hand is told of again."""


log = logging.getLogger(__name__)


class Senses:
    """The newest of each; filled on the thread of the wire, read from any."""

    def __init__(self, link: Link, profile: Profile) -> None:
        """Listen."""
        self.frames = FrameTree()
        self.clock: float | None = None
        """The robot's own time (s); None before it was heard of, or if nobody says it."""
        self.elapsed = 0.0
        """How much of its own time has passed since it was first heard of (s)."""
        self._counted: float | None = None
        """Up to which time that is."""
        self.clock_went_on = 0.0
        """When it last told another time than before (real time, s)."""
        self.joints: frozenset[str] = frozenset()
        """The names of all that were told on the topic of the joints."""
        self._link = link
        self._profile = profile
        self._holding: bool | None = None
        self._base_moves: bool | None = None
        self._joints_move: bool | None = None
        self._newest = 0.0
        self._framed = 0
        """How often the link had been lost when frames were last told."""
        self._endings: list[Callable[[], None]] = []
        told = profile.frames
        link.subscribe(
            told.tf_static, FRAMES_TYPE, lambda message: self.frames.take(message, fixed=True)
        )
        link.subscribe(told.tf, FRAMES_TYPE, self._take_frames)
        if profile.clock is not None:
            link.subscribe(profile.clock.topic, "rosgraph_msgs/msg/Clock", self._take_clock)
        self._felt = asyncio.Event()
        self._hand: Callable[[], None] | None = None
        self._subscribe_hand()
        self.feel_motion_anew()

    # --- what is asked ---

    @property
    def holding(self) -> bool | None:
        """Whether something is in the hand; None if the robot cannot tell."""
        return self._holding

    @property
    def now(self) -> float:
        """The robot's time as far as it was heard of (s): pictures of later are newer."""
        return self._newest if self.clock is None else self.clock

    @property
    def base(self) -> Pose | None:
        """Where the base is in the map; None if nobody tells."""
        return self.frames.pose(self._profile.frames.base, self._profile.frames.map)

    async def base_anew(self, within_s: float) -> Pose | None:
        """Where the base is in the map, as told since the link was last lost; None if it is not."""
        latest = time.monotonic() + within_s
        while self._framed != self._link.losses:
            if time.monotonic() > latest:
                return None
            await asyncio.sleep(0.01)
        return self.base

    async def feel_hand_anew(self) -> None:
        """Hear again what is in the hand: what a goal has changed may be told after its end."""
        if self._profile.hand is None:
            return
        self._felt.clear()
        self._subscribe_hand()
        with suppress(TimeoutError):
            async with asyncio.timeout(FEELING_S):
                await self._felt.wait()

    def _subscribe_hand(self) -> None:
        before, hand = self._hand, self._profile.hand
        if hand is not None:
            self._hand = self._link.subscribe(hand.topic, hand.type, self._take_hand)
        if before is not None:
            before()

    def feel_motion_anew(self, *, urgent: bool = False) -> None:
        """Forget what was heard of motion, and ask for it anew; urgent: ahead of all pictures."""
        self._base_moves = self._joints_move = None
        topics = [(self._profile.odometry, "nav_msgs/msg/Odometry", self._take_odometry)]
        if self._profile.joints is not None:
            topics.append((self._profile.joints, "sensor_msgs/msg/JointState", self._take_joints))
        before = self._endings
        self._endings = [
            self._link.subscribe(topic.topic, kind, take, urgent=urgent)
            for topic, kind, take in topics
        ]
        for end in before:
            end()

    @property
    def unrest(self) -> str:
        """What moves, or is not known to rest, as a clause; empty if all is at rest."""
        if self._base_moves is None:
            return f"nobody tells on {self._profile.odometry.topic} whether my base moves"
        if self._profile.joints is not None and self._joints_move is None:
            return f"nobody tells on {self._profile.joints.topic} whether my joints move"
        moving = ["base"] * self._base_moves + ["joints"] * bool(self._joints_move)
        if not moving:
            return ""
        verb = "moves" if moving == ["base"] else "move"
        return f"my {' and my '.join(moving)} {verb}"

    # --- what comes ---

    def _take_frames(self, message: Message) -> None:
        self.frames.take(message)
        self._framed = self._link.losses

    def _take_clock(self, message: Message) -> None:
        before, self.clock = self.clock, seconds(message["clock"])
        if self.clock != before:
            self.clock_went_on = time.monotonic()
        passed = 0.0 if self._counted is None else self.clock - self._counted
        if -BACK_S <= passed < 0.0:
            return  # it came late, behind what was told after it
        self._counted = self.clock
        if 0.0 <= passed <= LEAP_S:
            self.elapsed += passed
        else:
            log.warning("the robot's clock was set by %+.0f s, which do not count", passed)

    def _take_odometry(self, message: Message) -> None:
        twist = message["twist"]["twist"]
        speed = math.hypot(*vector(twist["linear"]))
        turning = math.hypot(*vector(twist["angular"]))
        self._base_moves = speed >= RESTING_M_S or turning >= RESTING_RAD_S
        self._newest = stamp_of(message)

    def _take_joints(self, message: Message) -> None:
        if len(self.joints) < MOST_JOINTS:
            self.joints |= {str(name) for name in message["name"]}
        told = [v for v in numbers(message["velocity"]) if not math.isnan(v)]
        if not told:
            raise PacketError("joints without velocities, which may move or not")
        self._joints_move = any(abs(v) >= RESTING_RAD_S for v in told)

    def _take_hand(self, message: Message) -> None:
        hand = self._profile.hand
        assert hand is not None
        if hand.between is None:
            if not isinstance(message["data"], bool):
                raise PacketError("a Bool that is none")
            self._holding = message["data"]
            self._felt.set()
            return
        positions = dict(zip(message["name"], numbers(message["position"]), strict=True))
        if hand.joint not in positions:
            return
        (low, high), position = hand.between, positions[hand.joint]
        if not math.isfinite(position):  # it does not tell, which is not the same as nothing
            self._holding = None
            return
        self._holding = low < position < high
        self._felt.set()
