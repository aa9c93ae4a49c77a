"""The state of a mission, in parts: behaviours read and write it, and the log keeps it."""

from executive.situation.agenda import Agenda, Task, Whole
from executive.situation.before import FIRST, Before
from executive.situation.belief import Leg
from executive.situation.ending import TAKEN_BACK, Ending
from executive.situation.hand import Hand
from executive.situation.search import Consultation, candidates_from
from executive.situation.situation import Situation
from executive.situation.steering import Choice, For, Steering

__all__ = [
    "FIRST",
    "TAKEN_BACK",
    "Agenda",
    "Before",
    "Choice",
    "Consultation",
    "Ending",
    "For",
    "Hand",
    "Leg",
    "Situation",
    "Steering",
    "Task",
    "Whole",
    "candidates_from",
]
