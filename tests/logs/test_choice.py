"""A question about one run is about the newest, unless one was named."""

import json
import os
from pathlib import Path

import pytest
from recordings import record

from executive.errors import InputError
from logs.__main__ import main
from logs.recording.choice import newest
from logs.recording.reader import FILE_NAME


@pytest.fixture
def runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Three in `runs`; that called `b` was written last."""
    monkeypatch.chdir(tmp_path)
    for name, written in (("a", 10), ("b", 30), ("c", 20)):
        folder = Path("runs", name)
        folder.mkdir(parents=True)
        (folder / FILE_NAME).touch()
        os.utime(folder / FILE_NAME, (written, written))
    Path("runs/notes.txt").touch()
    return Path("runs")


def test_without_a_name_it_is_the_newest_of_the_folder_of_runs(runs: Path) -> None:
    assert newest([]) == (runs / "b", "the newest of 3")


def test_that_folder_may_stand_in_the_environment(
    runs: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("EXECUTIVE_RUNS", "elsewhere")
    runs.rename("elsewhere")
    assert newest([]).run == Path("elsewhere/b")


def test_of_several_it_is_the_newest_whatever_else_a_pattern_matched(runs: Path) -> None:
    assert newest(sorted(runs.glob("[!b]*"))) == (runs / "c", "the newest of 2")


def test_the_only_run_is_the_newest(runs: Path) -> None:
    for name in ("a", "c"):
        (runs / name / FILE_NAME).unlink()
    assert newest([]) == (runs / "b", "the only run")


def test_of_a_folder_of_runs_it_is_the_newest(runs: Path) -> None:
    assert newest([runs]) == (runs / "b", "the newest of 3")


def test_of_runs_copied_together_it_is_the_one_with_the_latest_name(runs: Path) -> None:
    for file in runs.glob(f"*/{FILE_NAME}"):
        os.utime(file, (5, 5))
    assert newest([]).run == runs / "c"


@pytest.mark.parametrize("named", ["runs/a", "runs/a/mission.mcap", "runs/none"])
def test_what_is_named_alone_is_taken_as_it_is(runs: Path, named: str) -> None:
    assert newest([Path(named)]) == (Path(named), "")


def test_where_there_is_no_run_that_is_said(runs: Path) -> None:
    with pytest.raises(InputError, match=r"runs/notes.txt, runs/x: there is no run"):
        newest([Path("runs/notes.txt"), Path("runs/x")])


@pytest.mark.parametrize(
    "question", ["why", "ticks", "timeline", "llm", "dialog", "frames --out pictures", "recover"]
)
def test_every_question_about_one_run_says_which_it_took(
    question: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    for name in ("one", "other"):
        record(tmp_path / "runs" / name)
    assert main([*question.split(), "--json"]) == 0
    told = capsys.readouterr()
    assert told.err == "runs/other: the newest of 2\n"
    assert main([*question.split(), "--json", "runs/other"]) == 0
    assert capsys.readouterr() == (told.out, "")
    json.loads(told.out)
