"""What goes wrong by order goes wrong over the wire as in one process, at the same time."""

import io
from pathlib import Path
from typing import Any

import pytest
from served import served

from executive.app.session import Session
from executive.config import load_settings
from executive.events import Inbox
from executive.types.outcome import Outcome
from executive.user import Scripted
from logs.questions.comparison import compare
from logs.recording.reader import Run

CASES = {
    "Bring a power_drill": ("drop",),
    "Bring a mug": ("moved=mug:desk@2", "slip=0.5"),
    "Find the hammer": ("blocked=kitchen-lobby@1-60", "blocked=lobby-bedroom"),
    "Find a mug": ("blind@0-20",),
}


def mission(words: str, runs: Path, **body: Any) -> tuple[Outcome, Run]:
    inbox = Inbox()
    user = Scripted(inbox, ["on the counter wagon", "the desk"])
    settings = load_settings(llm="none", runs=runs, **body)
    with Session(settings, inbox=inbox, user=user, out=io.StringIO()) as session:
        outcome = session.run(words)
    assert outcome.run_dir is not None
    return outcome, Run(Path(outcome.run_dir))


@pytest.mark.parametrize("words", CASES)
def test_what_goes_wrong_is_met_alike(words: str, tmp_path: Path) -> None:
    struck: list[str] = []
    with served(struck.append, faults=CASES[words]) as robot:
        body = {"robot": robot.server.address, "profile": "served_instant"}
        outcome, over_the_wire = mission(words, tmp_path / "wire", **body)
    other, in_process = mission(words, tmp_path, world="fake", fault=CASES[words])
    assert compare(over_the_wire, in_process).parting is None
    assert outcome.mission_time_s == pytest.approx(other.mission_time_s, abs=1e-6)
    assert struck
