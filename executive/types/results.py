"""Results of requests."""

from dataclasses import dataclass

from executive.types.llm import ChatRequest, RankRequest, Usage
from executive.types.perception import Detection


@dataclass(frozen=True, slots=True)
class Succeeded:
    """The robot reached its goal."""


@dataclass(frozen=True, slots=True)
class Failed:
    """The request failed.

    Attributes:
        reason: why, as a clause for the person: "the way is blocked".
        lost: whether the held thing fell from the hand on the way.
        unreachable: whether the robot itself cannot be reached any more; this ends the mission, and
            nothing else is tried.
    """

    reason: str
    lost: bool = False
    unreachable: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class Saw:
    """What was recognised in the picture of this number, the highest confidence first."""

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
    """Logarithms of how likely the options are, up to a common constant, in the request's order."""

    request: RankRequest
    scores: tuple[float, ...]
    usage: Usage


@dataclass(frozen=True, slots=True)
class Answered:
    """The person gave this answer."""

    text: str


Result = Succeeded | Failed | Saw | Replied | Scored | Answered
