"""How it stands between the robot and the person."""

from dataclasses import dataclass, field
from typing import Any

from executive.language.spoken import NOTHING, Spoken
from executive.situation.snapshot import NOT_LOGGED, logged_as
from executive.types.home import PERSON


def _spoken(spoken: Spoken) -> dict[str, Any]:
    """What words for what was spoken of stand for; what they may be is in the metadata."""
    return {"things": list(spoken.things), "called": spoken.called, "place": spoken.place}


@dataclass
class Dialogue:
    """Whether the person is there to be asked, and how often they were."""

    away: bool = False
    """Whether the robot has left the person."""
    at: str = field(default=PERSON, metadata=NOT_LOGGED)
    """The place that the robot has driven to last, in this mission or before."""
    stands: str | None = field(default=None, metadata=NOT_LOGGED)
    """Where it came to in this mission; empty if it is on its way, None if it did not drive."""
    heads_for: str = field(default="", metadata=NOT_LOGGED)
    """The place that it last set out for in this mission, whether it came there or not."""
    inquiries: int = 0
    no_help: str = ""
    """Why the person cannot or will not help, as a clause; empty if they may."""
    spoken: Spoken = field(default=NOTHING, metadata=logged_as(plain=_spoken))
    """What was spoken of before this mission: what "it" and "there" stand for."""
    heard: list[str] = field(default_factory=list)
    """What the person has said unasked, and nobody has attended to yet, oldest first."""
    news: list[str] = field(default_factory=list, metadata=NOT_LOGGED)
    """What the robot's body has told, and nobody has told the person yet, oldest first."""
