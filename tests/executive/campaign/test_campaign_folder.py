"""What a campaign's folder keeps: nothing is lost on a full disk, nothing counts twice."""

import errno
import json
import os
import subprocess
import sys
import threading
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any

import pytest

from executive.campaign import appending, blocks
from executive.campaign.__main__ import main
from executive.campaign.appending import append_line, cut_half_line
from executive.campaign.campaign import as_in_paper, read_commands
from executive.campaign.claim import lock_folder
from executive.campaign.journal import Entry, Journal, Row, write_tables
from executive.campaign.report import paper
from executive.config import load_settings
from executive.errors import InputError

pytestmark = pytest.mark.usefixtures("no_plots")

ROW = Row("ours", "four_rooms", "embedded", "okb+llm", True, 0, "Find a mug.", 0, status="done")


def line_of(row: Row) -> str:
    return json.dumps({**asdict(row), "exchanges": []}) + "\n"


@pytest.fixture
def journal(tmp_path: Path) -> Path:
    return tmp_path / "journal.jsonl"


def write_a_little(monkeypatch: pytest.MonkeyPatch, *room: int | None) -> None:
    """Let each write take so many bytes; None: the disk is full."""
    write, left = os.write, list(room)

    def short(target: int, content: bytes) -> int:
        most = left.pop(0) if left else len(content)
        if most is None:
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        return write(target, content[:most])

    monkeypatch.setattr(appending.os, "write", short)
    monkeypatch.setattr(appending, "_POLL_S", 0.0)


def test_a_line_that_a_full_disk_cuts_short_is_completed_when_there_is_room(
    journal: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    write_a_little(monkeypatch, 3, None, 2, None)
    append_line(journal, b"a whole line\n")
    assert journal.read_bytes() == b"a whole line\n"


@pytest.mark.parametrize(("constant", "value"), [("PATIENCE_S", -1.0), ("_FULL", set())])
def test_of_a_line_that_cannot_be_written_nothing_stays(
    journal: Path, monkeypatch: pytest.MonkeyPatch, constant: str, value: object
) -> None:
    journal.write_bytes(b"before\n")
    write_a_little(monkeypatch, 3, *[None] * 10)
    monkeypatch.setattr(appending, constant, value)
    with pytest.raises(InputError, match=r"journal.jsonl: cannot be written: .*; make room"):
        Journal(journal).append(Entry(ROW))
    assert journal.read_bytes() == b"before\n"


def test_half_a_line_of_a_writer_that_died_does_not_spoil_the_next(journal: Path) -> None:
    journal.write_bytes(b"one\ntw")
    append_line(journal, b"two\n")
    assert journal.read_bytes() == b"one\ntwo\n"


@pytest.mark.parametrize(
    ("before", "after"),
    [(b"", b""), (b"half", b""), (b"a\n", b"a\n"), (b"a\n" + b"b" * 200_000, b"a\n")],
)
def test_what_is_cut_off_is_half_a_line_and_no_more(
    journal: Path, before: bytes, after: bytes
) -> None:
    journal.write_bytes(before)
    cut_half_line(journal)
    assert journal.read_bytes() == after


def test_lines_of_many_writers_stay_whole(journal: Path) -> None:
    def write(letter: str) -> None:
        for _ in range(50):
            append_line(journal, (letter * 500 + "\n").encode())

    writers = [threading.Thread(target=write, args=(letter,)) for letter in "abcd"]
    for writer in writers:
        writer.start()
    for writer in writers:
        writer.join()
    lines = journal.read_text().splitlines()
    assert sorted(lines) == sorted(letter * 500 for letter in "abcd" for _ in range(50))


def test_a_mission_that_is_there_twice_counts_once(journal: Path) -> None:
    journal.write_text(line_of(ROW) + line_of(replace(ROW, visits=3)))
    [entry] = Journal(journal).entries()
    assert entry.row.visits == 3


def test_a_mission_without_a_working_model_never_replaces_a_result(journal: Path) -> None:
    failed = replace(ROW, model_failure="HTTP 429")
    journal.write_text(line_of(failed) + line_of(ROW) + line_of(failed))
    assert [entry.row for entry in Journal(journal).entries()] == [ROW]


def test_a_journal_from_before_models_could_fail_is_read(journal: Path) -> None:
    values = json.loads(line_of(ROW))
    del values["model_failure"]
    journal.write_text(json.dumps(values) + "\n")
    assert [entry.row for entry in Journal(journal).entries()] == [ROW]


DAMAGED = {
    "zeros": "\0" * 40,
    "deep": "[" * 100_000,
    "of another make": '{"policy": "ours"}',
    "no system": line_of(replace(ROW, system="telepathy")).strip(),
    "no number": line_of(ROW).replace('"visits": 0', '"visits": "many"').strip(),
    "no talk": line_of(ROW).replace('"exchanges": []', '"exchanges": 3').strip(),
}


@pytest.mark.parametrize("damage", DAMAGED.values(), ids=DAMAGED)
def test_a_damaged_line_is_named_and_costs_no_other(journal: Path, damage: str) -> None:
    other = replace(ROW, seed=1)
    journal.write_text(f"{line_of(ROW)}{damage}\n{line_of(other)}")
    assert [entry.row for entry in Journal(journal).entries()] == [ROW, other]
    [sentence] = Journal(journal).damage()
    assert "journal.jsonl:2: is not a mission" in sentence


@pytest.mark.parametrize(
    "wrong",
    [{"reason": "\ud800"}, {"inquiries": 2**70}, {"llm_s": float("nan")}, {"path_m": float("inf")}],
)
def test_a_line_of_values_that_no_table_holds_is_damaged(
    journal: Path, wrong: dict[str, Any]
) -> None:
    journal.write_text(line_of(replace(ROW, **wrong)) + line_of(ROW), encoding="utf-8")
    assert [entry.row for entry in Journal(journal).entries()] == [ROW]
    assert len(Journal(journal).damage()) == 1


def test_a_pipe_in_a_campaigns_folder_holds_nothing_up(journal: Path, tmp_path: Path) -> None:
    os.mkfifo(journal)
    os.mkfifo(tmp_path / "lock")
    with pytest.raises(InputError, match="it is no plain file"):
        Journal(journal).mend()
    with pytest.raises(InputError, match="cannot use it: No such device"):
        lock_folder(tmp_path, "--out")


def test_a_spreadsheet_finds_no_formula_in_the_table(tmp_path: Path) -> None:
    write_tables([replace(ROW, command='=HYPERLINK("http://x")')], tmp_path)
    assert "'=HYPERLINK" in (tmp_path / "results.csv").read_text()


# --- one folder, one campaign ---


@pytest.fixture
def options(tmp_path: Path) -> list[str]:
    file = tmp_path / "commands.txt"
    file.write_text("Find an apple.\nTake a mug.\n")
    return ["--seeds", "1", "--commands", str(file), "--out", str(tmp_path / "out")]


def test_a_second_campaign_in_a_folder_is_refused(
    options: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "out").mkdir()
    with lock_folder(tmp_path / "out", "--out"):
        assert main([*options, "--systems", "okb"]) == 2
    assert "out: another campaign is running in it; wait" in capsys.readouterr().err
    assert main([*options, "--systems", "okb"]) == 0


def test_a_lock_ends_with_its_process_even_if_that_is_killed(tmp_path: Path) -> None:
    program = (
        "import sys, time; from pathlib import Path; "
        "from executive.campaign.claim import lock_folder; "
        "lock = lock_folder(Path(sys.argv[1]), '--out'); print('locked', flush=True); "
        "time.sleep(600)"
    )
    with subprocess.Popen(
        [sys.executable, "-c", program, str(tmp_path)], stdout=subprocess.PIPE, text=True
    ) as process:
        assert process.stdout
        assert process.stdout.readline() == "locked\n"
        with pytest.raises(InputError, match="another campaign"):
            lock_folder(tmp_path, "--out")
        process.kill()
        process.wait()
    lock_folder(tmp_path, "--out").close()


def test_a_campaign_that_cannot_write_its_tables_says_so(
    options: list[str], capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(*_: object) -> None:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr("executive.campaign.campaign.write_tables", full)
    assert main([*options, "--systems", "okb"]) == 2
    assert "the tables cannot be written: No space left on device" in capsys.readouterr().err
    monkeypatch.undo()
    assert main([*options, "--systems", "okb"]) == 0


def test_no_mission_is_run_if_it_cannot_be_recorded_as_asked(
    options: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "file").touch()
    runs = tmp_path / "file" / "runs"
    assert main([*options, "--systems", "okb", "--runs", str(runs)]) == 2
    line = f"error: --runs: cannot write to {runs}: Not a directory; name a folder to write to\n"
    assert capsys.readouterr().err == line
    assert not (tmp_path / "out" / "journal.jsonl").exists()


def test_a_damaged_note_of_what_the_folder_is_for_is_a_sentence(
    options: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "campaign.json").write_text("[" * 100_000)
    assert main(options) == 2
    assert "campaign.json is damaged" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("content", "sentence"),
    [
        (b"Find a mug.\x1b[2J\n", "this is no command"),
        (b"Find " + b"a" * 1000, "this is no command"),
        ("Find a mug.".encode("utf-16"), "is not UTF-8 text"),
        (b"#" * (5 << 20), "is larger than 4 MB"),
    ],
)
def test_what_is_no_file_of_commands_is_refused(
    tmp_path: Path, content: bytes, sentence: str
) -> None:
    file = tmp_path / "commands.txt"
    file.write_bytes(content)
    with pytest.raises(InputError, match=sentence):
        read_commands(file)


def test_commands_may_begin_with_a_byte_order_mark(tmp_path: Path) -> None:
    file = tmp_path / "commands.txt"
    file.write_text("Find a mug.\n", encoding="utf-8-sig")
    assert read_commands(file) == ("Find a mug.",)


def test_a_campaign_of_more_missions_than_anyone_waits_for_is_refused(
    options: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    assert main([*options, "--seeds", "1000000000"]) == 2
    assert "more than 1,000,000 missions" in capsys.readouterr().err


# --- a model that is of no help ---


def test_missions_without_a_working_model_are_no_results_and_are_run_again(
    options: list[str],
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    row_of = blocks._row

    def without_a_model(turn: int, key: blocks.Key, *more: object) -> Row:
        return replace(row_of(turn, key, *more), model_failure="HTTP 429 Too Many Requests")

    grid = [*options, "--policy", "nearest", "--systems", "okb", "okb+llm"]
    with monkeypatch.context() as patch:
        patch.setattr(
            blocks,
            "_row",
            lambda turn, key, *more: (
                without_a_model(turn, key, *more)
                if key.system == "okb+llm"
                else row_of(turn, key, *more)
            ),
        )
        assert main(grid) == 1
    told = "4 missions had no working language model (HTTP 429 Too Many Requests)"
    assert told in capsys.readouterr().err
    report = (tmp_path / "out" / "report.md").read_text()
    assert told in report
    assert "# Campaign: 4 missions" in report
    assert "\n| okb+llm | " not in report
    assert "| missions | 4 of 8 |" in report
    assert (tmp_path / "out" / "results.csv").read_text().count("\n") == 1 + 4
    assert main(grid) == 0
    rows = [entry.row for entry in Journal(tmp_path / "out" / "journal.jsonl").entries()]
    assert len(rows) == len({row.key for row in rows}) == 8
    assert not any(row.model_failure for row in rows)
    assert "\n| okb+llm | 100.0 % |" in (tmp_path / "out" / "report.md").read_text()


# --- the paper's figures ---


@pytest.mark.parametrize(
    ("settings", "commands", "homes"),
    [
        ({}, paper.COMMANDS, ("four_rooms",)),
        ({}, paper.COMMANDS[1:], ()),
        ({"home": "four_rooms.toml"}, paper.COMMANDS, ()),
        ({"place": {"mug": "desk"}}, paper.COMMANDS, ()),
        ({"fault": ("miss=0.5",)}, paper.COMMANDS, ()),
    ],
)
def test_what_the_paper_did_is_its_commands_in_its_home_as_it_is(
    settings: dict[str, Any], commands: tuple[str, ...], homes: tuple[str, ...]
) -> None:
    assert as_in_paper([load_settings(**settings)], commands) == homes


def test_the_papers_figures_stand_beside_its_own_commands_in_its_own_home_only(
    options: list[str], tmp_path: Path
) -> None:
    report = tmp_path / "out" / "report.md"
    main([*options, "--systems", "okb"])
    assert "(98.0 %)" not in report.read_text()
    assert "The paper's figures are not beside these" in report.read_text()
    main(["--seeds", "1", "--systems", "okb", "--out", str(tmp_path / "out2")])
    assert "(98.0 %)" in (tmp_path / "out2" / "report.md").read_text()
