"""robot-executive: a behaviour-tree executive for home robots.

Typical use: choose the settings, then give a command.

    from executive import Session, load_settings

    with Session(load_settings(world="fake", user="oracle")) as robot:
        outcome = robot.run("Bring a sugar_box")

This file is the library's table of contents. A name is imported when it is first used, so that
`import executive` costs nothing and needs neither simulator nor model.

    run missions         Session, Settings, load_settings, KnowledgeSystem
    their outcomes       Outcome, MissionStatus, Source
    to implement         Robot, Camera, Detector, Perception, LanguageModel, User, PlaceSource,
                         Clock, Sink
    your own robot       Setup, Embodiment
    events               Inbox, StopRequested
    goals of a robot     Goal: DriveTo, LookAt, Pick, PutDown, Halt; DELIVERY, FLOOR
    results of requests  Result: Succeeded, Failed, Saw, Replied, Scored, Answered
    perception           CameraPerception, Frame, Intrinsics, Pose, Detection, Box
    language             ChatRequest, RankRequest, Message, Usage
    the person           Question, QuestionKind
    the log              Recorder
    errors               ExecutiveError, InputError, ModelError

To replay recorded missions, use `from executive.replay import replay`: here, the function would
hide its own package. Conformance suites for your implementations are in `executive.testing`.
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
"""The names that each module provides."""


def __getattr__(name: str) -> object:
    """Import a name when it is first used (PEP 562)."""
    for module, names in _MODULES.items():
        if name in names:
            value = globals()[name] = getattr(import_module(module), name)
            return value
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    """All names, imported or not."""
    return sorted({*globals(), *__all__})
