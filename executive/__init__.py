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
    from executive.interfaces.dialogue import User
    from executive.interfaces.knowledge import PlaceSource
    from executive.interfaces.llm import LanguageModel
    from executive.interfaces.perception import Camera, Detector, Perception
    from executive.interfaces.robot import Robot
    from executive.interfaces.runtime import Clock, Recorder
    from executive.perception.pipeline import CameraPerception
    from executive.types.dialogue import Question, QuestionKind
    from executive.types.geometry import Pose
    from executive.types.goals import DriveTo, Goal, Halt, LookAt, Pick, PutDown
    from executive.types.home import DELIVERY, FLOOR
    from executive.types.knowledge import Source
    from executive.types.llm import ChatRequest, Message, RankRequest, Usage
    from executive.types.outcome import MissionStatus, Outcome
    from executive.types.perception import Box, Detection, Frame, Intrinsics
    from executive.types.results import Answered, Failed, Replied, Result, Saw, Scored, Succeeded
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

_MODULES = {
    "executive.app.embodiment": ("Embodiment", "Setup"),
    "executive.app.session": ("Session",),
    "executive.config": ("KnowledgeSystem", "Settings", "load_settings"),
    "executive.errors": ("ExecutiveError", "InputError", "ModelError"),
    "executive.events": ("Inbox", "StopRequested"),
    "executive.interfaces.dialogue": ("User",),
    "executive.interfaces.knowledge": ("PlaceSource",),
    "executive.interfaces.llm": ("LanguageModel",),
    "executive.interfaces.perception": ("Camera", "Detector", "Perception"),
    "executive.interfaces.robot": ("Robot",),
    "executive.interfaces.runtime": ("Clock", "Recorder"),
    "executive.perception.pipeline": ("CameraPerception",),
    "executive.types.dialogue": ("Question", "QuestionKind"),
    "executive.types.geometry": ("Pose",),
    "executive.types.goals": ("DriveTo", "Goal", "Halt", "LookAt", "Pick", "PutDown"),
    "executive.types.home": ("DELIVERY", "FLOOR"),
    "executive.types.knowledge": ("Source",),
    "executive.types.llm": ("ChatRequest", "Message", "RankRequest", "Usage"),
    "executive.types.outcome": ("MissionStatus", "Outcome"),
    "executive.types.perception": ("Box", "Detection", "Frame", "Intrinsics"),
    "executive.types.results": (
        "Answered",
        "Failed",
        "Replied",
        "Result",
        "Saw",
        "Scored",
        "Succeeded",
    ),
    "logs.recorder": ("Sink",),
}
"""The names of each module."""


def __getattr__(name: str) -> object:
    """Import what is asked for (PEP 562)."""
    for module, names in _MODULES.items():
        if name in names:
            value = globals()[name] = getattr(import_module(module), name)
            return value
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    """What there is, imported or not."""
    return sorted({*globals(), *__all__})
