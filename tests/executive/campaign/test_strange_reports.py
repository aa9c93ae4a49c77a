"""A report of commands and recordings of strangers: words stay words, links stay in the folder."""

from pathlib import Path

import pytest

from executive.campaign.journal import Row
from executive.campaign.report.document import Link, Table, to_html, to_markdown
from executive.campaign.report.report import not_counted, report

pytestmark = pytest.mark.usefixtures("no_plots")

HOSTILE = "Find <script>alert(1)</script> ![x](http://x/y.png)\x1b[2J\u202e|`a`"


def row(**more: object) -> Row:
    return Row("ours", "four_rooms", "none", "okb", True, 0, HOSTILE, 0, reason=HOSTILE, **more)


def test_words_of_a_command_are_neither_tags_nor_links_nor_control_characters() -> None:
    parts = report([row(status="not_done", run_dir="/runs/x")], {"commands": HOSTILE})
    page, text = to_html(parts), to_markdown(parts, "plots")
    assert "<script" not in page
    assert "<script" not in text
    assert "](http" not in text
    for document in (page, text):
        assert "\x1b" not in document
        assert "\u202e" not in document
        assert r"\x1b[2J\u202e" in document


@pytest.mark.parametrize("target", ["javascript:alert(1)", 'x" onclick="y', "a>b\n[c](http://x)"])
def test_a_link_leads_to_a_folder_and_nowhere_else(target: str) -> None:
    table = [Table(["recordings"], [[[Link("run", target)]]])]
    page, text = to_html(table), to_markdown(table, "plots")
    for document in (page, text):
        assert "javascript:" not in document
        assert 'onclick="' not in document
        assert "(http" not in document


@pytest.mark.parametrize(
    ("reasons", "sentence"),
    [
        (["HTTP 429"], "1 mission had no working language model (HTTP 429) and is not counted;"),
        (["a", "b", "b"], "3 missions had no working language model (b, 2 times) and are not"),
    ],
)
def test_how_many_missions_had_no_working_model_is_said_with_the_commonest_reason(
    reasons: list[str], sentence: str
) -> None:
    assert sentence in not_counted([row(model_failure=reason) for reason in reasons])


def test_a_report_of_missions_without_a_model_has_empty_tables(tmp_path: Path) -> None:
    text = to_markdown(report([row(model_failure="HTTP 429")], {}, tmp_path), "plots")
    assert "# Campaign: 0 missions" in text
    assert "1 mission had no working language model" in text


def test_systems_that_share_commands_but_no_seed_are_compared_by_command_alone() -> None:
    done = {"status": "done", "completed": True}
    rows = [
        Row("ours", "four_rooms", "default", system, False, seed, "Find an apple.", 0, **done)
        for system, seed in (("okb", 0), ("okb+llm", 1))
    ]
    text = to_markdown(report(rows, {}), "plots")
    assert "| no defaults | okb - okb+llm | +0.00 | 1.000 (n = 1) | - |" in text
