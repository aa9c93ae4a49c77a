"""Past runs are found by words and by how they ended."""

import json
from pathlib import Path

import pytest
from recordings import record

from executive.errors import InputError
from executive.page.experiment.runs import Runs


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    told = {"command": "Bring the mug", "status": "done", "object": "mug", "visited": ["desk"]}
    (record(tmp_path / "20260101T000000Z-one") / "outcome.json").write_text(json.dumps(told))
    told = {"command": "Find a fruit", "status": "not_done", "reason": "not on the high table"}
    (record(tmp_path / "20260102T000000Z-two") / "outcome.json").write_text(json.dumps(told))
    record(tmp_path / "20260103T000000Z-three")
    (tmp_path / "no run").mkdir()
    return tmp_path


def names(runs: Runs, words: str = "", status: str = "") -> list[str]:
    return [row["run"].rpartition("-")[2] for row in runs.found(words, status)["runs"]]


def test_all_runs_are_listed_the_latest_first(folder: Path) -> None:
    assert names(Runs(folder)) == ["three", "two", "one"]


@pytest.mark.parametrize(
    ("words", "found"),
    [("MUG", ["one"]), ("desk", ["one"]), ("high_table", ["two"]), ("20260102", ["two"])],
)
def test_words_are_looked_for_in_all_that_is_told(
    folder: Path, words: str, found: list[str]
) -> None:
    assert names(Runs(folder), words) == found


def test_of_several_words_each_has_to_be_there(folder: Path) -> None:
    assert names(Runs(folder), "mug bring") == ["one"]
    assert not names(Runs(folder), "mug fruit")


def test_a_run_that_goes_on_or_was_killed_is_unfinished(folder: Path) -> None:
    runs = Runs(folder)
    assert names(runs, status="unfinished") == ["three"]
    ended = folder / "20260103T000000Z-three" / "outcome.json"
    ended.write_text('{"status": "done"}')
    assert names(runs, status="done") == ["three", "one"]


@pytest.mark.parametrize("content", ["", "[]", "[" * 100_000, '{"status": 3, "visited": {}}'])
def test_an_outcome_that_is_none_hides_no_run(folder: Path, content: str) -> None:
    (folder / "20260103T000000Z-three" / "outcome.json").write_text(content)
    assert names(Runs(folder), status="unfinished") == ["three"]


@pytest.mark.parametrize("name", ["", ".", "..", "../one", "no run", "nothing", "/etc"])
def test_only_runs_of_the_folder_are_opened(folder: Path, name: str) -> None:
    with pytest.raises(InputError, match="there is no such run"):
        Runs(folder).path(name)


def test_a_folder_that_is_not_there_has_no_runs(tmp_path: Path) -> None:
    assert Runs(tmp_path / "none").found()["all"] == 0
