"""A stop in words, from whoever was asked, is recorded as what it was."""

import json
from pathlib import Path

import pytest
from replays import recorded

from executive.events import Ended, Inbox
from executive.replay.replaying import replay
from executive.types.results import Result


def test_an_answer_that_says_stop_stops_and_replays(tmp_path: Path) -> None:
    run = recorded(tmp_path, "Find an apple", llm=False, answers=["Please stop!"])
    assert json.loads((run / "outcome.json").read_text())["status"] == "stopped"
    assert replay(run).parting is None


def test_words_that_say_stop_replay(tmp_path: Path) -> None:
    assert replay(recorded(tmp_path, "stop it", llm=False)).parting is None


def test_a_recording_in_which_such_an_answer_was_no_stop_replays_as_it_was(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def end(inbox: Inbox, request: int, result: Result) -> None:
        inbox.post(Ended(request, result))

    with monkeypatch.context() as before:
        before.setattr(Inbox, "end", end)
        run = recorded(tmp_path, "Find an apple", llm=False, answers=["cancel", "living room"])
    assert json.loads((run / "outcome.json").read_text())["inquiries"] == 2
    assert replay(run).parting is None
