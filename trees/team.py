"""Whom the behaviours work with, and by which rules."""

from dataclasses import dataclass

from executive.interfaces import (
    Advisor,
    Clock,
    Eyes,
    Interpreter,
    Knowledge,
    LanguageModel,
    Recorder,
    Robot,
    User,
)
from executive.situation import Situation


@dataclass(frozen=True, slots=True)
class Rules:
    """Limits of patience and effort.

    Attributes:
        elicit: `generate` asks the model for a list (the paper), `rank` scores the known places.
        top: how many places of a ranking are worth a visit (the paper's prompt asks for 5).
        answer_s: how long to wait for the person (mission time, s).
        model_s: how long to wait for one call of the model (mission time, s).
        action_s: how long one action of the robot may take (mission time, s).
        questions: how often an answer that makes no sense is followed by the question again.
    """

    elicit: str = "rank"
    top: int = 5
    answer_s: float = 120.0
    model_s: float = 60.0
    action_s: float = 120.0
    questions: int = 3


@dataclass(frozen=True, slots=True)
class Team:
    """The collaborators of a mission; no `model` and `advisor` for the system without an LLM."""

    situation: Situation
    clock: Clock
    recorder: Recorder
    interpreter: Interpreter
    knowledge: Knowledge
    robot: Robot
    eyes: Eyes
    user: User
    model: LanguageModel | None = None
    advisor: Advisor | None = None
    rules: Rules = Rules()
