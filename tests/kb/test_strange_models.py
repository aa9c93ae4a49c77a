"""Model files from strangers: their claims are checked, and what they kill is a child."""

import os
import shutil
import struct
import threading
from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from patience import PATIENCE_S

from executive.__main__ import main
from executive.errors import ModelError
from executive.events import Inbox, StopRequested
from executive.types.llm import Message
from kb.llm import first_load
from kb.llm.first_load import tried
from kb.llm.gguf_header import read_header, refuse_what_does_not_chat
from kb.llm.llama import LlamaCpp, embedded_model
from kb.llm.template import Template
from kb.llm.threads import Worker

GOOD = "{% for m in messages %}{{ m.role }}: {{ m.content }}\n{% endfor %}"


def text(value: str | bytes) -> bytes:
    raw = value if isinstance(value, bytes) else value.encode()
    return struct.pack("<Q", len(raw)) + raw


def word(name: str, value: str | bytes) -> bytes:
    return text(name) + struct.pack("<I", 8) + text(value)


def number(name: str, value: int) -> bytes:
    return text(name) + struct.pack("<II", 4, value)


def listed(name: str, kind: int, count: int, entries: bytes = b"") -> bytes:
    return text(name) + struct.pack("<IIQ", 9, kind, count) + entries


def tensor(name: str, *shape: int, offset: int = 0) -> bytes:
    sizes = struct.pack(f"<I{len(shape)}Q", len(shape), *shape)
    return text(name) + sizes + struct.pack("<IQ", 0, offset)


LLAMA, TEMPLATE = word("general.architecture", "llama"), word("tokenizer.chat_template", GOOD)


def gguf(
    *values: bytes,
    tensors: tuple[bytes, ...] = (tensor("t", 4, 4),),
    counts: tuple[int, int] | None = None,
    version: int = 3,
    weights: int = 256,
) -> bytes:
    n_tensors, n_values = counts or (len(tensors), len(values))
    head = b"GGUF" + struct.pack("<IQQ", version, n_tensors, n_values)
    return b"".join([head, *values, *tensors]) + bytes(weights)


@pytest.fixture
def file(tmp_path: Path) -> Callable[[bytes], Path]:
    def written(raw: bytes) -> Path:
        path = tmp_path / "model.gguf"
        path.write_bytes(raw)
        return path

    return written


def test_a_sound_header_is_read(file: Callable[[bytes], Path]) -> None:
    words = listed("tokens", 8, 2, text("a") + text("b"))
    header = read_header(file(gguf(LLAMA, number("n", 7), words, listed("l", 6, 2, bytes(8)))))
    assert (header.architecture, header.values["n"], header.tensors) == ("llama", 7, 1)


HUGE = 2**63


@pytest.mark.parametrize(
    ("raw", "fault"),
    [
        (b"GGUF", "ends in the middle of its header"),
        (gguf(version=1), "is of version 1; known are 2 and 3"),
        (gguf(version=3 << 24), "is made for big-endian machines"),
        (gguf(counts=(HUGE, 0)), "claims 9223372036854775808 tensors"),
        (gguf(counts=(0, HUGE)), "claims 9223372036854775808 values"),
        (gguf(LLAMA, counts=(0, 2), tensors=(), weights=0), "ends in the middle of its header"),
        (gguf(LLAMA, LLAMA), "has 'general.architecture' twice"),
        (gguf(text("k" * 300)), "claims 300 characters in name of a value"),
        (gguf(word("tokenizer.chat_template", "x" * 70_000)), "claims 70000 characters in tok"),
        (gguf(text("k") + struct.pack("<IQ", 8, HUGE)), "claims 9223372036854775808 characters"),
        (gguf(text("k") + struct.pack("<I", 99)), "has 'k' of the unknown kind 99"),
        (gguf(listed("k", 9, 1)), "has lists in the list 'k'"),
        (gguf(listed("k", 4, HUGE)), "claims 9223372036854775808 entries in 'k'"),
        (gguf(listed("k", 12, 1 << 24)), "ends in the middle of its header"),
        (gguf(listed("k", 8, 1 << 24)), "claims 17179869186 characters in 'k'"),
        (gguf(tensors=(tensor("t", 4), tensor("t", 4))), "has the tensor 't' twice"),
        (gguf(tensors=(tensor("t", 1, 1, 1, 1, 1),)), "claims 5 dimensions"),
        (gguf(tensors=(tensor("t", 0),)), "has the tensor 't' with 0 numbers"),
        (gguf(tensors=(tensor("t", 1 << 30, 1 << 30),)), "with 1152921504606846976 numbers"),
        (gguf(tensors=(tensor("t", 4, offset=HUGE),)), "ends before its weights do"),
        (gguf(weights=0), "ends before its weights do"),
        (gguf(number("general.alignment", 0)), "has an impossible alignment, 0"),
        (gguf(word("\x1b[2J\n", "x"), word("\x1b[2J\n", "x")), r"has '\\x1b\[2J\\n' twice"),
    ],
)
def test_a_header_that_cannot_be_true_is_refused(
    file: Callable[[bytes], Path], raw: bytes, fault: str
) -> None:
    with pytest.raises(ModelError, match=f"model.gguf is no sound GGUF file: it .*{fault}"):
        read_header(file(raw))


@given(st.data())
def test_whatever_a_file_holds_it_is_read_or_refused(
    tmp_path_factory: pytest.TempPathFactory, data: st.DataObject
) -> None:
    raw = bytearray(gguf(LLAMA, TEMPLATE, number("n", 7), listed("l", 8, 1, text("a"))))
    for _ in range(data.draw(st.integers(0, 4))):
        at = data.draw(st.integers(0, len(raw) - 1))
        raw[at : at + data.draw(st.integers(0, 9))] = data.draw(st.binary(max_size=9))
    path = tmp_path_factory.getbasetemp() / "any.gguf"
    path.write_bytes(raw)
    with suppress(ModelError):
        refuse_what_does_not_chat(path, read_header(path))


@pytest.mark.parametrize(
    ("raw", "fault"),
    [
        (gguf(word("general.architecture", "nomic-bert"), TEMPLATE), "only embeds or compares"),
        (gguf(LLAMA, TEMPLATE, number("llama.pooling_type", 3)), "only embeds or compares"),
        (gguf(LLAMA, TEMPLATE, word("general.type", "adapter")), "no whole model but a part"),
        (gguf(LLAMA, TEMPLATE, tensors=()), "a vocabulary but no weights"),
        (gguf(LLAMA), "no chat template: take an instruction-tuned model"),
        (gguf(LLAMA, word("tokenizer.chat_template", " \n")), "no chat template"),
    ],
)
def test_a_model_that_does_not_chat_is_refused(
    file: Callable[[bytes], Path], raw: bytes, fault: str
) -> None:
    path = file(raw)
    with pytest.raises(ModelError, match=fault):
        refuse_what_does_not_chat(path, read_header(path))


# --- chat templates ---

CHAT = (Message("system", "S."), Message("user", "U"))


def test_a_template_that_knows_no_system_turn_is_given_none() -> None:
    strict = "{% if messages[0].role == 'system' %}{{ raise_exception('no') }}{% endif %}" + GOOD
    blind = (
        "{% for m in messages if m.role != 'system' %}{{ m.role }}: {{ m.content }}\n{% endfor %}"
    )
    for template in (strict, blind):
        assert Template(template, "", "").fill(CHAT) == "user: S.\n\nU\n"
    assert Template(GOOD, "", "").fill(CHAT) == "system: S.\nuser: U\n"


@pytest.mark.parametrize(
    ("template", "fault"),
    [
        ("hello", "leaves out what is said"),
        ("{% for ", "cannot be read"),
        ("{{ raise_exception('never\x1b') }}", r"refuses the prompt: never\\x1b"),
        ("{{ messages[0].content.__class__.__mro__ }}", "is unsafe"),
        ("{{ cycler.__init__.__globals__.os.system('true') }}", "is unsafe"),
        ("{% for i in range(10**9) %}x{% endfor %}", "Range too big"),
        ("{% for i in range(9**5) %}xx{% endfor %}" + GOOD, "has no end"),
        ("{{ 1 / 0 }}", "division by zero"),
        ("{% include '/etc/passwd' %}", "refuses the prompt"),
        ("{% macro f() %}{{ f() }}{% endmacro %}{{ f() }}", "recursion"),
    ],
)
def test_a_template_that_cannot_be_used_is_refused(template: str, fault: str) -> None:
    with pytest.raises(ModelError, match=fault):
        Template(template, "", "")


# --- the first time ---


@pytest.fixture(scope="module")
def stranger(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return Path(shutil.copy(embedded_model(), tmp_path_factory.mktemp("models") / "other.gguf"))


@pytest.fixture(autouse=True)
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    return tmp_path / "cache"


@pytest.fixture
def patched(stranger: Path) -> Iterator[Callable[[str, bytes], Path]]:
    """The stranger's file with some bytes of a value replaced, and mended afterwards."""
    head = stranger.read_bytes()[: 1 << 21]
    done: list[tuple[int, bytes]] = []

    def patch(name: str, raw: bytes) -> Path:
        at = head.index(text(name)) + len(text(name)) + 4
        done.append((at, head[at : at + len(raw)]))
        write(at, raw)
        return stranger

    def write(at: int, raw: bytes) -> None:
        with stranger.open("r+b") as file:
            file.seek(at)
            file.write(raw)

    yield patch
    for at, raw in done:
        write(at, raw)


@pytest.fixture
def with_template(patched: Callable[[str, bytes], Path]) -> Callable[[str], Path]:
    header = read_header(embedded_model())
    length = len(str(header.values["tokenizer.chat_template"]))
    return lambda template: patched(
        "tokenizer.chat_template", text(template.encode().ljust(length))
    )


@pytest.mark.llm
def test_a_file_is_tried_once_and_remembered(
    stranger: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert tried(stranger)
    monkeypatch.setattr(first_load, "_told_by_child", lambda *_: pytest.fail("tried twice"))
    assert tried(stranger)


@pytest.mark.llm
def test_a_changed_file_is_tried_anew(
    stranger: Path, patched: Callable[[str, bytes], Path]
) -> None:
    assert tried(stranger)
    with pytest.raises(ModelError):
        tried(patched("llama.embedding_length", struct.pack("<I", 1)))


@pytest.mark.llm
def test_a_cache_that_cannot_be_written_costs_time_only(
    stranger: Path, monkeypatch: pytest.MonkeyPatch, cache: Path
) -> None:
    cache.write_text("a file")
    monkeypatch.setattr(first_load, "_told_by_child", lambda *_: ["writes"])
    assert not tried(stranger)
    assert not tried(stranger)


@pytest.mark.llm
def test_a_file_that_llama_cpp_dies_of_ends_with_2_and_a_sentence(
    patched: Callable[[str, bytes], Path], tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    path = patched("llama.block_count", struct.pack("<I", 0))
    options = ["--world", "fake", "--user", "none", "--runs", str(tmp_path), "--llm", str(path)]
    assert main([*options, "Find a mug"]) == 2
    assert "other.gguf cannot be loaded: llama.cpp dies of it (SIGABRT)" in capfd.readouterr().err


@pytest.mark.llm
def test_a_template_without_an_end_is_stopped(
    with_template: Callable[[str], Path], monkeypatch: pytest.MonkeyPatch
) -> None:
    endless = "{% for i in range(99999) %}{% for j in range(99999) %}{% endfor %}{% endfor %}"
    monkeypatch.setattr(first_load, "PATIENCE_S", 2.0)
    with pytest.raises(ModelError, match="it takes too long|its chat template has no end"):
        tried(with_template(endless))


@pytest.mark.llm
def test_a_stop_ends_the_trial(stranger: Path) -> None:
    inbox = Inbox()
    inbox.post(StopRequested("Ctrl-C"))
    with pytest.raises(KeyboardInterrupt):
        LlamaCpp(stranger, inbox)


@pytest.mark.llm
def test_the_trial_is_not_given_the_key(stranger: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    given: dict[str, str] = {}

    def popen(*arguments: object, env: dict[str, str], **options: object) -> None:
        given.update(env)
        raise KeyboardInterrupt

    monkeypatch.setenv("EXECUTIVE_LLM_API_KEY", "sk-4f5e6d7c")
    monkeypatch.setattr("subprocess.Popen", popen)
    with pytest.raises(KeyboardInterrupt):
        tried(stranger)
    assert given
    assert "sk-4f5e6d7c" not in str(given)


def test_the_packaged_model_is_not_tried(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("kb.llm.llama.tried", lambda *_: pytest.fail("it was tried"))
    monkeypatch.setattr(LlamaCpp, "_load", lambda *_: None)
    LlamaCpp(embedded_model(), Inbox())


@pytest.mark.parametrize("name", ["missing.gguf", ".", "pipe.gguf"])
def test_what_is_no_file_is_refused(tmp_path: Path, name: str) -> None:
    os.mkfifo(tmp_path / "pipe.gguf")
    with pytest.raises(ModelError, match="cannot be read"):
        tried(tmp_path / name)


# --- a stuck thread ---


def test_a_stuck_worker_is_left_behind_and_its_tasks_are_called_off() -> None:
    begun, over = threading.Event(), threading.Event()
    worker = Worker("stuck")
    first = worker.submit(lambda: begun.set() or over.wait(PATIENCE_S))
    second = worker.submit(lambda: 1)
    assert begun.wait(PATIENCE_S)
    assert not worker.end(0.01)
    assert second.cancelled()
    over.set()
    assert first.result(PATIENCE_S)


def test_a_worker_goes_on_after_a_task_that_fails() -> None:
    worker = Worker("busy")
    failed, done = worker.submit(lambda: 1 / 0), worker.submit(lambda: os.getpid())
    assert isinstance(failed.exception(PATIENCE_S), ZeroDivisionError)
    assert done.result(PATIENCE_S)
    assert worker.end(PATIENCE_S)
