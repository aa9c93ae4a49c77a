"""What is written down: one typed record for each thing that a reader may ask about later.

Whoever makes something worth keeping hands one of these to the Recorder, which stamps it with the
mission time and passes it to every sink.
"""

from dataclasses import dataclass, field
from enum import StrEnum
from typing import Any

from executive.colors import Color
from executive.events import Event
from executive.types.geometry import Pose, Vector3
from executive.types.outcome import Outcome
from executive.types.perception import Detection, Frame
from executive.types.results import Replied, Scored

# --- the tree ---


class Activity(StrEnum):
    """What the robot is doing while a behaviour is running; behaviours of one's own may add words.

    A behaviour inside of another one says it more exactly: of those running, the innermost counts.
    """

    DRIVING = "driving"
    LOOKING = "looking"
    HANDLING = "handling"
    THINKING = "thinking"
    ASKING = "asking"
    SEARCHING = "searching"
    """At a place where the thing may be, or on the way there: what `look at ...` is told of."""


@dataclass(frozen=True, slots=True)
class NodeShape:
    """One behaviour of the tree; `path` is the names from the root, joined by slashes, unique.

    What a behaviour means stands in the last three, as it declares it. Whoever reads a tree goes by
    them, never by a name: names are there to be read by people, and may change.
    """

    path: str
    parent: str
    """Path of the parent; empty for the root."""
    name: str
    kind: str
    """`sequence`, `selector`, `parallel`, `decorator` or `behaviour`."""
    class_name: str
    source: str = ""
    """Who says what it settles: `person` (in the command), a `Source`, or a source of one's own;
    empty if nobody but the tree."""
    activity: str = ""
    """What the robot is doing while it is running: an `Activity`; empty if it takes no time."""
    stage: bool = False
    """Whether it is a part of the mission that deserves a lane of its own."""


@dataclass(frozen=True, slots=True)
class TreeShape:
    """All behaviours, parents before children, written once a mission."""

    nodes: tuple[NodeShape, ...]


@dataclass(frozen=True, slots=True)
class NodeState:
    """A behaviour after a tick: `status` is INVALID, RUNNING, SUCCESS or FAILURE."""

    path: str
    status: str
    message: str = ""


@dataclass(frozen=True, slots=True)
class Tick:
    """The whole tree after one tick, what caused it, and what the mission knows."""

    number: int
    cause: str
    tip: str
    nodes: tuple[NodeState, ...]
    situation: dict[str, Any]
    duration_s: float
    """Wall time of the tick itself."""


# --- talk, thought, events ---


@dataclass(frozen=True, slots=True)
class EventTaken:
    """An event as the executive took it from its inbox."""

    event: Event


@dataclass(frozen=True, slots=True)
class LlmCall:
    """One finished call of the language model, with request, reply, tokens and times."""

    result: Replied | Scored


@dataclass(frozen=True, slots=True)
class Verified:
    """What the verification let through of a reply, and what it kept out."""

    label: str
    accepted: tuple[str, ...]
    rooms: tuple[str, ...]
    dropped: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class SourceAnswer:
    """Where a knowledge source of one's own said that a thing is: nowhere, if it did not know."""

    source: str
    thing: str
    places: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Recalled:
    """What the robot has learned of where a thing may be now.

    Attributes:
        thing: what is looked for.
        sources: `memory`, where it was last, and `habits`, where it may have been taken since.
        trusts: how much each of them takes of what those before it have left.
        places: where it may be; none if nothing was learned of it.
        says: whose word each of these is.
        weights: how likely each is beside the others of the same source.
    """

    thing: str
    sources: tuple[str, ...]
    trusts: tuple[float, ...]
    places: tuple[str, ...]
    says: tuple[str, ...]
    weights: tuple[float, ...]


@dataclass(frozen=True, slots=True)
class Planned:
    """What the robot is going to do in its search, and why: a decision between looking and asking.

    Attributes:
        thing: what is looked for.
        decision: `look`, `ask`, or `give up`.
        order: where it means to look, in this order; the first is next.
        ask_after: after how many of these it means to ask; -1: never.
        seconds: of ways and looks, expected.
        visits: expected.
        questions: expected.
        cost: expected, in seconds, with the price of questions.
        may_ask: whether asking at once is a choice.
        asking_cost: what it costs then, expected.
        may_look: whether there is anywhere to look.
        looking_cost: what the best plan costs that begins with a look.
        places: where the thing may be, the likeliest first.
        probabilities: how likely, in the same order.
        says: who says so, in the same order, each with what it gave: "memory 0.90, llm 0.01".
        elsewhere: how likely it is at none of these.
        text: the decision as a sentence.
        away: how long the way from here and the look take of each of the places (s), in the same
            order; -1: there is no way, or it is not worth a look. Empty in recordings of before.
    """

    thing: str
    decision: str
    order: tuple[str, ...]
    ask_after: int
    seconds: float
    visits: float
    questions: float
    cost: float
    may_ask: bool
    asking_cost: float
    may_look: bool
    looking_cost: float
    places: tuple[str, ...]
    probabilities: tuple[float, ...]
    says: tuple[str, ...]
    elsewhere: float
    text: str
    away: tuple[float, ...] = ()


@dataclass(frozen=True, slots=True)
class WaysTold:
    """How long the robot's ways from a place to others take (s), as it told; -1: there is none."""

    start: str
    places: tuple[str, ...]
    seconds: tuple[float, ...]


@dataclass(frozen=True, slots=True)
class Utterance:
    """Something said: speaker is `person` or `robot`."""

    speaker: str
    text: str


@dataclass(frozen=True, slots=True)
class Note:
    """A line for the log: level is `debug`, `info`, `warning` or `error`."""

    level: str
    text: str


# --- what was seen, and the world for the eye of the reader ---


@dataclass(frozen=True, slots=True, eq=False)
class Picture:
    """A camera frame, as taken."""

    frame: Frame


@dataclass(frozen=True, slots=True, eq=False)
class Seen:
    """What was recognised in the picture with this number."""

    frame_number: int
    detections: tuple[Detection, ...]


@dataclass(frozen=True, slots=True)
class Shape:
    """One rigid primitive of an entity, in the entity's frame.

    `kind` is `box` (size = full lengths x, y, z), `cylinder` (size = diameter, diameter, length
    along z), `sphere` (size = thrice the diameter) or `mesh` (size = scale). The file of a `mesh`
    is an OBJ, drawn in the colour, or a GLB, which has its own colours and, as all glTF, y up and
    z to the front.
    """

    kind: str
    size: Vector3
    color: Color
    pose: Pose = field(default_factory=Pose)
    mesh: str = ""


@dataclass(frozen=True, slots=True)
class Entity:
    """A visible thing: its shapes move with the frame `frame_id`."""

    name: str
    frame_id: str
    shapes: tuple[Shape, ...]


@dataclass(frozen=True, slots=True)
class Scene:
    """The home and the robot as the simulator draws them: for viewers, never for the robot."""

    entities: tuple[Entity, ...]


@dataclass(frozen=True, slots=True)
class Transform:
    """Where the frame `child` is in the frame `parent`."""

    parent: str
    child: str
    pose: Pose


@dataclass(frozen=True, slots=True)
class Transforms:
    """The frames that moved since the last record."""

    transforms: tuple[Transform, ...]


@dataclass(frozen=True, slots=True)
class PlannedPath:
    """The way that the robot means to drive: points in `map` (metres)."""

    points: tuple[Vector3, ...]


@dataclass(frozen=True, slots=True)
class Mishap:
    """A fault that was ordered has struck the simulated world: for readers, never for the robot.

    `fault` is the order as `--fault` has it, `text` what it did.
    """

    fault: str
    text: str


@dataclass(frozen=True, slots=True)
class Intervention:
    """What an experimenter did, beside its event (`Intervened`): for who only reads of these."""

    by: str
    deed: str
    was: str
    became: str


@dataclass(frozen=True, slots=True)
class Finished:
    """The mission is over."""

    outcome: Outcome


Record = (
    TreeShape
    | Tick
    | EventTaken
    | LlmCall
    | Verified
    | Recalled
    | SourceAnswer
    | Planned
    | WaysTold
    | Utterance
    | Note
    | Picture
    | Seen
    | Scene
    | Transforms
    | PlannedPath
    | Mishap
    | Intervention
    | Finished
)
