"""What an experimenter did, in words."""

from executive.events import OFF, ON, Deed, Intervened
from executive.records import Intervention

EXPERIMENTER = "experimenter"
"""The source of such a decision, in place of a `Source`."""

HELD = {
    (Deed.HOLD, ON): "what the robot says is held",
    (Deed.HOLD, OFF): "what the robot says is held no more",
    (Deed.HOLD_PLACE, ON): "the places that the robot chooses are held",
    (Deed.HOLD_PLACE, OFF): "the places that the robot chooses are held no more",
}


def done(deed: Intervention | Intervened) -> str:
    """What was done, as a clause without a subject."""
    was, became = deed.was, deed.became
    match deed.deed:
        case Deed.ANSWER:
            return f"answered '{was}': {became}"
        case Deed.HOLD | Deed.HOLD_PLACE:
            held = HELD.get((Deed(deed.deed), became), became)
            return f"{held}: {was}" if was else held
        case Deed.WORDS if not became:
            return f"never said: '{was}'"
        case Deed.WORDS:
            return f"said: '{became}'" + (f", for '{was}'" if became != was else "")
        case Deed.PLACE:
            return f"to {became}" + (f", not {was}" if became != was else ", as it was chosen")
        case Deed.STOP:
            return "stop"
        case other:
            return " ".join(filter(None, (other, was, became)))
