"""How the mission ends: its status, the reason that is told, and who decided."""

from dataclasses import dataclass, field

from executive.situation.snapshot import NOT_LOGGED, logged_as
from executive.types.outcome import MissionStatus

TAKEN_BACK = "you took it back"
"""The reason of a task that was not done because the person took it back."""
STILL_HELD = "; I still hold "
"""Follows the reason, before the name of the thing in the hand, if a mission was cut short."""


@dataclass
class Ending:
    """The end of a mission: decided by the tree, or cut short."""

    status: MissionStatus = MissionStatus.NOT_DONE
    reason: str = field(default="", metadata=NOT_LOGGED)
    """What the person is told at the end: what was done, or why it was not."""
    last_word: str = field(default="", metadata=logged_as("reason"))
    """The last failure of a behaviour, or `reason`; only for the log."""
    stopped_by: str = field(default="", metadata=NOT_LOGGED)
    """Who requested a stop; empty if nobody did. After this, or the next two, no tick follows."""
    broke: str = field(default="", metadata=NOT_LOGGED)
    """The internal error that ended the mission, in words; empty if there was none."""
    unreachable: str = field(default="", metadata=NOT_LOGGED)
    """Why the robot cannot be reached any more; empty if it can, as far as is known."""
    decided: bool = field(default=False, metadata=NOT_LOGGED)
    """Whether the tree has decided how the mission ends."""
    restless: bool = False
    """Whether the robot did not do what it was last told, so that it may still move."""

    def tell(self, reason: str) -> None:
        """Set what the person is told at the end."""
        self.reason = self.last_word = reason

    def stop(self, by: str) -> None:
        """Stop the mission, unless it is over already; so only the first stop counts."""
        if not self.is_over:
            self.stopped_by = by
            self.status, self.reason = MissionStatus.STOPPED, f"stopped by {by}"

    def break_off(self, reason: str) -> None:
        """End the mission because of an internal error, unless it is over already."""
        if not self.is_over:
            self.broke = reason
            self.status, self.reason = MissionStatus.NOT_DONE, reason

    def stay_restless(self, why: str = "") -> None:
        """Say that the robot may still be moving."""
        self.restless = True
        self.reason += "; I may not be at rest" + (f": {why}" if why.strip() else "")

    def hold_on_to(self, thing: str) -> None:
        """Say that the robot still holds this thing."""
        self.reason += f"{STILL_HELD}{thing}"

    @property
    def is_cut_short(self) -> bool:
        """Whether the mission ended without the tree's decision: by a stop or an internal error."""
        return bool(self.stopped_by or self.broke)

    @property
    def is_over(self) -> bool:
        """Whether it is settled how the mission ends; nothing changes that any more."""
        return self.decided or self.is_cut_short

    @property
    def why(self) -> str:
        """The reason to tell at the end; never empty."""
        if self.reason:
            return self.reason
        return f"the mission ended as {self.status.replace('_', ' ')}, and nothing said why"
