"""What comes back: the end of anything that was started."""

from dataclasses import dataclass

from executive.types.llm import ChatRequest, RankRequest, Usage
from executive.types.perception import Detection


@dataclass(frozen=True, slots=True)
class Succeeded:
    """The robot did it."""


@dataclass(frozen=True, slots=True)
class Failed:
    """It could not be done, and why, as a clause for the person: "the way is blocked".

    `lost` tells that what was in the hand fell out of it on the way, and lies about; `unreachable`
    that there is no way to the robot any more, so that the mission ends: nothing else is tried.
    """

    reason: str
    lost: bool = False
    unreachable: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class Saw:
    """The picture with this number, and what was recognised in it, surest first."""

    frame_number: int
    detections: tuple[Detection, ...]


@dataclass(frozen=True, slots=True)
class Replied:
    """The language model wrote this."""

    request: ChatRequest
    text: str
    usage: Usage
    finish_reason: str = "stop"


@dataclass(frozen=True, slots=True)
class Scored:
    """The logarithm of how likely each option is, up to a constant, in the request's order."""

    request: RankRequest
    scores: tuple[float, ...]
    usage: Usage


@dataclass(frozen=True, slots=True)
class Answered:
    """The person said this."""

    text: str


Result = Succeeded | Failed | Saw | Replied | Scored | Answered
