"""What docs/study.md says of the file and the tables is all that there is."""

import re
from dataclasses import fields
from pathlib import Path

import pytest

from executive.page.study.file import Study
from executive.page.study.tables import AnswerRow, InterventionRow, ScoreRow, TaskRow

PAGE = (Path(__file__).parents[4] / "docs/study.md").read_text("utf-8")


@pytest.mark.parametrize(
    ("name", "kind"),
    [
        ("results", TaskRow),
        ("answers", AnswerRow),
        ("scores", ScoreRow),
        ("interventions", InterventionRow),
    ],
)
def test_each_column_of_a_table_is_told(name: str, kind: type) -> None:
    line = next(line for line in PAGE.splitlines() if line.startswith(f"| `{name}` |"))
    columns = {field.name for field in fields(kind)}
    told = set(re.findall(r"`(\w+)`", line)) - {name, "finished", "gave_up", "time"}
    assert told == columns


def test_each_key_of_the_file_is_told() -> None:
    table = PAGE.split("## The file")[1].split("**Order.**")[0]
    assert all(re.search(rf"[`\[]{key}[`\].]", table) for key in Study.model_fields)
