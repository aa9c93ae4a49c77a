"""How a robot is stopped over the wire: all goals of all its actions, and then a look at it.

Also those that nobody here remembers: of a program that died, or from before a loss of the link.
"""

import asyncio
import logging

from executive.guards import in_words
from executive.ros.link import Link, LinkError
from executive.ros.messages import everything
from executive.ros.profile import Profile
from executive.ros.protocol import Message
from executive.ros.senses import Senses

CANCELLING_S = 1.0
"""So long a server may take to say that it cancels."""
ASKING_S = 0.2
"""After so long without a word it is asked once more: what was asked may never have arrived."""
FINDING_S = 3.0
"""So long it is tried to stop what is left of earlier."""
REST_S = 2.0
"""The longest that anything moves on (real time)."""
LOOK_S = 0.02
AGAIN_S = 0.5
"""After so long it is asked anew how the robot moves."""
REFUSED = 1
"""`action_msgs/srv/CancelGoal`: the server goes on."""
SPEED_TYPE = "nav2_msgs/msg/SpeedLimit"
"""What Nav2's controller heeds."""
PARTS = {
    "drive": "base",
    "look": "head",
    "pick": "arm",
    "place": "arm",
    "arm": "arm",
    "gripper": "fingers",
}
"""What moves, by the profile's sections."""
DRIVEN = (
    "the robot was at something when I connected, and I ended that: an earlier program had begun "
    "it, or another one drives this robot now, too"
)

log = logging.getLogger(__name__)


class Brake:
    """Stops a robot; all of it is done on the thread of the wire."""

    def __init__(self, link: Link, profile: Profile, senses: Senses) -> None:
        """Stop what is left of earlier, now and whenever there is a link again."""
        self._link = link
        self._profile = profile
        self._senses = senses
        self._under_way: set[asyncio.Task[dict[str, str]]] = set()
        self._was_greeted = self._ended_any = False
        link.greet_with(self._greet)

    async def _greet(self) -> None:
        """Stop orphans; tell the robot how fast it may be.

        A bridge that has just begun may not have found the robot's actions yet.
        """
        latest = asyncio.get_running_loop().time() + FINDING_S
        while (failures := await self.cancel_all()) and not self._link.loss:
            if asyncio.get_running_loop().time() > latest:
                break
            await asyncio.sleep(AGAIN_S)
        for section, why in failures.items():
            log.warning("I could not tell my %s to stop: %s", PARTS[section], why)
        if self._ended_any and not self._was_greeted:
            log.warning(DRIVEN)
        self._was_greeted = True
        limits = self._profile.limits
        if limits.speed_m_s is not None:
            limit: Message = {"percentage": False, "speed_limit": limits.speed_m_s}
            self._link.publish(limits.speed_topic, SPEED_TYPE, limit)

    async def cancel_all(self) -> dict[str, str]:
        """Cancel all goals of all actions; which sections could not be stopped, and why."""
        return await asyncio.shield(self._begin_to_cancel())

    async def settled(self) -> None:
        """Wait until no cancelling is under way: it would hit what is begun meanwhile."""
        if self._under_way:
            await asyncio.wait(self._under_way, timeout=2 * CANCELLING_S)

    def _begin_to_cancel(self) -> asyncio.Task[dict[str, str]]:
        task = asyncio.create_task(self._cancel_all())
        self._under_way.add(task)
        task.add_done_callback(self._under_way.discard)
        return task

    async def _cancel_all(self) -> dict[str, str]:
        sections = self._profile.actions()
        names = dict.fromkeys(action.action for action in sections.values())
        answers = await asyncio.gather(*(self._cancel(name) for name in names))
        why = dict(zip(names, answers, strict=True))
        return {s: why[action.action] for s, action in sections.items() if why[action.action]}

    async def _cancel(self, action: str) -> str:
        """Cancel all goals of an action; why that could not be, or nothing.

        What was asked before what is answered is answered, too, or lost. What was asked later is
        waited for as long again: still on its way, it would hit what is begun next.
        """
        time = asyncio.get_running_loop().time
        began = time()
        latest = began + CANCELLING_S
        asked: list[asyncio.Task[str]] = []
        try:
            while not any(one.done() for one in asked) and (left := latest - time()) > 0:
                asked.append(asyncio.create_task(self._ask_to_cancel(action, left)))
                await asyncio.wait(asked, timeout=ASKING_S, return_when=asyncio.FIRST_COMPLETED)
            await asyncio.wait(asked, return_when=asyncio.FIRST_COMPLETED)
            answered = max(number for number, one in enumerate(asked) if one.done())
            if later := asked[answered + 1 :]:
                await asyncio.wait(later, timeout=time() - began)
            return min((one.result() for one in asked if one.done()), key=len)
        finally:
            for one in asked:
                one.cancel()

    async def _ask_to_cancel(self, action: str, within_s: float) -> str:
        service = f"{action}/_action/cancel_goal"
        kind = "action_msgs/srv/CancelGoal"
        try:
            answer = await self._link.call(
                service, kind, everything(), within_s=within_s, urgent=True
            )
        except LinkError as error:
            return in_words(error)
        self._ended_any |= bool(answer.get("goals_canceling"))
        return "it refuses" if answer.get("return_code") == REFUSED else ""

    async def stop(self) -> tuple[dict[str, str], str]:
        """Cancel all goals and wait for rest.

        What moves meanwhile is cancelled again, whether or not all is answered: it may have been
        begun after it was cancelled, if the one overtook the other.

        Returns:
            Which sections could not be stopped, and why; and what moves in the end, as a clause, or
            nothing.
        """
        try:
            return await self._stopped()
        finally:
            self._senses.feel_motion_anew()

    async def _stopped(self) -> tuple[dict[str, str], str]:
        time = asyncio.get_running_loop().time
        cancelling = self._begin_to_cancel()
        latest, feeling, again = time() + REST_S, 0.0, time() + ASKING_S
        while True:
            if time() >= feeling:
                self._senses.feel_motion_anew(urgent=True)
                feeling = time() + AGAIN_S
            await asyncio.sleep(LOOK_S)
            unrest = self._senses.unrest
            if cancelling.done() and self._link.loss:
                return cancelling.result(), f"nobody can tell whether I move: {self._link.loss}"
            if cancelling.done() and (not unrest or time() > latest):
                return cancelling.result(), unrest
            if unrest and time() >= again:
                self._begin_to_cancel()
                again = time() + ASKING_S
