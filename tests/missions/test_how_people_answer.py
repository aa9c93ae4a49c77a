"""Answers and wishes as people give them: all, several, all but one, a thing without a verb."""

import pytest

from executive.testing.bench import run_mission
from executive.types.outcome import MissionStatus


def moved(run) -> set[str]:
    return {one for one in ("apple", "pear", "mug") if run.world.resting_place(one) == "delivery"}


@pytest.mark.parametrize("answer", ["the apple and the pear", "both the apple and the pear"])
def test_several_may_be_meant_where_one_is_asked_for(answer: str) -> None:
    run = run_mission("Bring me a fruit", answers=[answer], llm=False, search="plan")
    assert run.outcome.status == MissionStatus.DONE
    assert moved(run) == {"apple", "pear"}


def test_all_that_were_offered_may_be_meant() -> None:
    run = run_mission("Put a tool on the desk", answers=["all of them"], llm=False, search="plan")
    tools = ("hammer", "power_drill", "adjustable_wrench")
    assert [run.world.resting_place(tool) for tool in tools] == ["desk"] * 3


@pytest.mark.parametrize("answer", ["not the apple", "do not bring the apple"])
def test_what_is_not_meant_is_not_offered_again(answer: str) -> None:
    run = run_mission("Bring me a fruit", answers=[answer, "the pear"], llm=False, search="plan")
    assert "apple" not in run.user.asked[1].text
    assert moved(run) == {"pear"}


def test_a_name_alone_is_asked_back() -> None:
    run = run_mission("The mug, please", answers=["yes"], llm=False, search="plan")
    assert run.user.asked[0].text == "Do you mean: bring the mug?"
    assert moved(run) == {"mug"}


def test_a_place_is_not_called_unknown_where_a_thing_is_wanted() -> None:
    run = run_mission("Bring me the sofa", answers=[], llm=False, search="plan")
    assert "the sofa is a place" in run.outcome.reason


def test_what_has_its_places_inside_has_none_on_top() -> None:
    run = run_mission(
        "Put the mug on top of the fridge", answers=["on the desk"], llm=False, search="plan"
    )
    assert "on top of the fridge" in run.user.asked[0].text
    assert run.world.resting_place("mug") == "desk"


def test_where_nothing_can_be_put_is_asked_about() -> None:
    run = run_mission(
        "Put the mug behind the sofa", answers=["on the sofa"], llm=False, search="plan"
    )
    assert "not 'behind the sofa'" in run.user.asked[0].text


def test_a_question_is_no_answer() -> None:
    answers = ["Where is the apple?", "the pear"]
    run = run_mission("Bring me a fruit", answers=answers, llm=False, search="plan")
    assert moved(run) == {"pear"}


@pytest.mark.parametrize("answer", ["apple pls", "umm the apple i guess", "teh apple", "any"])
def test_an_answer_may_be_sloppy(answer: str) -> None:
    run = run_mission("Bring me a fruit", answers=[answer], llm=False, search="plan")
    assert moved(run) == {"apple"}


def test_nothing_is_put_on_the_floor() -> None:
    run = run_mission("Put the mug on the floor", answers=["on the desk"], llm=False, search="plan")
    assert run.user.asked[0].text == "I put nothing on the floor. Where shall I put the mug?"


def test_an_answer_may_say_where_the_thing_is() -> None:
    run = run_mission(
        "Bring a fruit", answers=["the pear from the sofa"], llm=False, place={"pear": "sofa"}
    )
    assert (moved(run), run.outcome.visited) == ({"pear"}, ("sofa",))


@pytest.mark.parametrize(
    ("answer", "brought"),
    [
        ("the pear, the mug too", {"pear", "mug"}),
        ("none of those, the mug", {"mug"}),
        ("forget it, bring the mug", {"mug"}),
        ("not sure, maybe the pear", {"pear"}),
        ("whichever you like best", {"apple"}),
    ],
)
def test_no_part_of_an_answer_is_lost(answer: str, brought: set[str]) -> None:
    run = run_mission("Bring me a fruit", answers=[answer], llm=False, search="plan")
    assert (run.outcome.status, moved(run)) == (MissionStatus.DONE, brought)


def test_what_nothing_was_made_of_in_an_answer_is_told() -> None:
    answers = ["the dining table but bring the apple first"]
    run = run_mission("Put the mug on the table", answers=answers, llm=False, search="plan")
    assert "I make nothing of 'apple'." in run.user.told
    assert run.world.resting_place("mug") == "dining_table"


@pytest.mark.parametrize("answer", ["on top of the fridge", "under the desk"])
def test_nothing_is_put_where_it_cannot_be(answer: str) -> None:
    answers = [answer, "the sofa"]
    run = run_mission("Put the mug in the garage", answers=answers, llm=False, search="plan")
    assert f"I can put things on furniture, or in it, but not '{answer}'." in run.user.told
    assert run.world.resting_place("mug") == "sofa"


@pytest.mark.parametrize(
    "answer", ["the first and the fifth", "the pear and the apple", "both the apple and the pear"]
)
def test_those_that_were_offered_may_be_counted(answer: str) -> None:
    run = run_mission("Bring me a fruit", answers=[answer], llm=False, search="plan")
    assert moved(run) == {"apple", "pear"}


def test_the_first_two_are_those_that_were_offered_first() -> None:
    run = run_mission("Bring me a fruit", answers=["the first two"], llm=False, search="plan")
    offered = run.user.asked[0].options[:2]
    assert [run.world.resting_place(fruit) for fruit in offered] == ["delivery"] * 2


@pytest.mark.parametrize("answer", ["both", "both of them", "all three"])
def test_as_many_as_were_not_offered_are_asked_about_again(answer: str) -> None:
    run = run_mission("Bring me a fruit", answers=[answer, "the pear"], llm=False, search="plan")
    assert len(run.user.asked) == 2
    assert moved(run) == {"pear"}


@pytest.mark.parametrize("answer", ["the apple, no, the pear", "The apple. No, I mean the pear"])
def test_an_answer_may_be_corrected_in_the_same_breath(answer: str) -> None:
    run = run_mission("Bring me a fruit", answers=[answer], llm=False, search="plan")
    assert moved(run) == {"pear"}


def test_a_yes_with_a_further_wish_is_both() -> None:
    run = run_mission("Bring the muug", answers=["yes, and the pear"], llm=False, search="plan")
    assert moved(run) == {"mug", "pear"}
    assert not any("make nothing of" in said for said in run.user.told)


def test_a_yes_with_another_place_is_that_place() -> None:
    answers = ["yes, but put it on the desk"]
    run = run_mission("Bring the muug", answers=answers, llm=False, search="plan")
    assert run.world.resting_place("mug") == "desk"


def test_what_was_meant_is_not_called_something_that_nothing_is_made_of() -> None:
    run = run_mission("Bring the muug", answers=["no I meant the pear"], llm=False, search="plan")
    assert moved(run) == {"pear"}
    assert not any("make nothing of" in said for said in run.user.told)
