"""What a model has read is kept for other processes, and never trusted blindly."""

from pathlib import Path

import pytest

from executive.events import Ended, Inbox
from executive.testing.bench import ontology
from executive.types import Scored
from kb.advice.ranker import Ranker
from kb.llm.kept import Kept
from kb.llm.llama import LlamaCpp, embedded_model


@pytest.fixture
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Where it is kept."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    return tmp_path / "robot-executive" / "read"


def test_what_is_kept_is_found_by_all_that_it_depends_on(cache: Path):
    Kept("this model").put_numbers([1.0, 2.0], "state", "mug")
    assert Kept("this model").numbers(2, "state", "mug").tolist() == [1.0, 2.0]
    assert Kept("that model").numbers(2, "state", "mug") is None
    assert Kept("this model").numbers(2, "state", "cup") is None


def test_numbers_that_are_too_few_or_none_are_not_found(cache: Path):
    kept = Kept()
    kept.put_numbers([1.0, float("nan")], "mug")
    assert kept.numbers(2, "mug") is None
    assert kept.numbers(3, "mug") is None


def test_what_is_damaged_is_not_found(cache: Path):
    kept = Kept()
    kept.put(b"many bytes", "mug")
    [path] = cache.iterdir()
    path.write_bytes(path.read_bytes()[:-1])
    assert kept.get("mug") is None


def test_where_nothing_can_be_kept_nothing_is(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    (tmp_path / "file").touch()
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "file"))
    kept = Kept()
    kept.put(b"many bytes", "mug")
    assert kept.get("mug") is None


def test_of_too_many_files_the_oldest_go(cache: Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr("kb.llm.kept.MOST_FILES", 2)
    for name in ("mug", "cup", "jar"):
        Kept().put(b"many bytes", name)
    assert len(list(cache.iterdir())) == 3
    assert Kept().get("jar") == b"many bytes"
    assert len(list(cache.iterdir())) == 2


def rank(thing: str) -> Scored:
    """Ask a model that was just loaded where the thing is."""
    model = LlamaCpp(embedded_model(), inbox := Inbox(), n_ctx=1024, threads=1)
    model.rank(Ranker(ontology(True)).ranking(thing, ()))
    assert inbox.wait(60)
    model.close()
    [event] = inbox.take_all()
    assert isinstance(event, Ended)
    assert isinstance(event.result, Scored)
    return event.result


@pytest.mark.llm
def test_the_next_process_reads_only_what_is_about_its_own_thing(cache: Path):
    first, second = rank("hammer"), rank("hammer")
    assert second.scores == first.scores
    assert second.usage.input_tokens == first.usage.input_tokens
    assert second.usage.evaluated_tokens < 70 < 300 < first.usage.evaluated_tokens


@pytest.mark.llm
def test_what_is_damaged_is_read_anew(cache: Path):
    first = rank("hammer")
    for path in cache.iterdir():
        path.write_bytes(path.read_bytes()[:-8] + bytes(8))
    second = rank("hammer")
    assert second.scores == first.scores
    assert second.usage.evaluated_tokens == first.usage.evaluated_tokens
