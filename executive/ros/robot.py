"""A robot over the wire: goals are begun and called off here, and pursued on the wire's thread."""

import asyncio
from collections.abc import Callable

from executive.events import Inbox
from executive.ros.deeds import Deeds, Remote
from executive.ros.thread import WireThread
from executive.types.goals import Goal, Halt
from executive.types.results import Failed


class WireRobot:
    """Implements `Robot`. `start` and `cancel` return at once; all else is on the wire's thread."""

    def __init__(
        self,
        wire: WireThread,
        remote: Remote,
        deeds: Deeds,
        inbox: Inbox,
        ways: Callable[[str, str], float],
        begins: Callable[[], None],
    ) -> None:
        """Be at nothing.

        `ways` tells how long ways between places take (s); `begins` is called when a goal does, on
        the thread that ticks.
        """
        clock = remote.profile.clock
        self._wire = wire
        self._brake = remote.brake
        self._deeds = deeds
        self._inbox = inbox
        self._ways = ways
        self._begins = begins
        self._real = clock is None or clock.counts_while_idle
        self._request: int | None = None
        self._task: asyncio.Task[None] | None = None

    # --- Robot; on the thread that ticks ---

    @property
    def holding(self) -> bool | None:
        """Whether something is in the hand; None if the robot cannot tell."""
        return self._deeds.holding

    @property
    def busy(self) -> bool:
        """Whether a goal is under way."""
        return self._request is not None and self._inbox.is_open(self._request)

    def acted_s(self) -> float:
        """How long it was at goals so far, by its own clock (s); 0 if it has none."""
        return self._deeds.acting.seconds

    def views(self, place: str) -> int:
        """How many looks it takes to see all of a place."""
        return self._deeds.views(place)

    def seconds(self, start: str, place: str) -> float:
        """How long a way takes, by the map of the home; the robot itself is not asked."""
        return self._ways(start, place)

    def start(self, goal: Goal) -> int:
        """Pursue a goal; ends Succeeded, or Failed with a reason."""
        if self._request is not None and self._inbox.is_open(self._request):
            self._inbox.end(self._request, Failed("replaced by another goal"))
        self._request = self._inbox.open(real=self._real)
        self._begins()
        self._deeds.acting.run()
        self._wire.start(self._pursue(self._request, goal))
        return self._request

    def cancel(self, request: int) -> None:
        """Give up the goal and brake to rest; its end is not delivered."""
        was_open = self._inbox.is_open(request)
        self._inbox.drop(request)
        if request == self._request and was_open:
            self._request = None
            self._deeds.acting.pause()
            self._wire.start(self._call_off())

    # --- on the thread of the wire ---

    async def _pursue(self, request: int, goal: Goal) -> None:
        task = asyncio.current_task()
        before, self._task = self._task, task
        if not isinstance(goal, Halt):
            await self._give_up(before)
            await self._brake.settled()
        elif before is not None:
            before.cancel()
        result = await self._deeds.do(goal)
        if self._task is task:
            self._deeds.acting.pause()
        self._inbox.end(request, result)

    async def _give_up(self, task: asyncio.Task[None] | None) -> None:
        if task is not None and not task.done():
            task.cancel()
            await asyncio.wait({task}, timeout=1.0)

    async def _call_off(self) -> None:
        task, self._task = self._task, None
        if task is not None:
            task.cancel()
        await self._brake.cancel_all()
