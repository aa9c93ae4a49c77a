"""What a model has read is kept for other processes, and never trusted blindly."""

import os
import random
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from patience import PATIENCE_S

from executive.events import Ended, Inbox
from executive.testing.bench import ontology
from executive.types.results import Replied, Scored
from kb.advice.lister import Lister
from kb.advice.ranker import Ranker
from kb.llm.kept import Kept
from kb.llm.llama import LlamaCpp, embedded_model
from kb.llm.options import ModelOptions


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


@given(at=st.integers(0, 41), byte=st.integers(0, 255), length=st.integers(0, 60))
@settings(
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow], deadline=None
)
def test_whatever_is_changed_in_a_file_it_is_as_it_was_or_not_there(cache, at, byte, length):
    kept = Kept()
    kept.put(b"many bytes", "mug")
    [path] = cache.iterdir()
    whole = path.read_bytes()
    changed = (whole[:at] + bytes([byte]) + whole[at + 1 :]).ljust(length, b"-")[:length]
    path.write_bytes(changed)
    assert kept.get("mug") == (b"many bytes" if changed == whole else None)


def moved(path: Path) -> None:
    """Another piece under its name."""
    other = Kept()
    other.put(b"other bytes", "cup")
    [there] = (one for one in path.parent.iterdir() if one != path)
    there.replace(path)


def linked_to_nothing(path: Path) -> None:
    path.unlink()
    path.symlink_to("nowhere")


def piped(path: Path) -> None:
    path.unlink()
    os.mkfifo(path)


def endless(path: Path) -> None:
    path.unlink()
    path.symlink_to("/dev/zero")


@pytest.mark.parametrize("strange", [moved, linked_to_nothing, piped, endless, Path.unlink])
def test_what_is_none_of_ours_is_not_read_and_is_replaced(
    cache: Path, strange: Callable[[Path], None]
):
    kept = Kept()
    kept.put(b"many bytes", "mug")
    [path] = cache.iterdir()
    strange(path)
    assert kept.get("mug") is None
    kept.put(b"many bytes", "mug")
    assert kept.get("mug") == b"many bytes"
    assert path.is_file()
    assert not path.is_symlink()


def test_what_cannot_be_written_is_told_once(cache: Path, caplog: pytest.LogCaptureFixture):
    caplog.set_level("INFO")
    kept = Kept()
    kept.put(b"many bytes", "mug")
    [path] = cache.iterdir()
    path.unlink()
    path.mkdir()
    for _ in range(2):
        kept.put(b"many bytes", "mug")
        assert kept.get("mug") is None
    assert caplog.text.count("is not kept") == 1


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


def test_of_too_many_bytes_those_go_that_were_not_asked_for_the_longest(
    cache: Path, monkeypatch: pytest.MonkeyPatch
):
    for age, name in enumerate(("jar", "cup", "mug")):
        before = set(cache.iterdir()) if cache.exists() else set()
        Kept().put(bytes(100), name)
        [path] = set(cache.iterdir()) - before
        os.utime(path, (2e8 - 1e5 * age, 2e8 - 1e5 * age))
    assert Kept().get("mug") == bytes(100)
    monkeypatch.setattr("kb.llm.kept.MOST_BYTES_IN_ALL", 300)
    kept = Kept()
    assert [kept.get(name) is not None for name in ("jar", "cup", "mug")] == [True, False, True]


def asked(ask: Callable[[LlamaCpp], int]) -> object:
    """What a model that was just loaded answers."""
    model = LlamaCpp(
        embedded_model(),
        inbox := Inbox(),
        ModelOptions(context_tokens=1024, max_tokens=8),
        threads=1,
    )
    ask(model)
    assert inbox.wait(PATIENCE_S)
    model.close()
    [event] = inbox.take_all()
    assert isinstance(event, Ended)
    return event.result


def rank(thing: str) -> Scored:
    """Ask where the thing is."""
    scored = asked(lambda model: model.rank(Ranker(ontology(True)).ranking(thing, ())))
    assert isinstance(scored, Scored)
    return scored


@pytest.fixture(scope="module")
def asked_once(tmp_path_factory: pytest.TempPathFactory) -> tuple[Scored, Path]:
    """What a model answered that had read nothing, and what it has kept."""
    folder = tmp_path_factory.mktemp("asked once")
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("XDG_CACHE_HOME", str(folder))
        return rank("hammer"), folder


@pytest.fixture
def first(cache: Path, asked_once: tuple[Scored, Path]) -> Scored:
    """What was answered before; what was kept of it is in the cache."""
    shutil.copytree(asked_once[1], cache.parents[1], dirs_exist_ok=True)
    return asked_once[0]


def written(thing: str) -> Replied:
    """Have it write where the thing is."""

    def ask(model: LlamaCpp) -> int:
        return model.chat(Lister(ontology(True), model, remembers=False).inquiry(thing, ()))

    replied = asked(ask)
    assert isinstance(replied, Replied)
    return replied


def damage(path: Path, chance: random.Random) -> None:
    """Leave it, or change it in one of many ways; or put another in its place."""
    whole = path.read_bytes()
    at = chance.randrange(len(whole))
    match chance.randrange(5):
        case 0:
            path.unlink()
        case 1:
            path.write_bytes(whole[:at])
        case 2:
            path.write_bytes(whole[:at] + bytes([whole[at] ^ 1]) + whole[at + 1 :])
        case 3:
            path.write_bytes(chance.choice(sorted(path.parent.iterdir())).read_bytes())


@pytest.mark.llm
def test_the_next_process_evaluates_only_what_is_about_its_own_thing(
    cache: Path, asked_once: tuple[Scored, Path]
):
    rank("mug")
    next_one = rank("hammer")
    assert 0 < next_one.usage.evaluated_tokens < 70
    anew, _ = asked_once
    assert anew.scores == next_one.scores
    assert anew.usage.evaluated_tokens > 300


@pytest.mark.llm
def test_what_was_asked_before_is_known(first: Scored):
    second = rank("hammer")
    assert second.scores == first.scores
    assert second.usage.input_tokens == first.usage.input_tokens
    assert second.usage.evaluated_tokens == 0


@pytest.mark.llm
def test_whatever_is_damaged_no_score_is_another(cache: Path, first: Scored):
    chance = random.Random(17)
    for _ in range(3):
        for path in sorted(cache.iterdir()):
            damage(path, chance)
        again = rank("hammer")
        assert again.scores == first.scores
        assert again.usage.evaluated_tokens > 0


@pytest.mark.llm
def test_what_was_answered_before_is_answered_without_the_model(
    cache: Path, monkeypatch: pytest.MonkeyPatch
):
    first = rank("hammer")
    monkeypatch.setattr(LlamaCpp, "_load", lambda self: pytest.fail("it was loaded"))
    again = rank("hammer")
    assert again.scores == first.scores
    assert again.usage.input_tokens == first.usage.input_tokens > 0


def test_llama_cpp_is_not_imported_with_a_model_that_evaluates_nothing(cache: Path):
    program = """
import sys
from executive.events import Inbox
from kb.llm.llama import LlamaCpp, embedded_model
LlamaCpp(embedded_model(), Inbox()).close()
sys.exit("llama_cpp" in sys.modules)
"""
    subprocess.run([sys.executable, "-c", program], check=True, timeout=60)


@pytest.mark.llm
def test_a_cache_that_llama_cpp_refuses_is_evaluated_anew(
    first: Scored, monkeypatch: pytest.MonkeyPatch
):
    refused = bytes(5000)
    monkeypatch.setattr(Kept, "get", lambda self, *asked: refused if "cache" in asked else None)
    assert rank("hammer").scores == first.scores


@pytest.mark.llm
def test_what_prompts_begin_with_is_kept_for_writing(cache: Path):
    first, second = written("hammer"), written("hammer")
    assert second.text == first.text
    assert second.usage.evaluated_tokens < 40 < 300 < first.usage.evaluated_tokens
