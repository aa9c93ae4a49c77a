"""Why the robot said a sentence: the decisions of its mission up to then, from the recording."""

import time
from dataclasses import asdict
from pathlib import Path
from typing import Any

from executive.errors import InputError
from executive.records import Tick, Utterance
from logs.questions.decision import NOT_NEEDED
from logs.questions.interventions import EXPERIMENTER
from logs.questions.why import why
from logs.recording.reader import Run

EPSILON_S = 0.002
"""Mission times are rounded on the page."""
WRITTEN_S = 2.0
"""What is recorded is on the disk so soon, on a busy machine, too."""
POLL_S = 0.1


def why_said(run: Path, time_s: float) -> list[dict[str, Any]]:
    """The decisions that were settled when it was said, the latest first.

    Who experiments decides whether the person is told that somebody steps in: the page does not.

    What is being recorded may not be on the disk yet: then it is waited for.

    Raises:
        InputError: if there is no such recording, or nothing in it yet.
    """
    try:
        _await_written(run, time_s + EPSILON_S)
        known = (d for d in why(Run(run)) if d.time_s <= time_s + EPSILON_S)
        settled = [d for d in known if d.source != EXPERIMENTER]
    except OSError as error:
        raise InputError(str(run), f"cannot be read: {error.strerror}") from None
    chain = [asdict(decision) for decision in reversed(settled)]
    for decision in chain:
        others = decision["alternatives"]
        decision["alternatives"] = [a for a in others if a["why_not"] != NOT_NEEDED]
    return chain


def _await_written(run: Path, time_s: float) -> None:
    """Until all of it is on the disk that was recorded up to this mission time."""
    latest = time.monotonic() + WRITTEN_S
    while not _is_written(Run(run), time_s) and time.monotonic() < latest:
        time.sleep(POLL_S)


def _is_written(run: Run, time_s: float) -> bool:
    """Whether the recording is closed, goes on after that time, or has the tick that spoke then."""
    if run.whole:
        return True
    spoke = False
    for at in run.records(Utterance, Tick):
        if at.time_s > time_s or (spoke and isinstance(at.value, Tick)):
            return True
        spoke = spoke or (isinstance(at.value, Utterance) and at.time_s > time_s - 2 * EPSILON_S)
    return False
