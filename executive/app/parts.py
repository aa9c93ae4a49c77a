"""The composition: the parts of missions, and how a mission is built from them.

Session, replay, the drawing of trees and the tests' bench all build missions here.
"""

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
"""The name of the default policy."""


@dataclass(frozen=True)
class Parts:
    """The collaborators of all missions of a session.

    To use another one, `replace(parts, robot=mine)`. Parts that may be code of others are wrapped
    in a guard (`executive.guards`) when a mission is built.

    Attributes:
        settings: what all other parts were built from.
        home: the robot's map, and where everything was at the start.
        knowledge: the ontology; the adviser uses more of it than the protocol `Knowledge` has.
        prompts: the texts of the adviser's prompts.
        in_map: whether detections have a position in `map`, from which the home's plan tells the
            furniture.
        blind_to: objects of the home that perception would not recognise.
        has_arm: whether the robot can take things.
        parameters: timeouts, limits and costs for the behaviours.
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
    has_arm: bool = True
    parameters: Parameters = Parameters()


HANDY_M = (0.6, 1.1)
"""Lowest and highest surface that is easily reached from above (metres): heights of tables."""

Change = Callable[[Parts], Parts]
"""Replaces parts, as a policy does."""


def as_they_are(parts: Parts) -> Parts:
    """Change nothing."""
    return parts


def advised(parts: Parts) -> Parts:
    """The same parts with our adviser for their model; without one if there is no model."""
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
    """Our adviser, which puts questions to the model as the settings say."""
    return advise(
        knowledge,
        model,
        remembers=settings.remembers,
        top=settings.top,
        prompts=prompts,
        facts=facts,
    )


def guarded_model(parts: Parts, model: LanguageModel) -> LanguageModel:
    """The model, wrapped in a guard."""
    return GuardedModel(model, parts.inbox, parts.recorder)


# --- a mission ---


Build = Callable[[MissionContext], Tree]
"""Makes the tree of one mission."""


def mission_tree(context: MissionContext) -> Tree:
    """The usual tree of a mission."""
    return MissionTree(mission(context))


def build_mission(parts: Parts, situation: Situation, build: Build = mission_tree) -> Executive:
    """One mission with these parts, ready to run; `build` makes its tree."""
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
    """The context of one mission's behaviours: the parts, those of others under guard."""
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
    """The settings that the behaviours need."""
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
    """A function from points of `map` to furniture; it finds none if points are not in `map`."""
    if not parts.in_map:
        return lambda point: None
    return lambda point: furniture_at(parts.home, point)


def furniture_at(home: Home, point: Vector3) -> str | None:
    """The furniture whose outline is below this point of `map` (metres); None if there is none."""
    pieces = (*home.furniture, home.delivery)
    return next((piece.name for piece in pieces if piece.is_below(point)), None)


def near_person(home: Home) -> tuple[str, ...]:
    """All furniture: first that of the delivery table's room, then the other.

    Each group is sorted by the straight distance from where the robot stands at that table.
    """
    here = home.stand(DELIVERY)[:2]

    def far(piece: Furniture) -> tuple[bool, float]:
        return piece.room != home.delivery.room, math.dist(here, home.stand(piece.name)[:2])

    return tuple(piece.name for piece in sorted(home.furniture, key=far))


def handiest(home: Home) -> tuple[str, ...]:
    """All furniture, first where things are put down most easily: open above, at hand, large."""

    def hard(piece: Furniture) -> tuple[bool, bool, float]:
        surface = piece.surfaces()[0]
        at_hand = HANDY_M[0] <= surface.center[2] <= HANDY_M[1]
        return surface.clearance < math.inf, not at_hand, -surface.length_x * surface.length_y

    return tuple(piece.name for piece in sorted(home.furniture, key=hard))
