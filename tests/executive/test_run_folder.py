"""The folder of a run: a name that every system takes, and files that are whole."""

import errno
import io
import logging
import os
import shutil
from datetime import UTC, datetime
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from executive.app.run_folder import new_folder, write
from executive.app.session import Session
from executive.config import load_settings
from executive.errors import InputError

NOW = datetime(2026, 11, 25, 12, tzinfo=UTC)


@given(st.text(max_size=100) | st.sampled_from(["../../etc", "con", "a" * 100_000, "\0", "/"]))
def test_a_folder_is_named_after_any_words(
    tmp_path_factory: pytest.TempPathFactory, words: str
) -> None:
    runs = tmp_path_factory.getbasetemp() / "runs"
    folder = new_folder(runs, NOW, words)
    assert folder.parent == runs
    assert len(folder.name) < 80
    assert folder.name.replace("-", "").isalnum()


@pytest.mark.parametrize("name", ["a\0b", "x" * 300])
def test_a_folder_that_cannot_be_made_is_a_sentence(tmp_path: Path, name: str) -> None:
    with pytest.raises(InputError, match=r"--runs: cannot make .*; name a folder to write to"):
        new_folder(tmp_path / name, NOW, "Find a mug")


def test_a_session_goes_on_when_no_more_folders_can_be_made(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    runs = tmp_path / "runs"
    settings = load_settings(world="fake", llm="none", user="none", runs=runs)
    with Session(settings, out=io.StringIO()) as session:
        runs.touch()
        with pytest.raises(InputError, match="--runs: cannot make"):
            session.run("Find a mug")
        runs.unlink()
        assert session.run("Find a mug").run_dir
        assert session.is_recorded
        shutil.rmtree(runs)
        runs.touch()
        outcome = session.run("Take the mug")
        assert (outcome.status, outcome.run_dir) == ("done", None)
        assert not session.is_recorded
    assert "the mission goes on without logs: --runs" in caplog.text


def test_a_file_that_a_full_disk_has_no_room_for_is_not_there_by_half(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    assert write(tmp_path / "outcome.json", "the one before")

    def full(path: Path, *_: object, **__: object) -> None:
        path.touch()
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(Path, "write_text", full)
    with caplog.at_level(logging.WARNING):
        assert not write(tmp_path / "outcome.json", "the new one")
    assert "No space left" in caplog.text
    assert [file.read_bytes() for file in tmp_path.iterdir()] == [b"the one before"]


def test_text_with_half_a_character_is_written(tmp_path: Path) -> None:
    write(tmp_path / "tree.txt", "a\ud800b")
    assert (tmp_path / "tree.txt").read_text() == "a\\ud800b"
