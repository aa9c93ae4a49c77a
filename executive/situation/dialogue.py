"""The state of the dialogue between robot and person."""

from dataclasses import dataclass, field
from typing import Any

from executive.language.spoken import NOTHING, Spoken
from executive.situation.snapshot import NOT_LOGGED, logged_as
from executive.types.home import PERSON


def _spoken(spoken: Spoken) -> dict[str, Any]:
    """What was spoken of, as JSON for the log; the candidates are in the recording's metadata."""
    return {"things": list(spoken.things), "called": spoken.called, "place": spoken.place}


@dataclass
class Dialogue:
    """Where the robot is relative to the person, and what was asked, heard and spoken of."""

    away: bool = False
    """Whether the robot has left the person."""
    at: str = field(default=PERSON, metadata=NOT_LOGGED)
    """The place that the robot last drove to, in this mission or before."""
    stands: str | None = field(default=None, metadata=NOT_LOGGED)
    """Where it arrived in this mission; empty while it drives, None if it has not driven."""
    heads_for: str = field(default="", metadata=NOT_LOGGED)
    """The goal of its last drive in this mission, whether it arrived or not."""
    inquiries: int = 0
    no_help: str = ""
    """Why the person cannot or will not help, as a clause; empty if they may."""
    spoken: Spoken = field(default=NOTHING, metadata=logged_as(plain=_spoken))
    """What was spoken of before this mission: what "it" and "there" stand for."""
    heard: list[str] = field(default_factory=list)
    """What the person said without being asked, and no behaviour has handled yet; oldest first."""
    news: list[str] = field(default_factory=list, metadata=NOT_LOGGED)
    """Messages of the robot's body that the person was not told yet, oldest first."""
