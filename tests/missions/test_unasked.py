"""What is not to be done, or cannot be, is not done: the robot says so, and asks nothing."""

import pytest

from executive.records import Utterance
from executive.testing.bench import Run, run_mission
from executive.types.commands import CommandKind
from executive.types.outcome import MissionStatus

ALWAYS = ["yes", "the apple", "on the desk"]


def said(run: Run) -> list[str]:
    return [one.text for one in run.notebook.all(Utterance) if one.speaker == "robot"]


@pytest.mark.parametrize("llm", [True, False])
@pytest.mark.parametrize(
    ("words", "answer"),
    [
        (
            "Do not touch the hammer",
            "Then I will not. I do not keep that in mind: what you ask for later counts.",
        ),
        (
            "Don't bring me the apple",
            "Then I will not. I do not keep that in mind: what you ask for later counts.",
        ),
        (
            "Leave the mug alone",
            "Then I will not. I do not keep that in mind: what you ask for later counts.",
        ),
        ("Bring no apple", "I do nothing: I hear 'no', and do not understand the rest."),
        ("Throw the apple", "I cannot throw."),
    ],
)
def test_nothing_is_done_whoever_answers_whatever_is_asked(
    words: str, answer: str, llm: bool
) -> None:
    run = run_mission(words, llm=llm, answers=ALWAYS)
    assert said(run) == [answer]
    assert (run.outcome.status, run.outcome.kind) == (MissionStatus.NOT_DONE, None)
    assert (run.goals, run.outcome.inquiries, run.outcome.llm_calls) == ([], 0, 0)


@pytest.mark.parametrize(
    ("words", "cannot"),
    [
        ("Where did you put the mug?", "I cannot tell you that so far"),
    ],
)
def test_what_cannot_be_done_yet_is_told(words: str, cannot: str) -> None:
    run = run_mission(words, llm=False, answers=ALWAYS)
    assert run.outcome.reason.startswith(cannot)
    assert (run.outcome.status, run.goals) == (MissionStatus.NOT_DONE, [])


def test_what_is_said_not_to_be_meant_is_neither_offered_nor_taken() -> None:
    run = run_mission("Find a fruit but not a banana", llm=False, answers=["banana", "apple"])
    assert "banana" not in said(run)[0]
    assert run.outcome.object == "apple"


def test_a_slip_in_the_verb_is_asked_about_with_all_that_would_be_done() -> None:
    run = run_mission("Bing me an aple", llm=False, answers=["yes"])
    assert said(run)[0] == "Do you mean: bring the apple?"
    assert (run.outcome.kind, run.outcome.object) == (CommandKind.BRING, "apple")


def test_no_slip_is_made_of_words_about_nothing_known() -> None:
    run = run_mission("Bringe mir einen Apfel", llm=False, answers=["yes"])
    assert (run.outcome.status, run.outcome.inquiries) == (MissionStatus.NOT_UNDERSTOOD, 0)
