"""The experiment: its grid, its journal, resuming, and what the tables say."""

import json
import multiprocessing
import os
import signal
import subprocess
import sys
from collections.abc import Iterable
from io import StringIO
from pathlib import Path

import pytest
from patience import PATIENCE_S, until

from executive.app.session import Session
from executive.campaign import blocks
from executive.campaign.__main__ import main, parser
from executive.campaign.campaign import Campaign
from executive.campaign.folder import Progress, clock
from executive.campaign.journal import Journal, Row, in_order, read_table
from executive.config import KnowledgeSystem, load_settings
from executive.events import Inbox
from executive.types.outcome import Outcome
from kb.llm.scripted import Scripted
from sim.home.home_file import home_text
from sim.tools.generation import generate_home

pytestmark = pytest.mark.usefixtures("no_plots")

COMMANDS = ("Find an apple.", "Find a power_drill.", "Take a mug.")


@pytest.fixture
def grid(tmp_path: Path) -> list[str]:
    file = tmp_path / "commands.txt"
    file.write_text("# three of the paper's\n\n" + "\n".join(COMMANDS))
    out = str(tmp_path / "out")
    return ["--llm", "none", "--seeds", "2", "--commands", str(file), "--out", out]


def rows_of(out: Path) -> list[Row]:
    return [entry.row for entry in Journal(out / "journal.jsonl").entries()]


def test_each_condition_command_and_seed_is_one_row(grid: list[str], tmp_path: Path) -> None:
    assert main(grid) == 0
    rows = rows_of(tmp_path / "out")
    assert len(rows) == len({row.key for row in rows}) == 3 * 2 * 3 * 2
    assert all(row.completed for row in rows)


def test_the_tables_hold_what_the_journal_holds(grid: list[str], tmp_path: Path) -> None:
    main(grid)
    rows = in_order(rows_of(tmp_path / "out"))
    assert read_table(tmp_path / "out" / "results.parquet") == rows
    assert (tmp_path / "out" / "results.csv").read_text().count("\n") == len(rows) + 1


def test_missions_leave_no_folders_unless_asked_to(grid: list[str], tmp_path: Path) -> None:
    main([*grid, "--systems", "okb", "--seeds", "1"])
    assert {row.run_dir for row in rows_of(tmp_path / "out")} == {""}
    recorded = [*grid, "--systems", "okb", "--seeds", "1", "--out", str(tmp_path / "again")]
    main([*recorded, "--runs", str(tmp_path / "runs")])
    folders = {row.run_dir for row in rows_of(tmp_path / "again")}
    assert folders == {str(folder) for folder in (tmp_path / "runs").iterdir()}
    assert len(folders) == 6


def test_a_stopped_campaign_goes_on_where_it_was(
    grid: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    run, count = Session.run, 0

    def run_until_stopped(session: Session, words: str) -> Outcome:
        nonlocal count
        count += 1
        if count == 8:
            raise KeyboardInterrupt
        return run(session, words)

    monkeypatch.setattr(Session, "run", run_until_stopped)
    assert main(grid) == 130
    before = rows_of(tmp_path / "out")
    assert len(before) == 7
    assert "7 of 36" in (tmp_path / "out" / "report.md").read_text()
    assert main(grid) == 0
    after = rows_of(tmp_path / "out")
    assert after[:7] == before
    assert len(after) == len({row.key for row in after}) == 36
    assert count == 1 + 36


def test_half_a_line_left_by_a_power_failure_is_run_again(grid: list[str], tmp_path: Path) -> None:
    main(grid)
    journal = tmp_path / "out" / "journal.jsonl"
    journal.write_bytes(journal.read_bytes()[:-20])
    main(grid)
    rows = rows_of(tmp_path / "out")
    assert len(rows) == len({row.key for row in rows}) == 36


def test_more_seeds_extend_a_campaign(grid: list[str], tmp_path: Path) -> None:
    main([*grid, "--seeds", "1"])
    first = rows_of(tmp_path / "out")
    main(grid)
    assert rows_of(tmp_path / "out")[: len(first)] == first


def test_a_crash_is_a_row_with_its_reason(
    grid: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    run = Session.run

    def run_or_break(session: Session, words: str) -> Outcome:
        if "drill" in words:
            raise ZeroDivisionError("the floor is lava")
        return run(session, words)

    monkeypatch.setattr(Session, "run", run_or_break)
    assert main(grid) == 0
    rows = rows_of(tmp_path / "out")
    crashed = [row for row in rows if row.status == "crashed"]
    assert len(crashed) == 12
    assert {row.reason for row in crashed} == {"ZeroDivisionError: the floor is lava"}
    assert all(row.completed for row in rows if row not in crashed)
    text = (tmp_path / "out" / "report.md").read_text()
    assert "| okb | 66.7 % |" in text
    crash = "| crashed | ZeroDivisionError: the floor is lava | ours | okb, defaults | 2 |"
    assert f"{crash} not recorded |" in text


def test_a_folder_with_other_settings_is_refused(
    grid: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    main([*grid, "--seeds", "1"])
    assert main([*grid, "--top", "3"]) == 2
    assert "other settings" in capsys.readouterr().err


@pytest.mark.parametrize("text", ["", "# nothing\n", "Find a mug.\nFind a mug.\n"])
def test_a_commands_file_without_commands_or_with_one_twice_is_refused(
    text: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "c").write_text(text)
    assert main(["--commands", str(tmp_path / "c"), "--out", str(tmp_path / "out")]) == 2
    assert "one command a line" in capsys.readouterr().err


def test_worker_processes_give_the_same_rows(grid: list[str], tmp_path: Path) -> None:
    def told(out: Path) -> list[tuple[object, ...]]:
        return [(r.key, r.turn, r.visited, r.inquiries) for r in in_order(rows_of(out))]

    main(grid)
    assert main([*grid, "--workers", "2", "--out", str(tmp_path / "two")]) == 0
    assert told(tmp_path / "two") == told(tmp_path / "out")


def test_a_killed_worker_costs_no_mission(
    grid: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    options = parser().parse_args([*grid, "--workers", "2", "--seeds", "4"])
    killed: list[int] = []

    def kill_one(progress: Progress) -> None:
        if len(rows_of(tmp_path / "out")) > 3 and not killed:
            killed.append(children()[0])
            os.kill(killed[0], signal.SIGKILL)

    monkeypatch.setattr(Progress, "__call__", kill_one)
    assert Campaign(options).run() == 0
    rows = rows_of(tmp_path / "out")
    assert killed
    assert len(rows) == len({row.key for row in rows}) == 3 * 2 * 3 * 4


def children() -> list[int]:
    return [p.pid for p in multiprocessing.active_children() if p.pid]


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGHUP])
def test_a_signal_to_all_ends_the_workers_and_keeps_their_missions(
    number: signal.Signals, grid: list[str], tmp_path: Path
) -> None:
    command = [sys.executable, "-m", "executive.campaign", *grid, "--workers", "2", "--seeds", "40"]
    process = subprocess.Popen(command, stderr=subprocess.PIPE, start_new_session=True)
    journal = tmp_path / "out" / "journal.jsonl"
    until(lambda: journal.exists() and journal.stat().st_size, "the first mission")
    os.killpg(process.pid, number)
    said = process.communicate(timeout=PATIENCE_S)[1]
    assert process.returncode == 130
    assert b"Traceback" not in said
    assert b"leak" not in said
    rows = rows_of(tmp_path / "out")
    assert 0 < len(rows) < 720
    assert len(rows) == len({row.key for row in rows})
    assert json.loads((tmp_path / "out" / "campaign.json").read_text())["commands"]
    assert len(read_table(tmp_path / "out" / "results.parquet")) == len(rows)


def test_every_system_gets_the_commands_in_the_same_order() -> None:
    orders = {
        (h.settings.seed, h.commands)
        for h in blocks.grid([load_settings()], ["ours"], list(KnowledgeSystem), COMMANDS, 20)
    }
    assert len(orders) == 20
    assert len({order for _, order in orders}) > 1


def household_that_writes(
    monkeypatch: pytest.MonkeyPatch, system: str
) -> tuple[blocks.Block, list[Scripted]]:
    models: list[Scripted] = []

    def build(settings: object, inbox: Inbox) -> Scripted:
        places = ("dining_table", "shelf_lobby", "coffee_table")
        replies = [json.dumps({"places": [place]}) for place in places]
        models.append(Scripted(replies, inbox))
        return models[0]

    monkeypatch.setattr(blocks, "model_for_missions", build)
    settings = load_settings(
        world="fake", user="oracle", knowledge=system, defaults=False, elicit="generate"
    )
    return blocks.Block(settings, COMMANDS), models


def prompts(models: Iterable[Scripted]) -> list[int]:
    return [len(request.messages) for model in models for request in model.requests]


@pytest.mark.parametrize(("system", "lengths"), [("okb+llm", 2), ("okb+llm+mem", 6)])
def test_the_dialogue_spans_the_commands_only_with_a_memory(
    monkeypatch: pytest.MonkeyPatch, system: str, lengths: int
) -> None:
    block, models = household_that_writes(monkeypatch, system)
    entries = list(blocks.run(block))
    assert [entry.row.visited for entry in entries] == [
        "dining_table",
        "shelf_lobby",
        "coffee_table",
    ]
    assert prompts(models)[-1] == lengths


def test_a_resumed_household_remembers_what_was_said_before(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    block, models = household_that_writes(monkeypatch, "okb+llm+mem")
    whole = list(blocks.run(block))
    said = models[0].requests[1].messages
    block, models = household_that_writes(monkeypatch, "okb+llm+mem")
    next(blocks.run(block, whole[:1]))
    assert models[0].requests[0].messages == said


def test_time_left_reads_as_a_clock() -> None:
    assert clock(3725.4) == "1:02:05"


def test_progress_goes_by_the_pace_of_this_run_and_not_by_what_was_done_before() -> None:
    done, out = 10, StringIO()
    progress = Progress(30, lambda: done, out)
    progress.show()
    assert not out.getvalue()
    done = 20
    progress._began -= 60
    progress.show()
    assert "20 of 30 missions, 0:01:00 left" in out.getvalue()


def test_more_policies_and_homes_extend_a_campaign(grid: list[str], tmp_path: Path) -> None:
    main([*grid, "--seeds", "1", "--systems", "okb+llm"])
    first = rows_of(tmp_path / "out")
    home = tmp_path / "other.toml"
    home.write_text(home_text("four_rooms"))
    more = ["--policy", "ours", "--policy", "nearest", "--home", "four_rooms", "--home", str(home)]
    main([*grid, "--seeds", "1", "--systems", "okb+llm", *more])
    rows = rows_of(tmp_path / "out")
    assert rows[: len(first)] == first
    assert {(row.policy, row.home) for row in rows} == {
        (policy, home) for policy in ("ours", "nearest") for home in ("four_rooms", "other")
    }
    assert "| nearest, other |" in (tmp_path / "out" / "report.md").read_text()


def test_a_generated_home_can_be_searched(grid: list[str], tmp_path: Path) -> None:
    file = tmp_path / "big.toml"
    file.write_text(generate_home(rooms=6, furniture=20, seed=3))
    assert main([*grid, "--seeds", "1", "--policy", "true-first", "--home", str(file)]) == 0
    rows = rows_of(tmp_path / "out")
    assert all(row.completed for row in rows)
    assert all(row.spl == 1.0 for row in rows if not row.defaults)


def test_two_homes_of_one_name_are_refused(
    grid: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main([*grid, "--home", "a/flat.toml", "--home", "b/flat.toml"]) == 2
    assert "--home" in capsys.readouterr().err


def test_policies_that_would_not_be_run_are_refused(
    grid: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main([*grid, "--systems", "okb", "--policy", "plan", "--policy", "nearest"]) == 2
    assert "--policy: okb asks no model" in capsys.readouterr().err
    assert not (tmp_path / "out").exists()


def test_a_campaign_of_no_seeds_is_refused() -> None:
    with pytest.raises(SystemExit):
        parser().parse_args(["--seeds", "0"])


@pytest.mark.parametrize("text", ["x", "0", "-1", "1.5", "9" * 5000])
def test_what_is_no_number_of_weeks_is_told(text: str, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        parser().parse_args([f"--weeks={text}"])
    assert "argument --weeks: should be 1 or more" in capsys.readouterr().err
