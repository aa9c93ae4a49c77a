"""Whom the behaviours work with, and by which parameters."""

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
    """Limits of patience and effort.

    Attributes:
        elicit: `generate` asks the model for a list (the paper), `rank` scores the known places.
        top_k: how many places of a ranking are worth a visit (the paper's prompt asks for 5).
        answer_s: how long to wait for the person (mission time, s).
        model_s: how long to wait for one call of the model (mission time, s).
        action_s: how long one action of the robot may take (mission time, s).
        min_confidence: from which a detection is believed and remembered; what may be the thing but
            is less sure is looked at more closely.
        grasps: how often the robot tries to grasp a thing, each time after another look.
        questions: how often an answer that makes no sense is followed by the question again.
        search: `plan` weighs looking against asking, `paper` has the paper's stages.
        question_s: what a question to the person costs, and
        visit_s: what a visit costs beside its time, both in seconds of searching.
        look_s: how long a look at one view of a place takes (s).
        planned: among so many places it is planned, the likeliest; the others come in when those
            are done.
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
    """The collaborators of a mission; no `model` and `advice` for the system without an LLM.

    `place_at` tells on which furniture a point of `map` is (None: on none, or nobody can tell).
    `blind_to` are known objects that perception would not recognise. A robot without an arm
    (`has_arm`) takes nothing.
    `experience` is what was learned of where things are, if anything is kept to learn from.
    The `sources` know where things are without looking; they are asked in this order, after memory.
    `near_person` is the furniture by the person, the nearest first, where things may be put down if
    the delivery table has no room; `handiest` is all furniture, that where things are put down most
    easily first. `pending` is what the behaviours wait for: the loop that ticks them has to be
    given the same. `standby` is how they wait for somebody who was not asked.
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
        """A part of the command that was read, as the person said it."""
        return as_said(self.situation.request.words, words)

    @property
    def say(self) -> Wording:
        """Words for the names of things and places."""
        return Wording(self.knowledge.called)
