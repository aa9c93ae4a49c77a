"""How a mission is put together: by the session that runs it, and by its replay."""

import math
from collections.abc import Callable
from dataclasses import dataclass

from executive.config import Settings
from executive.events import Inbox
from executive.guards import GuardedPerception, GuardedRecorder, GuardedRobot, GuardedUser
from executive.interfaces import (
    Advice,
    Clock,
    LanguageModel,
    Perception,
    PlaceSource,
    Recorder,
    Robot,
    User,
)
from executive.language.grammar import EnglishInterpreter
from executive.situation import Situation
from executive.types import DELIVERY, Vector3
from kb.advice.advisor import advise
from kb.advice.prompts import Prompts
from kb.facts import FactStore
from kb.ontology.ontology import Ontology
from sim.home.home import Furniture, Home
from trees.context import MissionContext, Parameters

OURS = "ours"
"""The policy of those who did not choose another."""
ANYTHING = "thing"
"""What the model prepares to be asked for."""


@dataclass(frozen=True)
class Grounds:
    """What a mission goes by, whoever runs it: the same when it is replayed."""

    settings: Settings
    home: Home
    """With everything where it was at the start."""
    knowledge: Ontology
    model: LanguageModel | None
    prompts: Prompts
    facts: FactStore
    sources: tuple[PlaceSource, ...] = ()


Advise = Callable[[Grounds], Advice | None]
"""Makes the adviser of a mission; None without a model."""


def build_advisor(grounds: Grounds) -> Advice | None:
    """Who puts questions to the model, which begins to prepare for them; None without a model."""
    if grounds.model is None:
        return None
    settings = grounds.settings
    advice = advise(
        grounds.knowledge,
        grounds.model,
        remembers=settings.remembers,
        top=settings.top,
        prompts=grounds.prompts,
        facts=grounds.facts,
    )
    ranks = settings.elicitation == "rank"
    ask = advice.ranker.ranking if ranks else advice.lister.inquiry
    grounds.model.prepare(ask(ANYTHING, ()))
    return advice


def build_context(
    grounds: Grounds,
    advice: Advice | None,
    situation: Situation,
    *,
    inbox: Inbox,
    clock: Clock,
    recorder: Recorder,
    robot: Robot,
    perception: Perception,
    user: User,
) -> MissionContext:
    """The collaborators of one mission; those that may be anybody's code, under guard.

    The model of the `grounds` is under guard already: its adviser asks it, too.
    """
    return MissionContext(
        situation=situation,
        clock=clock,
        recorder=GuardedRecorder(recorder),
        interpreter=EnglishInterpreter(),
        knowledge=grounds.knowledge,
        robot=GuardedRobot(robot, inbox, recorder),
        perception=GuardedPerception(perception, inbox, recorder),
        user=GuardedUser(user, inbox, recorder),
        model=grounds.model,
        advice=advice,
        parameters=parameters(grounds.settings),
        facts=grounds.facts,
        sources=grounds.sources,
        place_at=place_at(grounds),
        near_person=near_person(grounds.home),
    )


def parameters(settings: Settings) -> Parameters:
    """What the behaviours keep to."""
    return Parameters(
        elicit=settings.elicitation,
        top_k=settings.top,
        answer_s=settings.answer_timeout_s,
        model_s=settings.llm_timeout_s,
        action_s=settings.action_timeout_s,
        min_confidence=settings.sure,
    )


def place_at(grounds: Grounds) -> Callable[[Vector3], str | None]:
    """Where things are by the robot's map; in the instant world they have no true position."""
    if grounds.settings.world == "fake":
        return lambda point: None
    return lambda point: furniture_at(grounds.home, point)


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
