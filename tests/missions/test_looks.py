"""A thing may be asked for by what it looks like."""

import pytest

from executive.records import Utterance
from executive.testing.bench import Run, run_mission


def told(run: Run) -> str:
    return " ".join(said.text for said in run.notebook.all(Utterance) if said.speaker == "robot")


@pytest.mark.parametrize(
    ("words", "thing"),
    [("Bring me the yellow bottle", "mustard_bottle"), ("Find the red mug", "mug")]
    + [("Bring the orange", "orange"), ("Take the blue can", "potted_meat_can")],
)
def test_a_thing_is_done_with_that_is_described(words: str, thing: str) -> None:
    outcome = run_mission(words, llm=False).outcome
    assert (outcome.status, outcome.object) == ("done", thing)


def test_of_several_that_fit_the_person_chooses_by_another_property() -> None:
    run = run_mission("Find the yellow one", answers=["the fruit", "high_table"], llm=False)
    assert run.outcome.object == "banana"
    assert "Which yellow one do you mean: the banana, the sugar box, the mustard bottle" in told(
        run
    )


def test_a_color_answers_which_one_is_meant() -> None:
    run = run_mission("Find a bottle", answers=["the yellow one", "cabinet_kitchen"], llm=False)
    assert run.outcome.object == "mustard_bottle"


def test_what_is_asked_for_by_its_use_and_may_be_anywhere_is_brought_after_a_question() -> None:
    words = "I need something to clean the bathroom with"
    run = run_mission(words, answers=["In the kitchen"], llm=False)
    assert "Where is the bleach cleanser?" in told(run)
    assert (run.outcome.status, run.outcome.object) == ("done", "bleach_cleanser")


@pytest.mark.parametrize(("answer", "thing"), [("yes", "mug"), ("no", None)])
def test_a_thing_of_another_color_is_offered_and_never_simply_brought(
    answer: str, thing: str | None
) -> None:
    run = run_mission("Bring the blue mug", answers=[answer, "dining_table"], llm=False)
    assert "The mug is red, not blue. Do you mean the mug?" in told(run)
    assert run.outcome.object == thing


def test_of_several_of_other_colors_one_is_offered() -> None:
    run = run_mission("Find the red bottle", answers=["the bleach", "cabinet_kitchen"], llm=False)
    bottles = "the mustard bottle", "the bleach cleanser"
    assert f"Neither {' nor '.join(bottles)} is red. Do you mean {' or '.join(bottles)}" in told(
        run
    )
    assert run.outcome.object == "bleach_cleanser"


def test_without_anyone_to_ask_the_reason_is_the_color() -> None:
    outcome = run_mission("Bring the blue mug", answers=[None], llm=False).outcome
    assert outcome.reason.startswith("the mug is red, not blue")
