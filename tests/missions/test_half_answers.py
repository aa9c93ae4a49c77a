"""Answers that do not name one of what was offered, and say enough nevertheless."""

import pytest

from executive.events import Inbox
from executive.records import Utterance
from executive.testing.bench import run_mission
from executive.types.goals import Goal
from executive.types.outcome import MissionStatus
from kb.facts import FactStore


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
        ("any but the apple", "The banana is on the dining table in the living room."),
        ("any two", "I found both: the apple and the banana on the dining table."),
    ],
)
def test_is_understood_at_once(answer: str, reason: str) -> None:
    questions, ended = asked("Find a fruit", answer)
    assert (len(questions), ended) == (1, reason)


def test_the_first_and_the_last_are_two() -> None:
    _, ended = asked("Find a fruit", "the first and the last")
    assert "1. The apple is" in ended
    assert "2. The strawberry is" in ended


def test_which_is_nearest_is_the_robots_to_say() -> None:
    run = run_mission(
        "Find a fruit",
        llm=False,
        search="plan",
        answers=["whichever is closest"],
        place={"pear": "sofa"},
        facts=FactStore.believing({"pear": ["sofa"], "apple": ["bed"]}),
    )
    assert run.outcome.object == "pear"


def test_what_was_not_offered_is_meant_too() -> None:
    _, ended = asked("Find a fruit", "the pear and also the mug")
    assert "1. The pear is" in ended
    assert "2. The mug is" in ended


def test_all_but_one_are_several() -> None:
    _, ended = asked("Find a fruit", "all but the apple and the pear")
    assert "apple" not in ended
    assert "4. The strawberry is" in ended


def test_it_may_be_wanted_elsewhere() -> None:
    _, ended = asked("Bring a fruit", "put the pear on the desk")
    assert ended == "I put the pear on the desk."


def test_the_first_one_may_be_what_is_not_meant() -> None:
    questions, _ = asked("Find a fruit", "not the first one", "I don't know")
    assert questions[1].startswith("Which fruit do you mean: the banana,")


def test_none_of_them_but_another_thing_is_no_refusal() -> None:
    _, ended = asked("Find a fruit", "none of them, the mug")
    assert ended.startswith("The mug is")


@pytest.mark.parametrize(
    ("answer", "reason"),
    [
        ("yes, to the desk", "I put the mug on the desk."),
        ("no, put it on the desk", "I put the mug on the desk."),
        ("yes, bring it", "Here is the mug from the coffee table."),
        ("bring it", "Here is the mug from the coffee table."),
        ("no, the pear", "Here is the pear from the high table."),
        ("just the pear", "Here is the pear from the high table."),
    ],
)
def test_a_yes_or_no_may_have_a_wish_behind_it(answer: str, reason: str) -> None:
    questions, ended = asked("The mug, please", answer)
    assert (questions, ended) == (["Do you mean: bring the mug?"], reason)


def test_what_is_wished_behind_a_yes_is_meant_of_all() -> None:
    _, ended = asked("The mug and the pear", "yes, to the desk")
    assert ended == "1. I put the mug on the desk. 2. I put the pear on the desk."


@pytest.mark.parametrize(
    ("words", "question"),
    [
        ("bring mug desk", "I know no 'mug desk'. Do you mean the mug? I make nothing of 'desk'."),
        ("brng the pear if the mug is on the desk", "Do you mean: bring the pear if the mug is on"),
        ("The mug is on the desk. Bring the pear", "bring the pear? I make nothing of 'mug' and"),
        ("brng a pear if there is one, otherwise the mug", "or else bring the mug?"),
    ],
)
def test_a_question_says_what_a_yes_would_do(words: str, question: str) -> None:
    run = run_mission(words, llm=False, search="plan", answers=["no"])
    said = [one.text for one in run.notebook.all(Utterance) if one.speaker == "robot"]
    assert question in said[0]


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
    [
        ("coffee", "coffee table"),
        ("dining", "dining table"),
        ("on the sofa", "sofa"),
        ("on the sofa, please", "sofa"),
        ("neither, on the sofa", "sofa"),
    ],
)
def test_part_of_a_name_is_enough_where_several_were_offered(answer: str, place: str) -> None:
    questions, ended = asked("Put the hammer on the table", answer)
    assert len(questions) == 1
    assert place in ended


@pytest.mark.parametrize("words", ["Put the hammer on the table", "Put the hammer"])
def test_who_is_asked_where_to_may_want_it_themselves(words: str) -> None:
    questions, ended = asked(words, "give it to me")
    assert (len(questions), ended) == (1, "Here is the hammer from the shelf in the lobby.")


@pytest.mark.parametrize("answer", ["anywhere but the sofa", "anything but the sofa"])
def test_where_it_is_not_to_go_is_no_answer(answer: str) -> None:
    _, ended = asked("Put the hammer", answer, "the bed")
    assert ended == "I put the hammer on the bed."


def test_what_waits_may_be_corrected_by_its_name() -> None:
    def during(goal: Goal, inbox: Inbox) -> None:
        if not heard:
            heard.append("said")
            inbox.hear("the pear instead of the apple")

    heard: list[str] = []
    run = run_mission("Bring the mug, then the apple", llm=False, search="plan", during=during)
    assert run.outcome.status == MissionStatus.DONE
    assert [task.object for task in run.outcome.tasks] == ["mug", "pear"]
