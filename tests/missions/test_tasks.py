"""Several tasks in one breath: each has an end of its own, and the whole is done if all are."""

from collections.abc import Callable
from pathlib import Path

import pytest
from replays import recorded

from executive.app.parts import mission_tree
from executive.events import Inbox, StopRequested
from executive.interfaces.runtime import Tree
from executive.language.grammar import EnglishInterpreter
from executive.replay.replaying import replay
from executive.situation import Agenda, Situation
from executive.testing.bench import Run, run_mission
from executive.types.commands import Command, CommandKind
from executive.types.goals import DriveTo, Goal, LookAt, Pick
from executive.types.outcome import MissionStatus
from kb.facts import FactStore
from logs.questions.why import why
from logs.recording.reader import Run as Recorded
from trees.context import MissionContext

DONE, NOT_DONE = MissionStatus.DONE, MissionStatus.NOT_DONE


def ends(run: Run) -> list[tuple[str, str, MissionStatus]]:
    return [(task.kind, task.target, task.status) for task in run.outcome.tasks]


def test_each_task_is_done_in_the_order_said_and_the_whole_tells_of_each() -> None:
    run = run_mission("Find the mug. Then bring the apple.", llm=False)
    assert ends(run) == [("find", "mug", DONE), ("bring", "apple", DONE)]
    assert run.outcome.status == DONE
    assert run.outcome.reason == (
        "1. The mug is on the coffee table in the living room. "
        "2. Here is the apple from the dining table."
    )
    assert run.outcome.visited == ("coffee_table", "dining_table")


@pytest.mark.parametrize(
    "words", ["Find the unicorn. Then find the mug.", "Find the mug. Then find the unicorn."]
)
def test_a_part_that_fails_loses_none_of_the_others(words: str) -> None:
    run = run_mission(words, llm=False)
    assert sorted(ends(run)) == [("find", "mug", DONE), ("find", "unicorn", NOT_DONE)]
    assert run.outcome.status == NOT_DONE
    assert "Not done: I know no 'unicorn'" in run.outcome.reason
    assert "The mug is on the coffee table in the living room." in run.user.told


def test_a_single_task_is_told_as_ever() -> None:
    run = run_mission("Find the mug", llm=False)
    assert ends(run) == [("find", "mug", DONE)]
    assert run.outcome.reason == "The mug is on the coffee table in the living room."


def test_what_is_it_and_there_was_said_in_the_task_before() -> None:
    run = run_mission("Put the mug on the sofa, go to the desk and put it there", llm=False)
    assert run.outcome.status == DONE
    assert run.world.resting_place("mug") == "desk"


def test_what_is_held_is_put_back_before_the_next_thing_is_fetched() -> None:
    run = run_mission("Take the mug. Then bring the apple.", llm=False, facts=FactStore())
    assert [task.status for task in run.outcome.tasks] == [MissionStatus.NOT_DONE, DONE]
    assert "I put the mug back on the coffee table first." in run.user.told
    assert run.world.resting_place("mug") == "coffee_table"


def test_the_robot_comes_back_to_apologise_only_when_there_is_nothing_else_to_do() -> None:
    def stuck(goal: Goal) -> str | None:
        return "it is locked" if goal == DriveTo("coffee_table") else None

    run = run_mission("Find the mug. Then find the apple.", llm=False, fault=stuck)
    assert ends(run) == [("find", "mug", NOT_DONE), ("find", "apple", DONE)]
    before = run.goals[: run.goals.index(DriveTo("dining_table"))]
    assert DriveTo("person") not in before


def test_after_a_stop_what_was_not_begun_is_told_of_too() -> None:
    def stop(goal: Goal, inbox: Inbox) -> None:
        if isinstance(goal, LookAt):
            inbox.post(StopRequested("the person"))

    run = run_mission("Find the mug. Then bring the apple.", llm=False, during=stop)
    assert [task.status for task in run.outcome.tasks] == [MissionStatus.STOPPED] * 2
    assert run.outcome.tasks[1].reason == "I did not get to it"
    assert run.outcome.visited == ("coffee_table",)


def test_several_tasks_are_kept_replayed_and_explained_one_by_one(tmp_path: Path) -> None:
    run = Recorded(recorded(tmp_path, "Take the mug. Then find the unicorn.", llm=False))
    outcome = run.outcome()
    assert outcome
    assert [(task.kind, task.status) for task in outcome.tasks] == [
        (CommandKind.TAKE, DONE),
        (CommandKind.FIND, NOT_DONE),
    ]
    assert replay(run.path.parent).parting is None
    told = [decision.question for decision in why(run)]
    assert told.index("task 1: take mug") < told.index("known object")
    assert told[-2:] == ["task 2: find unicorn", "outcome"]


def test_what_the_model_thought_of_one_task_is_no_reason_in_the_next(tmp_path: Path) -> None:
    run = recorded(tmp_path, "Find the apple. Then come back.", search="plan", replies=[[1.0] * 12])
    for decision in why(Recorded(run))[1:]:
        if decision.question == "understand":
            assert not [a for a in decision.alternatives if a.why_not.startswith("scored")]


def test_what_one_part_denies_is_touched_in_none() -> None:
    run = run_mission("Bring the mug, but do not touch the pear", llm=False)
    assert [goal.detection.label for goal in run.goals if isinstance(goal, Pick)] == ["mug"]


def test_a_negation_that_is_not_read_is_a_deed_in_no_part() -> None:
    assert not EnglishInterpreter().commands("Bring the mug and never the pear")


def change_meanwhile(words: str, change: Callable[[Agenda], None]) -> Run:
    """A mission whose agenda somebody changes when the robot first drives."""
    situations: list[Situation] = []

    def build(context: MissionContext) -> Tree:
        situations.append(context.situation)
        return mission_tree(context)

    def during(goal: Goal, inbox: Inbox) -> None:
        if situations and isinstance(goal, DriveTo):
            change(situations.pop().agenda)

    return run_mission(words, llm=False, build=build, during=during)


def test_a_wish_that_is_added_meanwhile_is_done_afterwards() -> None:
    wish = Command(CommandKind.FIND, "apple", "the apple, too")
    run = change_meanwhile("Find the mug", lambda agenda: agenda.add(((wish,),)))
    assert ends(run) == [("find", "mug", DONE), ("find", "apple", DONE)]


def test_what_is_to_be_done_instead_interrupts_the_task_at_hand() -> None:
    def no_the_apple(agenda: Agenda) -> None:
        agenda.instead = Command(CommandKind.FIND, "apple", "no, the apple")

    run = change_meanwhile("Find the mug. Then find the pear.", no_the_apple)
    assert ends(run) == [("find", "apple", DONE), ("find", "pear", DONE)]
    assert run.goals[:2] == [DriveTo("coffee_table"), DriveTo("dining_table")]


def test_of_two_things_that_are_taken_only_one_is_held() -> None:
    run = run_mission("Take the hammer. Then take the power drill.", llm=False)
    statuses = [task.status for task in run.outcome.tasks]
    assert statuses == [MissionStatus.NOT_DONE, MissionStatus.DONE]
    assert run.outcome.status == MissionStatus.NOT_DONE
    assert "I hold one thing at a time" in run.outcome.reason


def test_what_is_taken_to_be_put_somewhere_was_taken() -> None:
    run = run_mission("Take the hammer. Go to the kitchen. Then put it on the sofa.", llm=False)
    assert run.outcome.status == MissionStatus.DONE, run.outcome.reason
    assert run.world.resting_place("hammer") == "sofa"
