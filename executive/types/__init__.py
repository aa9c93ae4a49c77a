"""The data types of the executive: immutable values with their units and frames.

Frames follow REP-103 and REP-105: metres, radians, x forward, y left, z up; `map` is fixed to the
home, `base_link` to the robot, `camera_optical` to the camera (x right, y down, z forward).
Quaternions are (x, y, z, w).
"""

from executive.types.commands import ALL, HELD, SEARCHING, Command, CommandKind, Commands, Meaning
from executive.types.dialogue import Question, QuestionKind
from executive.types.geometry import Pose, Quaternion, Vector3
from executive.types.goals import DriveTo, Goal, Halt, LookAt, Pick, PutDown
from executive.types.home import (
    DELIVERY,
    FLOOR,
    HAND,
    PERSON,
    SOMETHING,
    Called,
    OtherColor,
    Place,
    Thing,
)
from executive.types.knowledge import Candidate, Source, Verdict
from executive.types.llm import ChatRequest, Message, Precedent, RankRequest, Usage
from executive.types.outcome import MissionStatus, Outcome, TaskOutcome
from executive.types.perception import Box, Detection, Frame, Intrinsics
from executive.types.results import Answered, Failed, Replied, Result, Saw, Scored, Succeeded

__all__ = [
    "ALL",
    "Answered",
    "Box",
    "Called",
    "Candidate",
    "ChatRequest",
    "Command",
    "CommandKind",
    "Commands",
    "DELIVERY",
    "Detection",
    "DriveTo",
    "FLOOR",
    "Failed",
    "Frame",
    "Goal",
    "HAND",
    "HELD",
    "Halt",
    "Intrinsics",
    "LookAt",
    "Meaning",
    "Message",
    "MissionStatus",
    "OtherColor",
    "Outcome",
    "PERSON",
    "Pick",
    "Place",
    "Pose",
    "Precedent",
    "PutDown",
    "Quaternion",
    "Question",
    "QuestionKind",
    "RankRequest",
    "Replied",
    "Result",
    "SEARCHING",
    "SOMETHING",
    "Saw",
    "Scored",
    "Source",
    "Succeeded",
    "TaskOutcome",
    "Thing",
    "Usage",
    "Vector3",
    "Verdict",
]
