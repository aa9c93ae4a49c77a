"""Whether someone said stop can be asked without taking what is in the box."""

from pathlib import Path

import pytest

from executive.events import DeadlinePassed, Inbox, StopRequested
from executive.types.results import Answered
from kb.llm import llama


def test_only_a_stop_is_one() -> None:
    inbox = Inbox()
    inbox.post(DeadlinePassed(1.0))
    inbox.end(inbox.open(), Answered("desk"))
    assert not inbox.stop_waits
    inbox.end(inbox.open(), Answered("please stop"))
    assert inbox.stop_waits
    assert len(inbox.take_all()) == 3
    assert not inbox.stop_waits


@pytest.mark.parametrize(
    ("event", "ends"), [(DeadlinePassed(1.0), False), (StopRequested("x"), True)]
)
def test_the_trial_of_a_new_model_is_ended_by_a_stop_alone(
    event: DeadlinePassed | StopRequested, ends: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked = []
    monkeypatch.setattr(llama, "check_file", lambda path: None)
    monkeypatch.setattr(llama, "tried", lambda path, called_off: asked.append(called_off()))
    inbox = Inbox()
    inbox.post(event)
    llama.LlamaCpp(Path("absent.gguf"), inbox).close()
    assert asked == [ends]
