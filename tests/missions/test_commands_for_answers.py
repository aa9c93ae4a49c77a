"""A command said while the robot asks something is no answer, and is attended to."""

import pytest

from executive.records import Utterance
from executive.testing.bench import Run, run_mission
from executive.types.outcome import MissionStatus
from executive.user import Scripted


def run(words: str, *answers: str) -> Run:
    return run_mission(words, llm=False, defaults=False, answers=answers)


def questions(mission: Run) -> list[str]:
    said = (one for one in mission.notebook.all(Utterance) if one.speaker == "robot")
    return [one.text for one in said if "?" in one.text]


def told(mission: Run) -> list[str]:
    assert isinstance(mission.user, Scripted)
    return mission.user.told


def test_a_command_for_a_place_is_done_afterwards_and_it_is_asked_again() -> None:
    mission = run("Find the mug", "Bring the hammer", "on the coffee table", "shelf lobby")
    first, second, *_ = questions(mission)
    assert "All right: I bring the hammer afterwards." in told(mission)
    assert second.startswith("Where is the mug? I know: ")
    assert [(task.object, task.status) for task in mission.outcome.tasks] == [
        ("mug", MissionStatus.DONE),
        ("hammer", MissionStatus.DONE),
    ]


def test_a_correction_for_a_place_is_what_is_done() -> None:
    mission = run("Find the mug", "No, the hammer", "shelf lobby")
    assert "All right: I find the hammer instead." in told(mission)
    assert [task.object for task in mission.outcome.tasks] == ["hammer"]


def test_what_is_taken_back_is_not_done() -> None:
    mission = run("Find the mug", "Do not find it", "on the coffee table")
    assert "Then I do not find the mug." in told(mission)
    assert (mission.outcome.status, mission.outcome.reason) == ("not_done", "you took it back")
    assert mission.goals == []


def test_the_third_question_is_about_the_third_answer() -> None:
    _, _, third, *_ = questions(
        run("Find the mug", "Bring the apple", "in the attic", "coffee table")
    )
    assert third.startswith("I know no such place. Where is the mug? I know: ")


def test_a_command_that_names_a_place_is_an_answer() -> None:
    mission = run("Find the mug", "Get the mug from the coffee table")
    assert len(questions(mission)) == 1
    assert mission.outcome.status == MissionStatus.DONE


def test_a_command_about_another_thing_is_no_choice() -> None:
    mission = run("Find a fruit", "Bring the hammer", "the apple", "dining table")
    first, second, *_ = questions(mission)
    assert second == first
    assert mission.outcome.tasks[0].object == "apple"


@pytest.mark.parametrize("answer", ["the banana", "Bring the banana"])
def test_a_command_about_one_of_the_choices_is_one(answer: str) -> None:
    mission = run("Find a fruit", answer, "dining table")
    assert len(questions(mission)) == 2
    assert mission.outcome.object == "banana"
