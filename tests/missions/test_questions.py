"""What is somewhere, how many, and whether: answered by looking, and only as far as was seen."""

import pytest

from executive.campaign.truth import completed
from executive.testing.bench import Run, run_mission
from executive.types.goals import DriveTo, Goal, LookAt, Pick
from executive.types.outcome import MissionStatus
from kb.facts import FactStore

DONE, NOT_DONE = MissionStatus.DONE, MissionStatus.NOT_DONE


def truly_done(run: Run) -> bool:
    return completed(run.outcome, lambda name: run.world.resting_place(name) or "")


@pytest.mark.parametrize(
    ("words", "answer"),
    [
        (
            "How many fruits are on the dining table?",
            "I count 3: the apple, the banana and the strawberry on the dining table.",
        ),
        ("How many tools are there on the dining table?", "I see no tools on the dining table."),
        ("What is on the coffee table?", "I see the mug and the pudding box on the coffee table."),
        ("What is on the bed?", "I see nothing on the bed."),
        ("Is the mug on the coffee table?", "Yes: the mug on the coffee table."),
        ("Is there any fruit on the sofa?", "No, I see no fruit on the sofa."),
        ("Tell me what is the biggest object on the desk", "The scissors: I see no other there."),
    ],
)
def test_is_answered_by_looking_there(words: str, answer: str) -> None:
    run = run_mission(words, llm=False)
    assert (run.outcome.status, run.outcome.reason) == (DONE, answer)
    assert run.goals[-1] == DriveTo("person")
    assert not [goal for goal in run.goals if isinstance(goal, Pick)]
    assert truly_done(run)


def test_whether_there_is_one_anywhere_is_known_with_the_first_that_is_seen() -> None:
    run = run_mission("Is there any fruit?", llm=False)
    assert (run.outcome.status, len(run.outcome.visited)) == (DONE, 1)


def test_how_many_there_are_anywhere_takes_a_look_everywhere() -> None:
    run = run_mission("How many fruits are there?", llm=False)
    assert run.outcome.reason.startswith("I count 6: ")
    assert truly_done(run)


def test_what_was_not_seen_makes_no_answer_of_what_was() -> None:
    def blind(goal: Goal) -> str | None:
        return "my head is stuck" if isinstance(goal, LookAt) and goal.place == "desk" else None

    run = run_mission("How many tools are in the bedroom?", llm=False, fault=blind)
    assert run.outcome.status == NOT_DONE
    assert (
        run.outcome.reason
        == "I see no tools there; I did not see all of the desk: my head is stuck"
    )


def test_which_is_the_heaviest_cannot_be_seen() -> None:
    run = run_mission("What is the heaviest object on the coffee table?", llm=False)
    assert run.outcome.status == NOT_DONE
    assert run.outcome.reason.endswith("I cannot tell by looking which is the heaviest")


def test_what_is_seen_and_what_is_gone_is_remembered() -> None:
    facts = FactStore()
    facts.saw(["hammer"], "coffee_table")
    run_mission("What is on the coffee table?", llm=False, facts=facts)
    assert facts.places_of("mug") == ("coffee_table",)
    assert facts.places_of("hammer") == ()


def test_a_place_or_a_thing_that_nobody_knows_is_told() -> None:
    unknown = run_mission("What is on the moon?", llm=False)
    assert (unknown.outcome.status, unknown.outcome.reason) == (NOT_DONE, "I know no place 'moon'")
    thing = run_mission("How many unicorns are on the desk?", llm=False)
    assert thing.outcome.reason.startswith("I know no 'unicorns'")


@pytest.mark.parametrize(
    ("words", "seen"),
    [
        ("How many fruits are on the dining table?", "I count 3: the apple, the banana and"),
        ("What is on the coffee table?", "I see the mug and the pudding box on the coffee table"),
        ("Is the mug on the sofa?", "No, I see no mug on the sofa"),
    ],
)
def test_what_was_seen_is_told_even_if_there_is_no_way_back(words: str, seen: str) -> None:
    def shut(goal: Goal) -> str | None:
        return "the door is shut" if goal == DriveTo("person") else None

    run = run_mission(words, llm=False, fault=shut)
    assert run.outcome.status == MissionStatus.NOT_DONE
    assert run.outcome.reason.startswith(seen)
    assert run.outcome.reason.endswith(", but the door is shut")


@pytest.mark.parametrize(
    ("question", "answer"),
    [
        ("check whether there is a mug", "Yes: the mug on the delivery table."),
        ("count the mugs", "I count 1: the mug on the delivery table."),
    ],
)
def test_the_table_by_the_person_is_looked_at_too(question: str, answer: str) -> None:
    run = run_mission(f"Bring the mug, then {question}", llm=False, facts=FactStore())
    assert run.outcome.tasks[1].reason == answer


def test_that_there_is_nothing_is_told_in_that_word() -> None:
    run = run_mission("Bring everything from the bed", llm=False)
    assert run.outcome.reason == "I see nothing on the bed"
