"""How the mission ends: what is told, and whether it was the tree that decided."""

from dataclasses import dataclass, field

from executive.situation.snapshot import NOT_LOGGED, logged_as
from executive.types.outcome import MissionStatus

TAKEN_BACK = "you took it back"
"""Why a task was not done that the person does not want any more."""
STILL_HELD = "; I still hold "
"""What comes before the thing that is in the hand when a mission was cut short."""


@dataclass
class Ending:
    """What becomes known at the end of a mission, or cuts it short."""

    status: MissionStatus = MissionStatus.NOT_DONE
    reason: str = field(default="", metadata=NOT_LOGGED)
    """What is told at the end: what was done, or why it was not."""
    last_word: str = field(default="", metadata=logged_as("reason"))
    """Why a behaviour failed last, or what was told: for the log, nothing is decided by it."""
    stopped_by: str = field(default="", metadata=NOT_LOGGED)
    """Who said stop; empty if nobody did. No tick comes after this, or the next two."""
    broke: str = field(default="", metadata=NOT_LOGGED)
    """Why the program itself failed; empty if it did not."""
    unreachable: str = field(default="", metadata=NOT_LOGGED)
    """Why there is no way to the robot any more; empty if there is one, as far as is known."""
    decided: bool = field(default=False, metadata=NOT_LOGGED)
    """Whether the tree has decided how the mission ends."""
    restless: bool = False
    """Whether the robot did not do what it was told last, so that it may not stand still."""

    def tell(self, reason: str) -> None:
        """It is settled what is told at the end."""
        self.reason = self.last_word = reason

    def stop(self, by: str) -> None:
        """Someone says stop; the first who does, and in time, is heard."""
        if not self.is_over:
            self.stopped_by = by
            self.status, self.reason = MissionStatus.STOPPED, f"stopped by {by}"

    def break_off(self, reason: str) -> None:
        """The program itself failed, unless all was settled already."""
        if not self.is_over:
            self.broke = reason
            self.status, self.reason = MissionStatus.NOT_DONE, reason

    def stay_restless(self, why: str = "") -> None:
        """It is not known that the robot stands still: say so."""
        self.restless = True
        self.reason += "; I may not be at rest" + (f": {why}" if why.strip() else "")

    def hold_on_to(self, thing: str) -> None:
        """The mission was cut short with this in the hand: say so."""
        self.reason += f"{STILL_HELD}{thing}"

    @property
    def is_cut_short(self) -> bool:
        """Whether the mission ends without a decision: stopped, or the program failed."""
        return bool(self.stopped_by or self.broke)

    @property
    def is_over(self) -> bool:
        """Whether it is settled how the mission ends: what comes later does not change that."""
        return self.decided or self.is_cut_short

    @property
    def why(self) -> str:
        """The reason that is told at the end; never empty."""
        if self.reason:
            return self.reason
        return f"the mission ended as {self.status.replace('_', ' ')}, and nothing said why"
