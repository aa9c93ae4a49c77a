"""A link that is lost during a goal: it is waited for, and the goal is done again from its begin.

What handles things is not done again; but that there is no link any more, is known of it, too.
The person is told when it is waited for, and when it is back.
"""

from collections.abc import Awaitable, Callable
from typing import TypeVar

from executive.guards import in_words
from executive.ros.link import Link, LinkError, NoLinkError
from executive.types.results import Failed

T = TypeVar("T")


class Losses:
    """Belongs to the thread of the wire."""

    def __init__(
        self,
        link: Link,
        wait_s: float,
        settled: Callable[[], Awaitable[None]],
        tell: Callable[[str], None],
    ) -> None:
        """A link that is lost is waited for so long (s); 0: not at all.

        `settled` waits until nothing is being cancelled: that would hit what is begun next; `tell`
        is given sentences for the person.
        """
        self._link = link
        self._wait_s = wait_s
        self._settled = settled
        self._tell = tell
        self._in_vain: int | None = None
        """How often it had been lost when it was last waited for in vain."""

    @property
    def is_for_good(self) -> bool:
        """Whether there is no link, and it was waited for in vain."""
        return bool(self._link.loss) and self._in_vain == self._link.losses

    async def outlived(self, attempt: Callable[[], Awaitable[T]], *, again: bool = True) -> T:
        """Attempt something; once more, if that fails, the link was lost, and it comes back.

        A goal may also fail because of the stop that follows when there is a link again. What must
        not be done `again` has failed, but not before there is a link again.

        Raises:
            NoLinkError: if the link was lost, and does not come back.
            LinkError: if it fails otherwise.
        """
        before, again = self._link.losses, again and self._wait_s > 0
        try:
            result = await attempt()
        except LinkError as error:
            if not self._was_lost(before):
                raise
            await self._come_back(in_words(error))
            if not again:
                raise
        else:
            failed = isinstance(result, Failed) and not result.lost
            if not (failed and again and self._was_lost(before)):
                return result
            await self._come_back(f"there is no link to the robot: {self._link.loss}")
        return await self.outlived(attempt, again=False)

    def _was_lost(self, before: int) -> bool:
        return bool(self._link.loss) or self._link.losses != before

    async def _come_back(self, without: str) -> None:
        """Wait for the link; one that did not come back is not waited for again.

        `without` is what is said if there is none and it is not waited for.
        """
        if self._link.loss and (self.is_for_good or not self._wait_s):
            raise NoLinkError(without)
        if not self._wait_s:
            return
        self._tell(f"I lost the link to my robot: I wait for it, {self._wait_s:g} s at most.")
        try:
            await self._link.ready(self._wait_s)
        except LinkError as error:
            self._in_vain = self._link.losses
            raise NoLinkError(f"I waited {self._wait_s:g} s, and {in_words(error)}") from None
        self._tell("There is a link to my robot again: I go on.")
        await self._settled()
