"""Answers that do not name one of what was offered, and say enough nevertheless."""

import pytest

from executive.events import Inbox
from executive.records import Utterance
from executive.testing.bench import run_mission
from executive.types import Goal, MissionStatus


def asked(words: str, *answers: str) -> tuple[list[str], str]:
    """The robot's questions, and how the mission ended."""
    run = run_mission(words, llm=False, search="plan", answers=answers)
    said = [one.text for one in run.notebook.all(Utterance) if one.speaker == "robot"]
    return [text for text in said if text.endswith("?")], run.outcome.reason


@pytest.mark.parametrize(
    ("answer", "reason"),
    [
        ("two of them", "I found both: the apple and the banana on the dining table."),
        ("anything but the apple", "The banana is on the dining table in the living room."),
        ("the apple please, and hurry up", "The apple is on the dining table in the living room."),
        ("the last one", "The strawberry is on the dining table in the living room."),
    ],
)
def test_is_understood_at_once(answer: str, reason: str) -> None:
    questions, ended = asked("Find a fruit", answer)
    assert (len(questions), ended) == (1, reason)


def test_the_first_and_the_last_are_two() -> None:
    _, ended = asked("Find a fruit", "the first and the last")
    assert "1. The apple is" in ended
    assert "2. The strawberry is" in ended


@pytest.mark.parametrize(
    ("answer", "next_question"),
    [
        ("either the apple or the pear", "Which fruit do you mean: the apple or the pear?"),
        ("the one on the dining table", "Which fruit do you mean: the apple, the banana or the"),
        ("appel", "Which fruit do you mean: the apple?"),
    ],
)
def test_leaves_less_to_ask(answer: str, next_question: str) -> None:
    questions, _ = asked("Find a fruit", answer, "I don't know")
    assert questions[1].startswith(next_question)


@pytest.mark.parametrize(
    ("answer", "place"),
    [("coffee", "coffee table"), ("dining", "dining table"), ("on the sofa", "sofa")],
)
def test_part_of_a_name_is_enough_where_several_were_offered(answer: str, place: str) -> None:
    questions, ended = asked("Put the hammer on the table", answer)
    assert len(questions) == 1
    assert place in ended


def test_what_waits_may_be_corrected_by_its_name() -> None:
    def during(goal: Goal, inbox: Inbox) -> None:
        if not heard:
            heard.append("said")
            inbox.hear("the pear instead of the apple")

    heard: list[str] = []
    run = run_mission("Bring the mug, then the apple", llm=False, search="plan", during=during)
    assert run.outcome.status == MissionStatus.DONE
    assert [task.object for task in run.outcome.tasks] == ["mug", "pear"]
