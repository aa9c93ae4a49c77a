from dataclasses import replace
from math import inf
from pathlib import Path

import pytest

from executive.campaign.__main__ import main
from executive.campaign.report.document import Table, to_markdown
from executive.campaign.weeks.household import Household, live
from executive.campaign.weeks.lived import Diary, Line, Lived, read_line, read_table
from executive.campaign.weeks.report import report
from executive.config import load_settings


def household(policy: str = "memory", days: int = 1, seed: int = 0) -> Household:
    settings = load_settings(world="fake", user="oracle", habits="household", llm="none", seed=seed)
    return Household(settings, policy, days)


def told(line: Line) -> Line:
    """Without what differs from run to run."""
    return replace(line, lived=replace(line.lived, wall_time_s=0.0))


@pytest.fixture(scope="module")
def two_days() -> list[Line]:
    return list(live(household("plan", days=2)))


def test_a_household_gives_ten_commands_a_day_at_hours_that_its_seed_draws(
    two_days: list[Line],
) -> None:
    assert [line.lived.day for line in two_days] == [0] * 10 + [1] * 10
    hours = [line.lived.hour for line in two_days[:10]]
    assert hours == sorted(hours)
    assert household().orders(0) == household("plan").orders(0) != household(seed=1).orders(0)
    assert all(line.lived.completed for line in two_days)


def test_what_was_brought_stays_where_it_was_left(two_days: list[Line]) -> None:
    brought = [line for line in two_days if line.lived.command.startswith("Bring")]
    assert brought
    assert all(line.things[line.lived.object] == "delivery" for line in brought)


def test_things_wander_from_day_to_day(two_days: list[Line]) -> None:
    asked = {line.lived.object for line in two_days}
    first, last = two_days[0].things, two_days[-1].things
    assert any(first[name] != last[name] for name in first if name not in asked)


def test_what_was_seen_is_remembered_the_next_day(two_days: list[Line]) -> None:
    later = {line.lived.source for line in two_days[10:]}
    assert later & {"memory", "habits"}


def test_a_life_that_was_cut_short_goes_on_as_if_it_had_not_been(two_days: list[Line]) -> None:
    again = list(live(household("plan", days=2), two_days[:14]))
    assert [told(line) for line in again] == [told(line) for line in two_days[10:]]


def test_a_life_that_is_whole_is_not_lived_again(two_days: list[Line]) -> None:
    assert not list(live(household("plan", days=2), two_days))


def test_a_line_is_read_as_it_was_written(two_days: list[Line]) -> None:
    assert read_line(two_days[0].to_json().encode()) == two_days[0]


@pytest.mark.parametrize("text", [b"{", b"[]", b'{"time_s": 1}', b'{"time_s": "x", "things": {}}'])
def test_a_line_that_is_none_is_named_and_left_out(tmp_path: Path, text: bytes) -> None:
    file = tmp_path / "journal.jsonl"
    file.write_bytes(text + b"\n")
    assert Diary(file).entries() == []
    assert len(Diary(file).damage()) == 1


def lived(**known: object) -> Lived:
    usual = Lived("plan", "four_rooms", "none", 0, 0, 0, 9.0, "Find the mug", completed=True)
    return replace(usual, **known)  # type: ignore[arg-type]


@pytest.mark.parametrize("known", [{"inquiries": 2**70}, {"cost_s": inf}, {"reason": "\ud800"}])
def test_a_line_that_no_table_takes_is_named_and_left_out(known: dict[str, object]) -> None:
    read = read_line(Line(lived(**known), 0.0, {}, ()).to_json().encode())
    assert isinstance(read, str)
    assert next(iter(known)) in read


def tables(rows: list[Lived]) -> list[Table]:
    return [part for part in report(rows, {}) if isinstance(part, Table)]


def test_the_report_tells_each_policy_week_by_week() -> None:
    rows = [
        lived(day=0, inquiries=1),
        lived(day=6),
        lived(day=7, stale=1),
        lived(policy="paper", day=0),
    ]
    _, questions, _, stale, *_ = tables(rows)
    assert questions.rows == [["plan", "0.50", "0.00"], ["paper", "0.00"]]
    assert stale.rows == [["plan", "0.00", "100.00"], ["paper", "0.00"]]


def test_every_table_of_the_committed_report_comes_from_the_committed_results() -> None:
    folder = Path(__file__).parents[3] / "docs" / "experiment-weeks"
    committed = (folder / "report.md").read_text(encoding="utf-8").split("## Settings")[0]
    parts = report(read_table(folder / "results.parquet"), {})
    again = to_markdown(parts, "plots").split("## Settings")[0]
    assert again == committed


def test_a_robot_that_always_asks_shows() -> None:
    rows = [lived(day=day, inquiries=1, visits=1) for day in range(7)]
    assert tables(rows)[0].rows[0][1] == "1.00 (1.00 to 1.00)"


def test_the_command_writes_a_report_and_goes_on_where_it_was_stopped(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("executive.campaign.weeks.watching.DAYS_A_WEEK", 1)
    words = ["--weeks", "1", "--seeds", "1", "--policy", "memory", "--out", str(tmp_path)]
    assert main(words) == 0
    before = (tmp_path / "journal.jsonl").read_text()
    assert main(words) == 0
    assert (tmp_path / "journal.jsonl").read_text() == before
    assert len(read_table(tmp_path / "results.parquet")) == 10
    assert "Weeks: 10 commands" in (tmp_path / "report.md").read_text()
    assert "<svg" in (tmp_path / "plots" / "weeks.svg").read_text()


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (["--runs", "x"], "--runs: a household of weeks has none; leave --runs or --weeks out"),
        (["--cluster", "x"], "--cluster: a household of weeks has none"),
        (["--habits", "monks"], "there are no habits of this name"),
        (["--policy", "no:where"], "--policy"),
    ],
)
def test_options_that_do_not_fit_are_refused(
    tmp_path: Path, words: list[str], sentence: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["--weeks", "1", "--out", str(tmp_path / "out"), *words]) == 2
    assert sentence in capsys.readouterr().err


def test_habits_without_weeks_are_refused(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["--habits", "household"]) == 2
    assert "nobody lives in a grid of missions; add --weeks 8" in capsys.readouterr().err


def test_more_weeks_than_anybody_waits_for_are_refused() -> None:
    assert main(["--weeks", "100000"]) == 2
