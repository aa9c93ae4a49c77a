"""What a mission knows so far, in parts: what behaviours read and write, and the log keeps."""

from executive.situation.ending import Ending
from executive.situation.hand import Hand
from executive.situation.search import Consultation, candidates_from
from executive.situation.situation import Situation

__all__ = ["Consultation", "Ending", "Hand", "Situation", "candidates_from"]
