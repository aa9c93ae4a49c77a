"""Records that are shown as a line in the viewer's log."""

from executive.records import (
    Intervention,
    Mishap,
    Note,
    Planned,
    Recalled,
    SourceAnswer,
    WaysTold,
)

Line = Intervention | Mishap | Note | Planned | Recalled | SourceAnswer | WaysTold

_LEVELS = {"debug": "DEBUG", "info": "INFO", "warning": "WARN", "error": "ERROR"}
"""rerun's names for the levels of a note."""


def line(record: Line) -> tuple[str, str]:
    """The level (rerun's name) and the text."""
    match record:
        case Note(level, text):
            return _LEVELS[level], text
        case Planned(text=text):
            return "INFO", text
        case Mishap(fault, text):
            return "WARN", f"{fault}: {text}"
        case Intervention(by, deed, was, became):
            return "WARN", f"{by}: {deed}: {was} -> {became}"
        case SourceAnswer(source, thing, places):
            return "DEBUG", f"{source}: {thing}: {', '.join(places) or 'not known'}"
        case Recalled(thing, places=places, says=says):
            said = (f"{place} ({who})" for place, who in zip(places, says, strict=True))
            return "DEBUG", f"learned of {thing}: {', '.join(said) or 'nothing'}"
        case WaysTold(start, places):
            return "DEBUG", f"ways from {start} to {', '.join(places)}"
