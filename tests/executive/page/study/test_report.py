"""A study's report tells what came of it by condition, with paired tests."""

from pathlib import Path
from typing import Any

import pytest

from executive.campaign.report.document import Table
from executive.errors import InputError
from executive.page.study.data import StudyData
from executive.page.study.file import Study
from executive.page.study.measures import Measure, of_questionnaires, of_tasks
from executive.page.study.report import by_condition, report, write_report
from executive.page.study.steps import Kind, steps
from executive.page.study.tables import tables

NAMES = ("fast", "slow")
STUDY = Study.model_validate(
    {
        "title": "Fast or slow",
        "consent": "Yes?",
        "instructions": "Talk.",
        "conditions": [{"name": name, "settings": {"seed": 1}} for name in NAMES],
        "tasks": [{"name": "t", "text": "Do."}, {"name": "u", "text": "Do."}],
        "after_each": ["sus", "free"],
        "at_end": ["godspeed"],
        "questionnaires": {
            "free": {"title": "F", "items": [{"name": "w", "text": "Why?", "answer": "words"}]}
        },
    }
)
POINTS = {"fast": 5, "slow": 2}


def goes_through(data: StudyData, code: str, number: int) -> None:
    """Fast is faster for everybody, and liked better."""
    with data.one(code) as journal:
        for step in steps(data.study, number):
            where: dict[str, Any] = {"condition": step.condition, "position": step.position}
            if step.kind == Kind.TASK:
                took = 10.0 + number + 20.0 * (step.condition == "slow")
                task = {"task": step.name, "turn": step.turn, "duration_s": took}
                journal.append("task", done=step.key, ended="finished", **task, **where)
            elif step.kind == Kind.QUESTIONNAIRE:
                items = data.study.questionnaire(step.name).items
                points = POINTS.get(step.condition, 3)
                answers: dict[str, int | str] = {
                    item.name: 6 - points if item.reversed else points for item in items
                }
                if step.name == "free":
                    answers = {"w": f"<b>{code}</b>"}
                journal.append("answers", questionnaire=step.name, answers=answers, **where)
        journal.append("finished")


@pytest.fixture
def data(tmp_path: Path) -> StudyData:
    made = StudyData(tmp_path / "data", STUDY)
    for number in range(1, 9):
        goes_through(made, f"P{number:02}", number)
    return made


def test_a_participant_is_one_number_in_each_condition(data: StudyData) -> None:
    time = next(one for one in of_tasks(tables(data), NAMES) if one.name == "time for a task [s]")
    assert time.values["fast"]["P03"] == 13.0
    summary = time.summary("slow")
    assert summary is not None
    assert (summary.n, summary.mean) == (8, 34.5)


def test_a_difference_that_all_show_is_told(data: StudyData) -> None:
    [sus] = of_questionnaires(tables(data), NAMES)
    [one] = sus.comparisons()
    assert (one.a, one.b, one.pairs, one.difference) == ("fast", "slow", 8, 75.0)
    assert one.p < 0.01


def test_what_never_happened_has_no_line(data: StudyData) -> None:
    names = [one.name for one in of_tasks(tables(data), NAMES)]
    assert names == ["tasks done, say participants [%]", "time for a task [s]"]


def test_who_met_one_condition_only_is_no_pair(tmp_path: Path) -> None:
    data = StudyData(tmp_path / "data", STUDY)
    goes_through(data, "P01", 1)
    with data.one("P02") as journal:
        task = {"task": "t", "turn": 1, "duration_s": 1.0, "ended": "gave_up"}
        journal.append("task", done="task/slow/t", condition="slow", position=1, **task)
    time = next(one for one in of_tasks(tables(data), NAMES) if one.name == "time for a task [s]")
    assert [one.pairs for one in time.comparisons()] == [1]


def test_it_is_written_with_its_plots_and_as_one_page(data: StudyData) -> None:
    html = write_report(data).read_text()
    assert "<svg" not in html  # plots are pictures in it
    assert html.count("data:image/svg+xml") == 2
    assert "&lt;b&gt;P01&lt;/b&gt;" in html
    assert {path.name for path in (data.folder / "plots").iterdir()} == {
        "tasks.svg",
        "questionnaires.svg",
    }


def test_it_says_how_often_each_condition_came_when(data: StudyData) -> None:
    found = [part for part in report(data, tables(data)) if isinstance(part, Table)]
    places = next(table for table in found if table.heads[0] == "condition" and "1" in table.heads)
    assert [list(row) for row in places.rows] == [["fast", "4", "4"], ["slow", "4", "4"]]


def test_what_was_asked_outside_of_the_conditions_is_told_apart(data: StudyData) -> None:
    found = [part for part in report(data, tables(data)) if isinstance(part, Table)]
    outside = next(table for table in found if "all" in table.heads)
    assert [row[0] for row in outside.rows][:2] == [
        "godspeed: anthropomorphism",
        "godspeed: animacy",
    ]
    assert [one.name for one in of_questionnaires(tables(data), NAMES)] == ["sus"]


def test_without_data_there_is_none(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="no task is over yet; lead a participant first"):
        write_report(StudyData(tmp_path / "data", STUDY))


def test_one_participant_has_no_interval() -> None:
    measure = Measure("stops", {"calm": {"P01": 3.0}, "hasty": {"P01": 1.0, "P02": 2.0}})
    (line,) = by_condition([measure], ["calm", "hasty"]).rows
    assert line[1] == "3.0, n = 1"
    assert " to " in line[2]
