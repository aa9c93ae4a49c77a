"""All interfaces of the system. An adapter for a real robot, camera or model implements one.

All slow work is asynchronous: the method that starts it returns a request number at once, the
result comes as an `Ended` event with that number, and `cancel` aborts it. Only `Clock.wait`
blocks.
"""

from executive.interfaces.dialogue import Interpreter, User
from executive.interfaces.knowledge import Experience, Facts, Knowledge, PlaceSource
from executive.interfaces.llm import Advice, CommandReader, LanguageModel, PlaceLister, PlaceRanker
from executive.interfaces.perception import Camera, Detector, Perception
from executive.interfaces.robot import Robot
from executive.interfaces.runtime import Clock, Recorder, Tree
from executive.interfaces.simulation import SimulatedHome, World

__all__ = [
    "Advice",
    "Camera",
    "Clock",
    "CommandReader",
    "Detector",
    "Experience",
    "Facts",
    "Interpreter",
    "Knowledge",
    "LanguageModel",
    "Perception",
    "PlaceLister",
    "PlaceRanker",
    "PlaceSource",
    "Recorder",
    "Robot",
    "SimulatedHome",
    "Tree",
    "User",
    "World",
]
