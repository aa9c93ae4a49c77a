"""A link that is lost during a goal: it is waited for, and the goal is done again from its begin.

Only a goal for which that is right is given here: a drive or a look, not a grasp.
"""

import logging
from collections.abc import Awaitable, Callable

from executive.guards import in_words
from executive.ros.link import Link, LinkError
from executive.types import Failed, Succeeded

Attempt = Callable[[], Awaitable[Succeeded | Failed]]

log = logging.getLogger(__name__)


class Losses:
    """Belongs to the thread of the wire."""

    def __init__(self, link: Link, wait_s: float, settled: Callable[[], Awaitable[None]]) -> None:
        """A link that is lost is waited for so long (s); 0: not at all.

        `settled` waits until nothing is being cancelled: that would hit what is begun next.
        """
        self._link = link
        self._wait_s = wait_s
        self._settled = settled
        self._was_in_vain = False

    async def outlived(self, attempt: Attempt) -> Succeeded | Failed:
        """Attempt something; once more, if that fails, the link was lost, and it comes back.

        A goal may also fail because of the stop that follows when there is a link again.

        Raises:
            LinkError: if it does not come back, or is lost again.
        """
        before = self._link.losses
        if not self._link.loss:
            self._was_in_vain = False
        try:
            result = await attempt()
        except LinkError:
            if not self._is_waited_for(before):
                raise
        else:
            if isinstance(result, Succeeded) or result.lost or not self._is_waited_for(before):
                return result
        await self._wait()
        return await attempt()

    def _is_waited_for(self, before: int) -> bool:
        """Whether it was lost since then; one that did not come back is not waited for again."""
        was_lost = bool(self._link.loss) or self._link.losses != before
        return was_lost and self._wait_s > 0 and not self._was_in_vain

    async def _wait(self) -> None:
        log.warning("I lost the link to my robot: I wait for it, %g s at most", self._wait_s)
        try:
            await self._link.ready(self._wait_s)
        except LinkError as error:
            self._was_in_vain = True
            raise LinkError(f"I waited {self._wait_s:g} s, and {in_words(error)}") from None
        log.warning("there is a link to my robot again: I go on")
        await self._settled()
