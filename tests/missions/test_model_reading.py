"""What the grammar cannot read a model may, into the same meaning; the person hears all of it."""

import json

import pytest

from executive.records import Utterance
from executive.testing.bench import Run, run_mission
from executive.types.commands import CommandKind
from executive.types.outcome import MissionStatus


def reply(kind: str, thing: str = "", source: str = "", goal: str = "") -> str:
    task = {"kind": kind, "number": 1, "object": thing, "from": source, "to": goal}
    return json.dumps({"tasks": [task]})


def read(words: str, written: str, *answers: str) -> Run:
    return run_mission(words, elicit="generate", replies=[written], answers=answers)


def said(run: Run) -> list[str]:
    return [one.text for one in run.notebook.all(Utterance) if one.speaker == "robot"]


@pytest.mark.parametrize(
    ("words", "written", "asked", "place"),
    [
        (
            "My hammer belongs onto the sofa I guess",
            reply("put", "hammer", goal="sofa"),
            "Do you mean: put the hammer on the sofa?",
            "sofa",
        ),
        (
            "hammer, lobby, kitchen, you know",
            reply("put", "hammer", "lobby", "cabinet_kitchen"),
            "Do you mean: put the hammer from the lobby in the cabinet in the kitchen?",
            "cabinet_kitchen",
        ),
    ],
)
def test_a_model_may_read_where_things_go(words: str, written: str, asked: str, place: str) -> None:
    run = read(words, written, "yes")
    assert (run.outcome.kind, run.outcome.status) == (CommandKind.PUT, MissionStatus.DONE)
    assert said(run)[0] == asked
    assert run.world.resting_place("hammer") == place


def test_what_the_person_denies_is_not_done() -> None:
    run = read("My hammer belongs onto the sofa I guess", reply("put", "hammer", "", "sofa"), "no")
    assert (run.outcome.status, run.goals) == (MissionStatus.NOT_UNDERSTOOD, [])


def test_what_the_model_passes_over_is_said() -> None:
    run = read("my hammer, off to the sofa with it", reply("find", "hammer"), "no")
    assert said(run)[0] == "Do you mean: find the hammer? I make nothing of 'sofa'."
    run = read("my hammer and my mug, where might they be", reply("find", "hammer"), "no")
    assert said(run)[0] == "Do you mean: find the hammer? I make nothing of 'mug'."


@pytest.mark.parametrize(
    ("words", "left"),
    [
        ("my two hammers, off with them to me", "'two'"),
        ("my green hammer, off with it to me", "'green'"),
        ("my hammer, off to me with it when I am at home", "'when'"),
        ("three white hammers to me if the weather is fine", "'white' and 'three' and 'if'"),
    ],
)
def test_numbers_colours_and_conditions_that_the_model_passes_over_are_said(words, left) -> None:
    run = read(words, reply("bring", "hammer"), "no")
    assert said(run)[0] == f"Do you mean: bring the hammer? I make nothing of {left}."


def test_a_colour_that_the_thing_has_is_not_passed_over() -> None:
    run = read("my red mug, off to me with it", reply("bring", "mug"), "no")
    assert said(run)[0] == "Do you mean: bring the mug?"


def test_all_tasks_that_the_model_reads_are_asked_about_and_done() -> None:
    tasks = [json.loads(reply("bring", name))["tasks"][0] for name in ("hammer", "scissors")]
    run = read(
        "off to me with hammer and scissors", json.dumps({"tasks": tasks}), "yes", "on the desk"
    )
    assert said(run)[0] == "Do you mean: bring the hammer, then bring the scissors?"
    assert [task.object for task in run.outcome.tasks] == ["hammer", "scissors"]
    assert run.outcome.status == MissionStatus.DONE


@pytest.mark.parametrize("written", [reply("put", "hammer", "", "attic"), reply("find", "crown")])
def test_what_does_not_exist_is_not_asked_about(written: str) -> None:
    run = read("my hammer belongs onto the sofa I guess", written)
    assert not any(text.startswith("Do you mean") for text in said(run))
    assert run.outcome.status == MissionStatus.NOT_UNDERSTOOD


def test_a_negation_is_never_shown_to_the_model() -> None:
    run = read("that hammer should not end up on my sofa", reply("put", "hammer", "", "sofa"))
    assert (run.outcome.llm_calls, run.goals) == (0, [])
