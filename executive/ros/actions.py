"""Goals of the robot's own actions: made by the profile's templates, watched, told in words."""

import asyncio
import logging
import math
from collections.abc import Mapping
from typing import Any

from executive.ros.link import GoalEnd, Link, LinkError
from executive.ros.profile import PATH_TYPE, Profile
from executive.ros.protocol import GoalStatus, Message
from executive.ros.stopping import PARTS
from executive.ros.templates import filled
from executive.text import one_line
from executive.types.results import Failed

LINK_S = 5.0
"""So long a goal waits for a link that was lost."""
PATH_S = 10.0
MOST_LEGS = 200
SAID = 200
"""So many characters of a reason are told."""

log = logging.getLogger(__name__)


class Actions:
    """The actions that a profile names."""

    def __init__(self, link: Link, profile: Profile) -> None:
        """Pursue nothing."""
        self._link = link
        self._profile = profile
        self.used: set[str] = set()
        """Sections whose action was given a goal since the robot was known to be at rest."""

    async def do(self, section: str, values: Mapping[str, Any]) -> GoalEnd:
        """Pursue a goal to its end.

        Raises:
            LinkError: if there is no link, or no sign of the goal for too long.
        """
        action = self._profile.actions()[section]
        goal: Message = filled(action.template, values)
        self.used.add(section)
        return await self._watched(action.action, action.type, goal, action.silent_s, section)

    async def _watched(
        self, name: str, kind: str, goal: Message, silent_s: float, section: str
    ) -> GoalEnd:
        await self._link.ready(LINK_S)
        loop = asyncio.get_running_loop()
        heard = loop.time()

        def hear(feedback: Message) -> None:
            nonlocal heard
            heard = loop.time()

        pursuit = asyncio.create_task(self._link.pursue(name, kind, goal, hear))
        try:
            while not pursuit.done():
                left = heard + silent_s - loop.time()
                if left <= 0:
                    raise LinkError(_silence(PARTS[section], name, silent_s))
                await asyncio.wait({pursuit}, timeout=left)
            return pursuit.result()
        finally:
            pursuit.cancel()

    async def legs(self, pose: Message) -> list[Message]:
        """Where to drive one after the other to get there; one leg if the profile says so."""
        drive = self._profile.drive
        if drive.path is None or drive.leg_m is None:
            return [pose]
        goal = {"goal": pose, "use_start": False}
        end = await self._watched(drive.path, PATH_TYPE, goal, PATH_S, "drive")
        if not end.succeeded:
            log.info("no way was planned: the drive is one leg")
            return [pose]
        between = _cut([one["pose"] for one in end.values["path"]["poses"]], drive.leg_m)
        return [*({"header": pose["header"], "pose": one} for one in between), pose]

    def failure(self, end: GoalEnd, otherwise: str, lost: bool = False) -> Failed:
        """How a goal failed, in the robot's own words if it has any."""
        said = end.values.get("error_msg") or end.values.get("message") or end.reason
        reason = one_line(said)[:SAID] if isinstance(said, str) else ""
        if not reason and end.status == GoalStatus.CANCELED:
            reason = f"{otherwise}: it was called off"
        code = end.values.get("error_code")
        if not reason:
            reason = f"{otherwise} (error {code})" if isinstance(code, int) and code else otherwise
        return Failed(reason, lost or end.values.get("lost") is True)


def _silence(part: str, name: str, silent_s: float) -> str:
    do = "do" if part.endswith("s") else "does"
    return f"my {part} {do} not answer: no sign of {name} for {silent_s:g} s"


def _cut(poses: list[Message], leg_m: float) -> list[Message]:
    """Poses along a way, about so far apart (metres); none near its end."""
    cut: list[Message] = []
    gone = 0.0
    for one, other in zip(poses, poses[1:], strict=False):
        gone += _distance(one, other)
        if gone >= leg_m and len(cut) < MOST_LEGS:
            cut.append(other)
            gone = 0.0
    if cut and gone < leg_m / 2:
        cut.pop()
    return cut


def _distance(one: Message, other: Message) -> float:
    a, b = one["position"], other["position"]
    return math.hypot(b["x"] - a["x"], b["y"] - a["y"])
