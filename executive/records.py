"""The records of the log: one type for each kind of thing that a reader may ask about later.

Code that has something to log passes a record to the Recorder, which adds the mission time and
passes it to every sink.
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
    """What the robot does while a behaviour is running; behaviours of others may use other words.

    If several running behaviours have an activity, the innermost counts: it is the most exact.
    """

    DRIVING = "driving"
    LOOKING = "looking"
    HANDLING = "handling"
    THINKING = "thinking"
    ASKING = "asking"
    SEARCHING = "searching"
    """Looking at a place where the thing may be, or driving there."""


@dataclass(frozen=True, slots=True)
class NodeShape:
    """One behaviour of the tree.

    `path` joins the names from the root with slashes, and is unique. A behaviour declares its
    meaning in the last three fields. Code that reads a tree uses these, never the names, which are
    for people and may change.
    """

    path: str
    parent: str
    """Path of the parent; empty for the root."""
    name: str
    kind: str
    """`sequence`, `selector`, `parallel`, `decorator` or `behaviour`."""
    class_name: str
    source: str = ""
    """The source of its result: `person` (in the command), a `Source`, or the name of a
    `PlaceSource`; empty if it is the tree alone."""
    activity: str = ""
    """What the robot does while it is running: an `Activity`; empty if it takes no time."""
    stage: bool = False
    """Whether it is a stage of the mission, which viewers show in a lane of its own."""


@dataclass(frozen=True, slots=True)
class TreeShape:
    """All behaviours, parents before children; written once per mission."""

    nodes: tuple[NodeShape, ...]


@dataclass(frozen=True, slots=True)
class NodeState:
    """A behaviour after a tick: `status` is INVALID, RUNNING, SUCCESS or FAILURE."""

    path: str
    status: str
    message: str = ""


@dataclass(frozen=True, slots=True)
class Tick:
    """The whole tree after one tick, the cause of the tick, and the mission's situation."""

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
    """One finished call of the language model: request, reply, tokens and times."""

    result: Replied | Scored


@dataclass(frozen=True, slots=True)
class Verified:
    """The names in a reply that the verification accepted, and those that it dropped."""

    label: str
    accepted: tuple[str, ...]
    rooms: tuple[str, ...]
    dropped: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class SourceAnswer:
    """The places that a `PlaceSource` gave for a thing; empty if it did not know."""

    source: str
    thing: str
    places: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Recalled:
    """What the robot has learned about where a thing may be now.

    Attributes:
        thing: the thing that is looked for.
        sources: `memory`, where it was last seen, and `habits`, where people may have taken it.
        trusts: of each source, its share of the probability that those before it have left.
        places: where it may be; empty if nothing was learned about it.
        says: the source of each place.
        weights: the relative probability of each place among those of the same source.
    """

    thing: str
    sources: tuple[str, ...]
    trusts: tuple[float, ...]
    places: tuple[str, ...]
    says: tuple[str, ...]
    weights: tuple[float, ...]


@dataclass(frozen=True, slots=True)
class Planned:
    """A decision of the search between looking and asking, with its reasons.

    Attributes:
        thing: the thing that is looked for.
        decision: `look`, `ask`, or `give up`.
        order: the places to look at, in order.
        ask_after: after how many of these to ask; -1: never.
        seconds: expected duration of drives and looks.
        visits: expected number of places looked at.
        questions: expected number of questions.
        cost: expected cost, in seconds, with the price of questions.
        may_ask: whether asking at once is possible.
        asking_cost: expected cost of asking at once.
        may_look: whether there is a place to look at.
        looking_cost: expected cost of the best plan that begins with a look.
        places: where the thing may be, the likeliest first.
        probabilities: the probability of each place.
        says: the sources of each place with their shares: "memory 0.90, llm 0.01".
        elsewhere: probability that the thing is at none of these.
        text: the decision as a sentence.
        away: seconds to drive to each place from here and look there; -1 if there is no path, or
            the place is not worth a look. Empty in earlier recordings.
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
    """The robot's estimates of drives from a place to others (s); -1: there is no path."""

    start: str
    places: tuple[str, ...]
    seconds: tuple[float, ...]


@dataclass(frozen=True, slots=True)
class Utterance:
    """A sentence that was said; `speaker` is `person` or `robot`."""

    speaker: str
    text: str


@dataclass(frozen=True, slots=True)
class Note:
    """A log message; `level` is `debug`, `info`, `warning` or `error`."""

    level: str
    text: str


# --- what was seen, and the world for viewers ---


@dataclass(frozen=True, slots=True, eq=False)
class Picture:
    """A camera frame."""

    frame: Frame


@dataclass(frozen=True, slots=True, eq=False)
class Seen:
    """What was recognised in the picture with this number."""

    frame_number: int
    detections: tuple[Detection, ...]


@dataclass(frozen=True, slots=True)
class Shape:
    """One rigid shape of an entity, in the entity's frame.

    `kind` is `box` (size = full lengths x, y, z), `cylinder` (size = diameter, diameter, length
    along z), `sphere` (size = diameter, diameter, diameter) or `mesh` (size = scale). The file of a
    `mesh` is an OBJ, drawn in `color`, or a GLB, which has its own colours and, as all glTF, y up
    and z to the front.
    """

    kind: str
    size: Vector3
    color: Color
    pose: Pose = field(default_factory=Pose)
    mesh: str = ""


@dataclass(frozen=True, slots=True)
class Entity:
    """A visible object; its shapes move with the frame `frame_id`."""

    name: str
    frame_id: str
    shapes: tuple[Shape, ...]


@dataclass(frozen=True, slots=True)
class Scene:
    """The home and the robot as the simulator draws them: for viewers, never for the robot."""

    entities: tuple[Entity, ...]


@dataclass(frozen=True, slots=True)
class Transform:
    """The pose of the frame `child` in the frame `parent`."""

    parent: str
    child: str
    pose: Pose


@dataclass(frozen=True, slots=True)
class Transforms:
    """The frames that moved since the last record."""

    transforms: tuple[Transform, ...]


@dataclass(frozen=True, slots=True)
class PlannedPath:
    """The path that the robot plans to drive: points in `map` (metres)."""

    points: tuple[Vector3, ...]


@dataclass(frozen=True, slots=True)
class Mishap:
    """An injected fault has occurred in the simulated world: for readers, never for the robot.

    `fault` is the fault as given to `--fault`, `text` what it did.
    """

    fault: str
    text: str


@dataclass(frozen=True, slots=True)
class Intervention:
    """What an experimenter did: the event `Intervened`, for readers of these records alone."""

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
