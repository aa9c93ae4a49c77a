"""What the tables and plots of an experiment say, and the numbers of the docs."""

import re
from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree

import pytest

from executive.campaign.journal import Row, read_table
from executive.campaign.report import paper
from executive.campaign.report.document import Figure, Heading, Link, Table, to_html, to_markdown
from executive.campaign.report.report import NOT_COMPARED, report, write_report

DOCS = Path(__file__).parents[3] / "docs"
GRIDS = sorted(set(DOCS.glob("experiment-*/")) - {DOCS / "experiment-weeks"})
"""The reports of grids of missions; that of weeks is another one."""


def missions(
    system: str, inquiries: Iterable[int], command: str = "Find a mug.", **more: object
) -> list[Row]:
    base = Row("ours", "four_rooms", "embedded", system, True, 0, command, 0, "find", status="done")
    done = replace(base, completed=True, **more)
    return [replace(done, seed=seed, inquiries=n) for seed, n in enumerate(inquiries)]


def text_of(rows: list[Row]) -> str:
    return to_markdown(report(rows, {}), "plots")


def grid_of_nine() -> list[Row]:
    return [
        row
        for number in range(9)
        for system, asks in (("okb", 1), ("okb+llm", 0), ("okb+llm+mem", int(number == 0)))
        for row in missions(system, [asks, asks], f"Find thing {number}.", visits=2)
    ]


@pytest.mark.usefixtures("no_plots")
def test_the_report_says_what_a_hand_computes() -> None:
    text = text_of([*missions("okb", [1, 1, 1, 1]), *missions("okb+llm", [0, 0, 0, 1])])
    assert "| okb, defaults | 1.00 (0.80) | - | 0.00 (0.40) | 4 |" in text
    assert "| okb+llm, defaults | 0.25 (0.14) | - | 0.50 (0.35) | 4 |" in text
    assert "| defaults | okb - okb+llm | +0.75 | 1.000 (n = 1) | 0.250 (n = 4) |" in text


@pytest.mark.usefixtures("no_plots")
def test_a_system_that_always_asks_shows_in_the_tables() -> None:
    rows = []
    for number in range(9):
        command = f"Find thing {number}."
        rows += missions("okb+llm", [0, 0], command) + missions("okb+llm+mem", [1, 1], command)
    text = text_of(rows)
    assert "| okb+llm+mem, defaults | 1.00 (0.08) |" in text
    assert r"| defaults | okb+llm - okb+llm+mem | -1.00 | 0.004 \*\* (n = 9) |" in text


@pytest.mark.usefixtures("no_plots")
def test_a_policy_that_always_asks_stands_out_beside_the_first() -> None:
    rows = []
    for number in range(9):
        asked = [0, 0], f"Find thing {number}."
        rows += missions("okb+llm", *asked)
        rows += missions("okb+llm", [1, 1], asked[1], policy="always-asks", llm="none")
    text = text_of(rows)
    assert "| okb+llm, defaults | ours | 0.00 |" in text
    assert r"| okb+llm, defaults | always-asks | 1.00 \*\* |" in text


@pytest.mark.usefixtures("no_plots")
def test_what_is_only_said_to_be_done_is_a_failure_with_its_recording(tmp_path: Path) -> None:
    (row,) = missions("okb", [0])
    wrong = replace(row, completed=False, object="mug", truth="sofa", run_dir=f"{tmp_path}/runs/x")
    text = to_markdown(report([wrong], {}, tmp_path / "out"), "plots")
    assert "| okb | 0.0 % (98.0 %) | - | 100.0 % | 0.00 |" in text
    assert "said to be done, but the mug is truly sofa" in text
    assert "[Find a mug (seed 0)](<../runs/x>)" in text


@pytest.mark.usefixtures("no_plots")
def test_only_those_who_asked_a_model_are_in_the_table_of_its_cost() -> None:
    asked = missions("okb+llm", [0], llm_calls=2, llm_s=3.0, thinking_time_s=4.0)
    stand_in = missions("okb+llm", [0], llm="none", llm_calls=1, policy="nearest")
    text = text_of([*asked, *stand_in])
    assert "| ours | list generation [s] | - (35.27) | - (30.79) | 4.00 (10.81) |" in text
    assert "| nearest | list generation" not in text


def test_the_report_in_html_needs_no_other_file(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    write_report(grid_of_nine(), {"seeds": "<2>"}, tmp_path, ())
    page = (tmp_path / "report.html").read_text()
    assert "&lt;2&gt;" in page
    assert page.count("<img") == page.count('src="data:') >= 5
    assert not re.search(r'(src|href)="(?!data:)', page)


def test_the_plots_are_drawings_beside_the_report_in_markdown(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    write_report(grid_of_nine(), {}, tmp_path, ())
    named = re.findall(r"!\[.*\]\((plots/.*\.svg)\)", (tmp_path / "report.md").read_text())
    assert len(named) >= 5
    for name in named:
        assert ElementTree.parse(tmp_path / name).getroot().tag.endswith("svg")


def test_the_same_rows_give_the_same_plots() -> None:
    pytest.importorskip("matplotlib")
    first, second = (report(grid_of_nine(), {}) for _ in range(2))
    assert first == second
    assert sum(isinstance(part, Figure) for part in first) >= 5


@pytest.mark.usefixtures("no_plots")
def test_an_empty_campaign_has_a_report() -> None:
    assert "# Campaign: 0 missions" in text_of([])


def test_a_table_cell_cannot_break_the_table() -> None:
    parts = [Table(["a"], [["1|2\n3"], [[Link("run", "a b")]]]), Heading("x < y", 1)]
    assert "| 1\\|2 3 |\n| [run](<a b>) |" in to_markdown(parts, "plots")
    assert "<h1>x &lt; y</h1>" in to_html(parts)


# --- the numbers in the docs ---


def table_lines(text: str) -> list[str]:
    return [line for line in text.splitlines() if line.startswith("|") and "---" not in line]


@pytest.mark.usefixtures("no_plots")
@pytest.mark.parametrize("folder", GRIDS, ids=lambda path: path.name)
def test_every_table_of_a_committed_report_comes_from_the_committed_results(folder: Path) -> None:
    committed = (folder / "report.md").read_text(encoding="utf-8").split("## Settings")[0]
    homes = () if NOT_COMPARED in committed else (paper.HOME,)
    rows = read_table(folder / "results.parquet")
    again = to_markdown(report(rows, {}, folder, homes), "plots")
    assert table_lines(committed) == table_lines(again.split("## Settings")[0])


def test_every_result_in_the_docs_stands_in_a_committed_report() -> None:
    page = (DOCS / "experiment.md").read_text(encoding="utf-8")
    reports = [file.read_text(encoding="utf-8") for file in DOCS.glob("experiment-*/report.md")]
    committed = {line for text in reports for line in table_lines(text)}
    results = table_lines(page.split("## Results")[1])
    assert len(results) > len(paper.SYSTEMS)
    assert [line for line in results if line not in committed] == []
