"""What is kept to be quick is one's own, and nothing is lost with it."""

from pathlib import Path

import pytest

from executive.cache import cache_folder
from executive.language import reader
from executive.language.meaning import Request
from executive.language.reader import Reader

WORDS = "Bring me the mug from the desk"


@pytest.fixture
def base(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    return tmp_path


def read_anew() -> Reader:
    """As in another process, which has no tables in its memory."""
    reader._parser.cache_clear()
    return Reader()


def test_a_grammar_is_read_the_same_when_its_tables_are_kept(base: Path) -> None:
    first = read_anew().read(WORDS)
    [kept] = (base / "robot-executive").iterdir()
    written = kept.stat().st_mtime_ns
    assert read_anew().read(WORDS) == first
    assert isinstance(first, Request)
    assert kept.stat().st_mtime_ns == written


@pytest.mark.parametrize("content", [b"", b"no tables\nat all", None])
def test_tables_that_are_damaged_are_made_anew(base: Path, content: bytes | None) -> None:
    read_anew()
    [kept] = (base / "robot-executive").iterdir()
    whole = kept.read_bytes()
    kept.write_bytes(whole[: len(whole) // 2] if content is None else content)
    assert isinstance(read_anew().read(WORDS), Request)
    anew = kept.read_bytes()
    assert len(anew) > len(whole) // 2
    assert isinstance(read_anew().read(WORDS), Request)
    assert kept.read_bytes() == anew


def test_a_folder_in_which_others_may_write_is_not_used(base: Path) -> None:
    folder = cache_folder()
    assert folder == base / "robot-executive"
    folder.chmod(0o777)
    assert cache_folder() is None
    assert isinstance(read_anew().read(WORDS), Request)
    assert not list(folder.iterdir())


def test_without_a_place_for_it_nothing_is_kept(base: Path) -> None:
    (base / "robot-executive").write_text("a file")
    assert cache_folder() is None
    assert isinstance(read_anew().read(WORDS), Request)


def test_the_environment_names_another_folder_or_none(
    base: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("EXECUTIVE_CACHE", str(tmp_path / "mine"))
    assert cache_folder("read") == tmp_path / "mine" / "read"
    assert (tmp_path / "mine" / "read").stat().st_mode & 0o777 == 0o700
    monkeypatch.setenv("EXECUTIVE_CACHE", "none")
    assert cache_folder("read") is None
    assert not (base / "robot-executive").exists()


def test_a_part_in_which_others_may_write_is_not_used(base: Path) -> None:
    part = cache_folder("read")
    assert part
    part.chmod(0o722)
    assert cache_folder("read") is None
