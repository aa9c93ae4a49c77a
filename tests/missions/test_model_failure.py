"""A language model that fails is told to the person, once, and kept in the outcome."""

import pytest

from executive.records import EventTaken, Utterance
from executive.testing.bench import Run, run_mission
from executive.types.knowledge import Source
from executive.types.outcome import MissionStatus

WARNING = "My language model does not answer: "


def warnings(run: Run) -> list[str]:
    said = (u.text for u in run.notebook.all(Utterance) if u.speaker == "robot")
    return [text for text in said if text.startswith(WARNING)]


@pytest.mark.parametrize("elicit", ["rank", "generate"])
@pytest.mark.parametrize(
    ("replies", "why"),
    [([], "the script has no more replies"), ([None], "nothing came within 60 s")],
    ids=["fails", "is silent"],
)
def test_the_person_hears_why_the_model_is_of_no_help_and_then_is_asked(
    elicit: str, replies: list[None], why: str
) -> None:
    run = run_mission("Find an apple", defaults=False, elicit=elicit, replies=replies)
    assert (run.outcome.status, run.outcome.source) == (MissionStatus.DONE, Source.USER)
    assert run.outcome.model_failure == why
    assert warnings(run) == [f"{WARNING}{why}."]


def test_a_model_that_fails_twice_is_told_once() -> None:
    rooms = '{"places": ["kitchen", "bedroom"]}'
    run = run_mission("Find an apple", defaults=False, elicit="generate", replies=[rooms])
    failed = [e.event for e in run.notebook.all(EventTaken) if "replies" in repr(e.event)]
    assert len(failed) > 1
    assert len(warnings(run)) == 1
    assert run.outcome.model_failure == "the script has no more replies"


def test_a_model_that_cannot_read_the_words_is_told_too() -> None:
    run = run_mission("Come with the hammer!", replies=[], answers=["yes"])
    assert (run.outcome.status, len(warnings(run))) == (MissionStatus.NOT_UNDERSTOOD, 1)


@pytest.mark.parametrize("reply", ["On the table, I guess.", '{"places": ["pantry"]}', ""])
def test_a_useless_reply_is_no_failure_of_the_model(reply: str) -> None:
    run = run_mission(
        "Find an apple", defaults=False, elicit="generate", replies=[reply, reply, reply]
    )
    assert (run.outcome.status, run.outcome.source) == (MissionStatus.DONE, Source.USER)
    assert (run.outcome.model_failure, warnings(run)) == ("", [])


def test_where_no_model_is_asked_none_fails() -> None:
    run = run_mission("Find a power_drill", replies=[])
    assert (run.outcome.model_failure, warnings(run)) == ("", [])
