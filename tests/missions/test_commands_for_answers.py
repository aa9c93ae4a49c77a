"""A command said while the robot asks something is no answer, and is told so."""

import pytest

from executive.records import Utterance
from executive.testing.bench import Run, run_mission
from executive.types import MissionStatus


def run(words: str, *answers: str) -> Run:
    return run_mission(words, llm=False, defaults=False, answers=answers)


def questions(mission: Run) -> list[str]:
    said = (one for one in mission.notebook.all(Utterance) if one.speaker == "robot")
    return [one.text for one in said if "?" in one.text]


def test_a_command_for_a_place_is_told_so_and_asked_again() -> None:
    mission = run("Find the mug", "Bring the apple", "on the coffee table")
    first, second = questions(mission)
    still = "I am still looking for the mug; say stop to end that. "
    assert second.startswith(f"{still}Where is the mug? I know: ")
    assert (mission.outcome.status, mission.outcome.object) == (MissionStatus.DONE, "mug")


def test_the_third_question_is_about_the_third_answer() -> None:
    *_, third = questions(run("Find the mug", "Bring the apple", "in the attic", "coffee table"))
    assert third.startswith("I know no such place. Where is the mug? I know: ")


def test_a_command_that_names_a_place_is_an_answer() -> None:
    mission = run("Find the mug", "Get the mug from the coffee table")
    assert len(questions(mission)) == 1
    assert mission.outcome.status == MissionStatus.DONE


def test_a_command_about_another_thing_is_no_choice() -> None:
    mission = run("Find a fruit", "Bring the hammer", "the apple", "dining table")
    first, second, *_ = questions(mission)
    assert second == f"I am still at what you asked for before; say stop to end that. {first}"
    assert mission.outcome.object == "apple"


@pytest.mark.parametrize("answer", ["the banana", "Bring the banana"])
def test_a_command_about_one_of_the_choices_is_one(answer: str) -> None:
    mission = run("Find a fruit", answer, "dining table")
    assert len(questions(mission)) == 2
    assert mission.outcome.object == "banana"
