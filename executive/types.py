"""The nouns of the executive: immutable values with their units and frames.

Frames follow REP-103 and REP-105: metres, radians, x forward, y left, z up; `map` is fixed to the
home, `base_link` to the robot, `camera_optical` to the camera (x right, y down, z forward).
Quaternions are (x, y, z, w).
"""

from dataclasses import dataclass, field
from enum import StrEnum
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:  # a quarter of the time that --help takes
    import numpy as np
    from numpy.typing import NDArray

Vector3 = tuple[float, float, float]
Quaternion = tuple[float, float, float, float]
Color = tuple[float, float, float, float]
"""Red, green, blue, opacity in [0, 1]."""


# --- what is asked, and what came of it ---


PERSON = "person"
"""Where the robot stands when it speaks with the person; it is no furniture."""
DELIVERY = "delivery"
"""The place by the person where brought things are put down; it is no furniture to search."""


@dataclass(frozen=True, slots=True)
class Meaning:
    """What a verb asks of the robot, as far as others than its own subtree have to know it.

    Attributes:
        searches: whether it is about a thing that has to be found first.
        grasps: whether the robot has to pick that thing up.
        ends_at: where the robot is in the end, and the thing with it if it grasps: `PERSON`,
            `DELIVERY`; None: where the thing was found.
        at_goal: whether it is at the command's goal instead.
    """

    searches: bool = True
    grasps: bool = False
    ends_at: str | None = None
    at_goal: bool = False

    @property
    def carries(self) -> bool:
        """Whether the thing is in another place in the end."""
        return self.grasps and (self.at_goal or self.ends_at is not None)


class CommandKind(StrEnum):
    """What the person wants done with the thing: the verb, and what it means."""

    means: Meaning

    FIND = "find", Meaning(ends_at=PERSON)
    TAKE = "take", Meaning(grasps=True)
    BRING = "bring", Meaning(grasps=True, ends_at=DELIVERY)
    PUT_DOWN = "put_down", Meaning(searches=False)
    """What is in the hand, by the person."""
    PUT = "put", Meaning(grasps=True, at_goal=True)
    """On the furniture, or in the room, that the goal names."""
    PUT_BACK = "put_back", Meaning(grasps=True, at_goal=True)
    """Where it was taken from."""
    GO = "go", Meaning(searches=False, at_goal=True)
    """The robot itself, to the goal."""
    COUNT = "count", Meaning(searches=False, ends_at=PERSON)
    """How many there are."""
    TELL = "tell", Meaning(searches=False, ends_at=PERSON)
    """What is at a place."""
    CHECK = "check", Meaning(searches=False, ends_at=PERSON)
    """Whether a thing is there."""
    CLEAR = "clear", Meaning(searches=False)
    """A piece of furniture, of all that is seen on it: each thing goes where it belongs."""

    def __new__(cls, verb: str, means: Meaning = Meaning()) -> "CommandKind":
        """The verb itself is the value: it stands in recordings."""
        kind = str.__new__(cls, verb)
        kind._value_ = verb
        kind.means = means
        return kind


SEARCHING = tuple(kind for kind in CommandKind if kind.means.searches and not kind.means.at_goal)
"""The deeds that are about a thing and nothing else: a language model may read these into words."""


class Source(StrEnum):
    """Who an answer came from; a knowledge source of one's own has a name of its own besides."""

    ONTOLOGY = "ontology"
    LLM = "llm"
    USER = "user"
    MEMORY = "memory"
    HABITS = "habits"
    """Of the people at home, as the robot has learned them."""


class MissionStatus(StrEnum):
    """How a mission ended."""

    DONE = "done"
    NOT_DONE = "not_done"
    NOT_UNDERSTOOD = "not_understood"
    STOPPED = "stopped"


@dataclass(frozen=True, slots=True)
class Command:
    """A request that was understood: do `kind` to whatever `target` names."""

    kind: CommandKind
    target: str
    words: str
    source: str = ""
    """Where the thing is, by the words; empty if they do not say."""
    goal: str = ""
    """Where it is to go, by the words; empty if that is left to the verb."""
    purpose: str = ""
    """What it is for, by the words ("drink from"), which are in the target, too."""
    exceptions: tuple[str, ...] = ()
    """What is not meant: "anything but a banana"."""
    number: int = 0
    """How many things: `ALL` that there are; 0: as many as the target names."""
    among: tuple[str, ...] = ()
    """Names of which one is meant, or as many as the number says: "the hammer or the drill"."""
    superlative: str = ""
    """Which of them by a measure: "biggest"; empty if that was not said."""
    plural: bool = False
    """Whether all are meant, if there are several: "the fruits". No recording keeps this."""
    conditional: bool = False
    """Whether it is to be done only if there is such a thing, or what is `sought` is so."""
    sought: "Command | None" = None
    """Of a condition: what is to be looked for first; None: the thing itself."""
    unless: "Command | None" = None
    """What is to be done instead if there is none; None: nothing."""

    @property
    def is_plural(self) -> bool:
        """Whether several tasks have to be made of it, or one of several."""
        several = self.number > 1 or self.number == ALL or bool(self.among)
        return self.conditional or (several and self.kind.means.searches)


ALL = -1
"""As a number of things: each one that there is."""
Commands = tuple[tuple[Command, ...], ...]
"""Tasks in the order in which they are to be done; those of one tuple inside in any order."""

HELD = "it"
"""As a target: whatever the hand holds."""


@dataclass(frozen=True, slots=True)
class Candidate:
    """A place where the thing may be, who says so, and how likely (None where nobody said).

    `source` is one of `Source`, or the name of a `PlaceSource`.
    """

    place: str
    source: str
    probability: float | None = None

    def __str__(self) -> str:
        """The place, with its probability if there is one."""
        return self.place if self.probability is None else f"{self.place} {self.probability:.2f}"


@dataclass(frozen=True, slots=True)
class TaskOutcome:
    """What came of one of the tasks of a mission; its fields are as those of `Outcome`."""

    kind: CommandKind
    target: str
    object: str | None
    status: MissionStatus
    reason: str
    location: str | None
    goals: tuple[str, ...] = ()
    visited: tuple[str, ...] = ()
    things: tuple[str, ...] = ()
    """Of a question: the things that were seen, and are the answer to it."""
    among: tuple[str, ...] = ()
    """Of a question: the things that it was about."""
    parts: "tuple[TaskOutcome, ...]" = ()
    """Of a task with several things: what came of each that was begun."""
    put_at: str = ""
    """Where the thing was put down; empty if it was not."""


@dataclass(frozen=True, slots=True)
class Outcome:
    """One mission's result: what `--json` prints and `outcome.json` keeps.

    If there were several tasks, each is in `tasks`; `kind`, `target`, `object`, `source`,
    `location`, `candidates` and `goals` are those of the last one that was begun, and `done` is
    only said if all of them were.
    """

    command: str
    kind: CommandKind | None
    target: str | None
    object: str | None
    status: MissionStatus
    reason: str
    source: str | None
    location: str | None
    inquiries: int
    visited: tuple[str, ...]
    llm_calls: int
    candidates: tuple[Candidate, ...]
    mission_time_s: float
    thinking_time_s: float
    wall_time_s: float
    run_dir: str | None
    model_failure: str = ""
    """Why the language model was of no help, as a clause; empty if it was, or was not asked."""
    goals: tuple[str, ...] = ()
    """The furniture that would do as the place where the thing, or the robot, was to go."""
    tasks: tuple[TaskOutcome, ...] = ()
    """What came of each task, in the order in which they ended; those not begun come last."""


# --- space ---


@dataclass(frozen=True, slots=True)
class Pose:
    """A rigid transform: where a child frame is in its parent (metres, unit quaternion)."""

    position: Vector3 = (0.0, 0.0, 0.0)
    orientation: Quaternion = (0.0, 0.0, 0.0, 1.0)


@dataclass(frozen=True, slots=True)
class Place:
    """A piece of furniture that things may be on or in, as the home file names it."""

    name: str
    kind: str
    """Its class in the ontology: `Table`, `Cabinet`, `Shelf`, ..."""
    room: str
    """Name of the room that it stands in."""
    room_kind: str
    """The room's class in the ontology: `Kitchen`, `Bedroom`, ..."""
    label: str = ""
    """What the robot calls it ("Anna's desk"); empty: what its name says."""
    room_label: str = ""
    """The same of the room."""


@dataclass(frozen=True, slots=True)
class Thing:
    """An object that the home file declares, since no file of the ontology does."""

    name: str
    kind: str
    """Its class in the ontology: `Kitchenware`, `Toy`, ..."""
    color: str = ""
    """What its colour is called, one of `executive.colors.COLORS`; empty if nobody gave one."""


@dataclass(frozen=True, slots=True)
class Called:
    """What a thing or a piece of furniture is called when one speaks of it."""

    words: str
    """Without an article: "sugar box"."""
    plural: bool = False
    """Whether one says "are" of it, as of scissors."""
    bare: bool = False
    """Whether it has no article, as a class of things: "fruit"."""
    preposition: str = "on"
    """How things are with it, if it is furniture: "in" or "on"."""
    room: str = ""
    """What the room is called that it stands in; empty if the words say so, or it is a thing."""
    says_room: bool = False
    """Whether nobody would know it without the room."""


@dataclass(frozen=True, slots=True)
class OtherColor:
    """Things that are called as was said, and have none of the colours that were said."""

    wanted: tuple[str, ...]
    """The colours that were said."""
    actual: tuple[tuple[str, tuple[str, ...]], ...]
    """Each thing, and its own colours."""


# --- what the robot can be asked to do ---


HAND = "hand"
"""Where a thing is that the robot holds, for those who ask where it is."""
SOMETHING = "something"
"""In the hand, as far as the fingers feel, but nobody knows what."""
FLOOR = "floor"
"""The floor around the robot, wherever it is: a place to look at, for what fell from the hand."""


@dataclass(frozen=True, slots=True)
class DriveTo:
    """Go and stand before a piece of furniture, `person` or `delivery`."""

    place: str


@dataclass(frozen=True, slots=True)
class LookAt:
    """Point the head at a place, `delivery` or the `floor`.

    `view` counts from 0 to `Robot.views(place) - 1`. With a `point` of `map` (metres) given, that
    is in the middle of the picture instead.
    """

    place: str
    view: int = 0
    point: Vector3 | None = None


@dataclass(frozen=True, slots=True, eq=False)
class Pick:
    """Grasp the detected thing and lift it."""

    detection: "Detection"


@dataclass(frozen=True, slots=True)
class PutDown:
    """Place the held thing on a free spot of this place."""

    place: str


@dataclass(frozen=True, slots=True)
class Halt:
    """Come to rest, whatever is under way; a held thing stays held."""


Goal = DriveTo | LookAt | Pick | PutDown | Halt


# --- seeing ---


@dataclass(frozen=True, slots=True)
class Intrinsics:
    """A pinhole camera without distortion (pixels)."""

    width: int
    height: int
    fx: float
    fy: float
    cx: float
    cy: float

    def scaled(self, factor: float) -> "Intrinsics":
        """The same camera with so many times as many pixels in a row."""
        width, height = round(self.width * factor), round(self.height * factor)
        return Intrinsics(
            width, height, self.fx * factor, self.fy * factor, self.cx * factor, self.cy * factor
        )


@dataclass(frozen=True, slots=True, eq=False)
class Frame:
    """One picture: colour, depth, and where the camera was.

    Attributes:
        number: counts the pictures of one robot from 0.
        color: (height, width, 3) uint8, RGB.
        depth: (height, width) float32, metres along the optical axis; infinite where nothing is.
        intrinsics: the camera's.
        pose: `camera_optical` in `map`.
    """

    number: int
    color: "NDArray[np.uint8]"
    depth: "NDArray[np.float32]"
    intrinsics: Intrinsics
    pose: Pose

    @property
    def coming(self) -> bool:
        """Whether its pixels are still drawn elsewhere: who reads them waits for them."""
        return False


@dataclass(frozen=True, slots=True)
class Box:
    """A rectangle in an image (pixels, from the top left corner)."""

    left: int
    top: int
    width: int
    height: int


def _no_points() -> "NDArray[np.float32]":
    import numpy as np

    return np.empty((0, 3), dtype=np.float32)


@dataclass(frozen=True, slots=True, eq=False)
class Detection:
    """A thing recognised in a picture.

    Attributes:
        label: an object's name as in the ontology.
        confidence: in [0, 1].
        box: in the picture.
        mask: (box.height, box.width) bool, the thing's pixels inside the box.
        points: (n, 3) float32, its visible surface in `map` (metres); empty until located by depth.
        cut_off: whether it reaches the edge of the picture, so that there may be more of it.
    """

    label: str
    confidence: float
    box: Box
    mask: "NDArray[np.bool_]"
    points: "NDArray[np.float32]" = field(default_factory=_no_points)
    cut_off: bool = False

    @property
    def position(self) -> Vector3 | None:
        """Middle of the visible surface in `map` (metres), or None before it is located."""
        if not len(self.points):
            return None
        from numpy import median

        x, y, z = (float(v) for v in median(self.points, axis=0))
        return x, y, z


# --- talking ---


@dataclass(frozen=True, slots=True)
class Message:
    """One turn of a chat: role is `system`, `user` or `assistant`."""

    role: str
    content: str


@dataclass(frozen=True, slots=True)
class ChatRequest:
    """Ask the language model to write.

    `label` names the prompt (the paper's labels); `schema` is the JSON schema that the reply should
    follow, for models that can be held to one.
    """

    label: str
    messages: tuple[Message, ...]
    schema: dict[str, Any] | None = None


@dataclass(frozen=True, slots=True)
class Precedent:
    """A thing whose places are known: the question about it, and the right answers to that.

    `kind` is the class above it in the ontology; empty if there is none.
    """

    messages: tuple[Message, ...]
    places: tuple[str, ...]
    kind: str = ""


@dataclass(frozen=True, slots=True)
class RankRequest:
    """Ask the language model how likely each of `options` is as its next words.

    What counts is log P(option | messages) - log P(option | neutral): `neutral` is the same chat
    with the thing left open, so that what is merely a common phrase does not win; empty, it counts
    for nothing. `places` are the places that the options stand for, in the same order, and
    `place_kinds` their classes and rooms (empty: not known). A model that can tell which questions
    are alike takes the `precedents` into account; so are, a little, those about things of the same
    `kind`.
    """

    label: str
    messages: tuple[Message, ...]
    neutral: tuple[Message, ...]
    options: tuple[str, ...]
    places: tuple[str, ...]
    precedents: tuple[Precedent, ...] = ()
    kind: str = ""
    place_kinds: tuple[tuple[str, str], ...] = ()


@dataclass(frozen=True, slots=True)
class Usage:
    """What one call cost: tokens in (of them evaluated, the rest cached), tokens out, seconds.

    What was prepared for it, before it was asked and since the call before, is counted apart.
    """

    model: str = ""
    input_tokens: int = 0
    evaluated_tokens: int = 0
    output_tokens: int = 0
    first_token_s: float = 0.0
    total_s: float = 0.0
    prepared_tokens: int = 0
    prepared_s: float = 0.0
    parameters: dict[str, float | int | str] = field(default_factory=dict)


class QuestionKind(StrEnum):
    """What a question is after."""

    WHICH_OBJECT = "which_object"
    WHERE_IS = "where_is"
    CONFIRM = "confirm"
    WHERE_TO_PUT = "where_to_put"
    WHERE_TO_GO = "where_to_go"


@dataclass(frozen=True, slots=True)
class Question:
    """Something that only the person can say.

    `about` is the object or class in question; `options` are the known answers, if they are few,
    or the objects that it is about, if yes or no is the answer.
    """

    kind: QuestionKind
    about: str
    text: str
    options: tuple[str, ...] = ()


# --- what comes back: the end of anything that was started ---


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


@dataclass(frozen=True, slots=True)
class Verdict:
    """What is left of a reply's names after they were held against the ontology.

    `furniture` exists (and is allowed), in the order of the reply; `rooms` exist and have yet to
    be expanded into furniture; `dropped` are the names of nothing here.
    """

    furniture: tuple[str, ...]
    rooms: tuple[str, ...] = ()
    dropped: tuple[str, ...] = ()


Result = Succeeded | Failed | Saw | Replied | Scored | Answered
