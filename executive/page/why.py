"""Why the robot said a sentence: the decisions of its mission up to then, from the recording."""

from dataclasses import asdict
from pathlib import Path
from typing import Any

from executive.errors import InputError
from logs.questions.why import NOT_NEEDED, why
from logs.recording.reader import Run

EPSILON_S = 0.002
"""Mission times are rounded on the page."""


def why_said(run: Path, time_s: float) -> list[dict[str, Any]]:
    """The decisions that were settled when it was said, the latest first.

    What is being recorded is read as far as it goes.

    Raises:
        InputError: if there is no such recording, or nothing in it yet.
    """
    try:
        settled = [d for d in why(Run(run)) if d.time_s <= time_s + EPSILON_S]
    except OSError as error:
        raise InputError(str(run), f"cannot be read: {error.strerror}") from None
    chain = [asdict(decision) for decision in reversed(settled)]
    for decision in chain:
        others = decision["alternatives"]
        decision["alternatives"] = [a for a in others if a["why_not"] != NOT_NEEDED]
    return chain
