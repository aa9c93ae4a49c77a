"""robot-executive: a behaviour-tree executive for home robots.

The typical use: say with what, then say what.

    from executive import Session, load_settings

    with Session(load_settings(world="fake", user="oracle")) as robot:
        outcome = robot.run("Bring a sugar_box")

This file is the library's table of contents. Nothing is imported before its name is used, so that
`import executive` costs nothing and needs neither simulator nor model.

    run missions         Session, Settings, load_settings, KnowledgeSystem
    what came of it      Outcome, MissionStatus, Source
    to be implemented    Robot, Camera, Detector, Perception, LanguageModel, User, PlaceSource,
                         Clock, Sink
    a robot of one's own Setup, Embodiment
    how slow things end  Inbox, StopRequested
    what a robot is told Goal: DriveTo, LookAt, Pick, PutDown, Halt; DELIVERY, FLOOR
    what may come back   Result: Succeeded, Failed, Saw, Replied, Scored, Answered
    seeing               CameraPerception, Frame, Intrinsics, Pose, Detection, Box
    language             ChatRequest, RankRequest, Message, Usage
    the person           Question, QuestionKind
    telling the logs     Recorder
    errors               ExecutiveError, InputError, ModelError

Recorded missions run again by `from executive.replay import replay`: the function would hide its
own package here. Conformance suites for what is to be implemented are in `executive.testing`.
"""

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from executive.app.embodiment import Embodiment, Setup
    from executive.app.session import Session
    from executive.config import KnowledgeSystem, Settings, load_settings
    from executive.errors import ExecutiveError, InputError, ModelError
    from executive.events import Inbox, StopRequested
    from executive.interfaces import (
        Camera,
        Clock,
        Detector,
        LanguageModel,
        Perception,
        PlaceSource,
        Recorder,
        Robot,
        User,
    )
    from executive.perception.pipeline import CameraPerception
    from executive.types import (
        DELIVERY,
        FLOOR,
        Answered,
        Box,
        ChatRequest,
        Detection,
        DriveTo,
        Failed,
        Frame,
        Goal,
        Halt,
        Intrinsics,
        LookAt,
        Message,
        MissionStatus,
        Outcome,
        Pick,
        Pose,
        PutDown,
        Question,
        QuestionKind,
        RankRequest,
        Replied,
        Result,
        Saw,
        Scored,
        Source,
        Succeeded,
        Usage,
    )
    from logs.recorder import Sink

__all__ = [
    "DELIVERY",
    "FLOOR",
    "Answered",
    "Box",
    "Camera",
    "CameraPerception",
    "ChatRequest",
    "Clock",
    "Detection",
    "Detector",
    "DriveTo",
    "Embodiment",
    "ExecutiveError",
    "Failed",
    "Frame",
    "Goal",
    "Halt",
    "Inbox",
    "InputError",
    "Intrinsics",
    "KnowledgeSystem",
    "LanguageModel",
    "LookAt",
    "Message",
    "MissionStatus",
    "ModelError",
    "Outcome",
    "Perception",
    "Pick",
    "PlaceSource",
    "Pose",
    "PutDown",
    "Question",
    "QuestionKind",
    "RankRequest",
    "Recorder",
    "Replied",
    "Result",
    "Robot",
    "Saw",
    "Scored",
    "Session",
    "Settings",
    "Setup",
    "Sink",
    "Source",
    "StopRequested",
    "Succeeded",
    "Usage",
    "User",
    "load_settings",
]

_ELSEWHERE = {
    "CameraPerception": "executive.perception.pipeline",
    "Embodiment": "executive.app.embodiment",
    "ExecutiveError": "executive.errors",
    "Inbox": "executive.events",
    "InputError": "executive.errors",
    "KnowledgeSystem": "executive.config",
    "ModelError": "executive.errors",
    "Session": "executive.app.session",
    "Settings": "executive.config",
    "Setup": "executive.app.embodiment",
    "Sink": "logs.recorder",
    "StopRequested": "executive.events",
    "load_settings": "executive.config",
    **dict.fromkeys(
        (
            "Camera",
            "Clock",
            "Detector",
            "LanguageModel",
            "Perception",
            "PlaceSource",
            "Recorder",
            "Robot",
            "User",
        ),
        "executive.interfaces",
    ),
}
"""The module of each name that is not in `executive.types`."""


def __getattr__(name: str) -> object:
    """Import what is asked for (PEP 562)."""
    if name not in __all__:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    value = getattr(import_module(_ELSEWHERE.get(name, "executive.types")), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    """What there is, imported or not."""
    return sorted({*globals(), *__all__})
