"""What every behaviour of a mission gets: its collaborators and its parameters."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field

from executive.interfaces.dialogue import Interpreter, User
from executive.interfaces.knowledge import Experience, Facts, Knowledge, PlaceSource
from executive.interfaces.llm import Advice, LanguageModel
from executive.interfaces.perception import Perception
from executive.interfaces.robot import Robot
from executive.interfaces.runtime import Clock, Recorder
from executive.language.wording import Wording, as_said
from executive.pending import Pending
from executive.situation import Situation
from executive.standby import Standby
from executive.types.geometry import Vector3


@dataclass(frozen=True, slots=True)
class Parameters:
    """Timeouts, limits and costs.

    Attributes:
        elicit: `generate` asks the model for a list (the paper), `rank` scores the known places.
        top_k: how many places of a ranking are worth a visit (the paper's prompt asks for 5).
        answer_s: how long to wait for the person (mission time, s).
        model_s: how long to wait for one call of the model (mission time, s).
        action_s: how long one action of the robot may take (mission time, s).
        min_confidence: detections of at least this confidence are believed and remembered; at
            what may be the thing with less, the robot takes a closer look.
        grasps: how often the robot tries to grasp a thing; it looks again before each try.
        questions: how often a question is put if the answers make no sense.
        search: `plan` weighs looking against asking, `paper` has the paper's stages.
        question_s: the cost of a question to the person (seconds of searching).
        visit_s: the cost of a visit in addition to its duration (seconds of searching).
        look_s: how long a look at one view of a place takes (s).
        planned: how many of the likeliest places a plan considers; the others follow when the
            robot has looked there.
    """

    elicit: str = "rank"
    top_k: int = 5
    answer_s: float = 120.0
    model_s: float = 60.0
    action_s: float = 120.0
    min_confidence: float = 0.5
    grasps: int = 3
    questions: int = 3
    search: str = "plan"
    question_s: float = 60.0
    visit_s: float = 0.0
    look_s: float = 0.5
    planned: int = 60


class NoFacts:
    """Implements `Facts`: remembers nothing."""

    def saw(self, names: Iterable[str], place: str) -> None:
        """Forget it."""

    def missed(self, name: str, place: str) -> None:
        """Forget it."""

    def heard(self, name: str, places: Iterable[str]) -> None:
        """Forget it."""

    def heard_not(self, name: str, places: Iterable[str]) -> None:
        """Forget it."""

    def took(self, name: str, place: str) -> None:
        """Forget it."""

    def put(self, name: str, place: str) -> None:
        """Forget it."""

    def looked(self, place: str) -> None:
        """Forget it."""

    def places_of(self, name: str) -> tuple[str, ...]:
        """Nowhere."""
        return ()

    def beliefs(self) -> dict[str, tuple[str, ...]]:
        """None."""
        return {}

    def places_denied(self, name: str) -> tuple[str, ...]:
        """Nowhere."""
        return ()

    def denials(self) -> dict[str, tuple[str, ...]]:
        """None."""
        return {}

    def origins(self) -> dict[str, tuple[str, ...]]:
        """None."""
        return {}


@dataclass(frozen=True, slots=True)
class MissionContext:
    """The collaborators of one mission.

    Attributes:
        standby: waits for what a person may do unasked.
        model: None in a system without a language model, and then `advice` is, too.
        experience: what was learned about where things are; None if nothing is kept to learn from.
        sources: what knows places without looking; asked in this order, after the memory.
        place_at: the furniture on which a point of `map` (metres) is; None if there is none, or
            nobody can tell.
        near_person: the furniture near the person, the nearest first: where things are put down
            if the delivery table is full.
        handiest: all furniture, first where things are put down most easily.
        blind_to: known objects that perception would not recognise.
        has_arm: whether the robot can take things.
        pending: what the behaviours wait for; the loop that ticks them must be given the same.
    """

    situation: Situation
    clock: Clock
    recorder: Recorder
    interpreter: Interpreter
    knowledge: Knowledge
    robot: Robot
    perception: Perception
    user: User
    standby: Standby
    model: LanguageModel | None = None
    advice: Advice | None = None
    parameters: Parameters = Parameters()
    facts: Facts = NoFacts()
    experience: Experience | None = None
    sources: tuple[PlaceSource, ...] = ()
    place_at: Callable[[Vector3], str | None] = lambda point: None
    near_person: tuple[str, ...] = ()
    handiest: tuple[str, ...] = ()
    blind_to: tuple[str, ...] = ()
    has_arm: bool = True
    pending: Pending = field(default_factory=Pending)

    def as_said(self, words: str) -> str:
        """A part of the command, in the spelling that the person used."""
        return as_said(self.situation.request.words, words)

    @property
    def say(self) -> Wording:
        """Turns names of things and places into words for the person."""
        return Wording(self.knowledge.called)
