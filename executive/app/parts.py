"""What missions are made of, and how one is made of it: for all who run, replay or draw them."""

import math
from collections.abc import Callable
from dataclasses import dataclass, field, replace

from executive.config import Settings
from executive.events import Inbox
from executive.guards import (
    GuardedExperience,
    GuardedModel,
    GuardedPerception,
    GuardedRecorder,
    GuardedRobot,
    GuardedSource,
    GuardedUser,
)
from executive.interfaces.dialogue import Interpreter, User
from executive.interfaces.knowledge import Experience, Facts, PlaceSource
from executive.interfaces.llm import Advice, LanguageModel
from executive.interfaces.perception import Perception
from executive.interfaces.robot import Robot
from executive.interfaces.runtime import Clock, Recorder, Tree
from executive.language.grammar import EnglishInterpreter
from executive.loop import Executive
from executive.situation import Situation
from executive.standby import Standby
from executive.types.geometry import Vector3
from executive.types.home import DELIVERY
from kb.advice.advisor import advise
from kb.advice.prompts import Prompts
from kb.ontology.ontology import Ontology
from sim.home.furniture import Furniture
from sim.home.home import Home
from trees.context import MissionContext, NoFacts, Parameters
from trees.mission import mission
from trees.tree import MissionTree

OURS = "ours"
"""The policy of those who did not choose another."""


@dataclass(frozen=True)
class Parts:
    """Every collaborator of missions; they outlive one, and serve the next.

    To put in another one, `replace(parts, robot=mine)`. What may be anybody's code comes under
    guard when a mission is made.

    Attributes:
        settings: what all else was built by.
        home: the robot's map, with everything where it was at the start.
        knowledge: the ontology; the adviser looks deeper into it than the tree does.
        prompts: the texts that the adviser writes with.
        in_map: whether perception tells where in `map` things are, so that the home's plan says
            on which furniture.
        parameters: what the behaviours keep to.
    """

    settings: Settings
    home: Home
    inbox: Inbox
    clock: Clock
    recorder: Recorder
    robot: Robot
    perception: Perception
    user: User
    knowledge: Ontology
    model: LanguageModel | None = None
    advice: Advice | None = None
    prompts: Prompts | None = None
    facts: Facts = NoFacts()
    experience: Experience | None = None
    sources: tuple[PlaceSource, ...] = ()
    interpreter: Interpreter = field(default_factory=EnglishInterpreter)
    in_map: bool = False
    blind_to: tuple[str, ...] = ()
    """Objects of the home that perception would not recognise."""
    has_arm: bool = True
    """Whether the robot can take things."""
    parameters: Parameters = Parameters()


HANDY_M = (0.6, 1.1)
"""Heights of a surface that are most easily reached from above (metres), as tables have them."""

Change = Callable[[Parts], Parts]
"""Puts other parts in, as a policy does."""


def as_they_are(parts: Parts) -> Parts:
    """Change nothing."""
    return parts


def advised(parts: Parts) -> Parts:
    """With our adviser, who puts questions to the model; with none if there is no model."""
    if parts.model is None:
        return replace(parts, advice=None)
    model = guarded_model(parts, parts.model)
    advice = build_advice(parts.settings, parts.knowledge, model, parts.prompts, parts.facts)
    return replace(parts, advice=advice)


def build_advice(
    settings: Settings,
    knowledge: Ontology,
    model: LanguageModel,
    prompts: Prompts | None,
    facts: Facts,
) -> Advice:
    """Our adviser, as the settings have it."""
    return advise(
        knowledge,
        model,
        remembers=settings.remembers,
        top=settings.top,
        prompts=prompts,
        facts=facts,
    )


def guarded_model(parts: Parts, model: LanguageModel) -> LanguageModel:
    """A model under guard."""
    return GuardedModel(model, parts.inbox, parts.recorder)


# --- a mission ---


Build = Callable[[MissionContext], Tree]
"""Makes the tree of a mission."""


def mission_tree(context: MissionContext) -> Tree:
    """The tree that missions are run with."""
    return MissionTree(mission(context))


def build_mission(parts: Parts, situation: Situation, build: Build = mission_tree) -> Executive:
    """One mission of these parts, ready to run; `build` makes the tree."""
    context = build_context(parts, situation)
    return Executive(
        build(context),
        situation,
        pending=context.pending,
        inbox=parts.inbox,
        clock=parts.clock,
        robot=parts.robot,
        recorder=parts.recorder,
    )


def build_context(parts: Parts, situation: Situation) -> MissionContext:
    """Whom the behaviours of one mission work with: the parts, under guard."""
    inbox, recorder = parts.inbox, parts.recorder
    return MissionContext(
        situation=situation,
        clock=parts.clock,
        recorder=GuardedRecorder(recorder),
        interpreter=parts.interpreter,
        knowledge=parts.knowledge,
        robot=GuardedRobot(parts.robot, inbox, recorder),
        perception=GuardedPerception(parts.perception, inbox, recorder),
        user=GuardedUser(parts.user, inbox, recorder),
        standby=Standby(inbox),
        model=guarded_model(parts, parts.model) if parts.model else None,
        advice=parts.advice,
        parameters=parts.parameters,
        facts=parts.facts,
        experience=GuardedExperience(parts.experience, recorder) if parts.experience else None,
        sources=tuple(GuardedSource(source, recorder) for source in parts.sources),
        place_at=place_at(parts),
        near_person=near_person(parts.home),
        handiest=handiest(parts.home),
        blind_to=parts.blind_to,
        has_arm=parts.has_arm,
    )


def parameters_of(settings: Settings) -> Parameters:
    """What the behaviours keep to."""
    return Parameters(
        elicit=settings.elicitation,
        top_k=settings.top,
        answer_s=settings.answer_timeout_s,
        model_s=settings.llm_timeout_s,
        action_s=settings.action_timeout_s,
        min_confidence=settings.sure,
        search=settings.search,
        question_s=settings.question_s,
    )


def place_at(parts: Parts) -> Callable[[Vector3], str | None]:
    """Where things are by the robot's map, if perception tells their positions in it."""
    if not parts.in_map:
        return lambda point: None
    return lambda point: furniture_at(parts.home, point)


def furniture_at(home: Home, point: Vector3) -> str | None:
    """The furniture that has this point of `map` (metres) above its outline; None if none has."""
    pieces = (*home.furniture, home.delivery)
    return next((piece.name for piece in pieces if piece.is_below(point)), None)


def near_person(home: Home) -> tuple[str, ...]:
    """The furniture by the delivery table: that of its room, then the other, the nearest first."""
    here = home.stand(DELIVERY)[:2]

    def far(piece: Furniture) -> tuple[bool, float]:
        return piece.room != home.delivery.room, math.dist(here, home.stand(piece.name)[:2])

    return tuple(piece.name for piece in sorted(home.furniture, key=far))


def handiest(home: Home) -> tuple[str, ...]:
    """The furniture by how easily things are put down there: open, at hand's height, and large."""

    def hard(piece: Furniture) -> tuple[bool, bool, float]:
        surface = piece.surfaces()[0]
        at_hand = HANDY_M[0] <= surface.center[2] <= HANDY_M[1]
        return surface.clearance < math.inf, not at_hand, -surface.length_x * surface.length_y

    return tuple(piece.name for piece in sorted(home.furniture, key=hard))
