"""Why the robot did it: what `python -m logs why` tells of missions of many kinds is so."""

from pathlib import Path

import pytest

from executive.app.session import Session
from executive.config import load_settings
from logs.questions.decision import Decision
from logs.questions.why import why
from logs.recording.reader import Run


def decisions(folder: Path, words: str, **others: object) -> list[Decision]:
    """What was decided in a mission of the instant world, as its recording tells it."""
    settings = {"world": "fake", "llm": "none", "user": "oracle", "runs": folder, **others}
    with Session(load_settings(**settings)) as session:
        session.run(words)
    return why(Run(session.folder))


def told(chain: list[Decision], question: str) -> list[tuple[str, str]]:
    """Who settled a question, and how, each time."""
    return [(d.source, d.answer) for d in chain if d.question == question]


def test_it_begins_with_the_words(tmp_path: Path) -> None:
    first, *_ = decisions(tmp_path, "Put the hammer next to the mug")
    assert (first.question, first.answer, first.source) == (
        "asked",
        "'Put the hammer next to the mug'",
        "person",
    )


def test_a_task_in_parts_is_told_part_by_part(tmp_path: Path) -> None:
    chain = decisions(tmp_path, "Bring two fruits")
    assert told(chain, "in parts") == [("", "bring 2 fruits: first bring apple")]
    assert told(chain, "understand") == [("person", "bring apple"), ("person", "bring banana")]
    parts = [(d.question, d.answer) for d in chain if d.question.startswith("part: ")]
    assert parts == [
        ("part: bring apple", "done: Here is the apple from the dining table."),
        ("part: bring banana", "done: Here is the banana from the dining table."),
    ]


@pytest.mark.parametrize(
    ("words", "seen"),
    [
        ("Put the hammer next to the mug", "seen there"),
        ("Clear the coffee table", "seen there: mug, pudding_box"),
        ("What is on the coffee table?", "seen there: mug, pudding_box"),
        ("Bring the mug unless it is on the coffee table", "seen there: mug, pudding_box"),
        ("Find the apple on the coffee table", "not seen there"),
    ],
)
def test_what_was_seen_is_told_also_where_the_look_ends_a_part(
    tmp_path: Path, words: str, seen: str
) -> None:
    chain = decisions(tmp_path, words)
    assert told(chain, "look at coffee_table")[0] == ("eyes", seen)


def test_what_the_plan_decides_is_told_once(tmp_path: Path) -> None:
    chain = decisions(tmp_path, "Find the mug", question_s=0)
    asked, looked = told(chain, "look or ask")
    assert asked[1].startswith("I ask, because looking on would cost")
    assert looked[1].startswith("I look at coffee_table")


def test_by_the_stages_each_answer_of_the_person_is_told(tmp_path: Path) -> None:
    chain = decisions(
        tmp_path, "Bring the mug", search="paper", defaults=False, fault=("moved=mug:desk@1",)
    )
    assert told(chain, "which places") == [("user", "coffee_table"), ("user", "desk")]


def test_a_fault_stands_before_what_it_leads_to(tmp_path: Path) -> None:
    faults = ("blocked=kitchen-living_room", "blocked=kitchen-lobby")
    chain = decisions(tmp_path, "Bring the drill from the refrigerator", fault=faults)
    questions = [d.question for d in chain]
    assert questions.index("fault") < questions.index("look at refrigerator")


def test_a_place_that_is_out_of_reach_twice_is_told_twice(tmp_path: Path) -> None:
    chain = decisions(
        tmp_path,
        "Find the mug",
        search="paper",
        defaults=False,
        place={"mug": "bed"},
        fault=("blocked=bedroom-living_room", "blocked=bedroom-lobby"),
    )
    assert told(chain, "look at bed") == [("", "not reached: the way to the bed is blocked")] * 2
