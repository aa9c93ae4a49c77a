"""Whatever a TOML file holds, it is read, or refused in a sentence, and never waited for."""

import os
import re
import time
from contextlib import suppress
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from executive.config import load_settings
from executive.errors import InputError
from executive.ros.profile import load_profile, profile_text
from executive.toml_file import MOST_BYTES, parse_toml, read_toml
from kb.advice.prompts import Prompts


def test_a_byte_order_mark_is_no_part_of_the_text(tmp_path: Path) -> None:
    file = tmp_path / "my.toml"
    file.write_bytes(b"\xef\xbb\xbfseed = 3\n")
    assert read_toml(file) == {"seed": 3}
    assert load_settings(file).seed == 3


@pytest.mark.parametrize(
    ("content", "sentence"),
    [
        ("seed = 1".encode("utf-16"), "it is UTF-16 or UTF-32; save it as UTF-8"),
        ("a = 1\nname = 'küche'".encode("latin-1"), "line 2 has the byte 0xfc"),
        (b"a = " + b"[" * 100_000, "nested deeper"),
        (b"a = " + b"[" * 40 + b"]" * 40, "nested deeper"),
        (b"a." * 100_000 + b"a = 1", "nested deeper"),
        (b'"a" . ' * 100_000 + b"a = 1", "nested deeper"),
        (b"[" + b"a." * 100_000 + b"a]", "nested deeper"),
        (b"a = " + b"9" * 5000, "line 1 has a number of more than 64 bits"),
        (b"# a\nb = 1\nc = [2, -" + b"9_8" * 5000 + b"]", "line 3 has a number of more than 64"),
        (b"[x]\na = [1, 0x" + b"f" * 17 + b"]", "x.a.1 is a number of more than 64 bits"),
        (b"a = 2026-11-25", "a is a date or a time"),
        (b"a = 2026-13-45", "is not TOML|cannot be"),
        (b"a = 1\na = 2", "is not TOML: Cannot overwrite a value"),
        (b"a = '\x00'", "(?:Illegal|invalid) character"),
        (b"#" * (MOST_BYTES + 1), "is larger than 1 MB"),
    ],
)
def test_what_no_file_of_ours_holds_is_refused_at_once(content: bytes, sentence: str) -> None:
    began = time.thread_time()
    with pytest.raises(InputError, match=f"my.toml: .*(?:{sentence})"):
        parse_toml(content, "my.toml")
    assert time.thread_time() - began < 20


def test_dots_and_brackets_in_texts_are_no_nesting() -> None:
    text = "a.b.c. " * 40 + "[" * 40
    assert parse_toml(f'a = "{text}"\nb = """\n{text}"""  # {text}'.encode(), "my.toml") == {
        "a": text,
        "b": text,
    }


@pytest.mark.parametrize("kind", ["a pipe or a device", "a folder"])
def test_what_is_no_plain_file_is_never_opened(tmp_path: Path, kind: str) -> None:
    path = tmp_path / "my.toml"
    path.mkdir() if kind == "a folder" else os.mkfifo(path)
    for read in (read_toml, load_settings, Prompts.load):
        with pytest.raises(InputError, match=f"cannot be read: it is {kind}"):
            read(path)


def test_a_name_that_no_file_can_have_is_a_sentence() -> None:
    with pytest.raises(InputError, match="no name of a file"):
        read_toml(Path("a\0b"))


def test_an_error_is_one_line_whatever_the_file_is_called(tmp_path: Path) -> None:
    with pytest.raises(InputError) as error:
        read_toml(tmp_path / "a\x1b[2J\nerror: all is well.toml")
    assert str(error.value).isprintable()


@given(st.binary(max_size=300))
def test_any_bytes_are_tables_or_a_sentence(content: bytes) -> None:
    with suppress(InputError):
        assert isinstance(parse_toml(content, "my.toml"), dict)


@given(st.text("a.[]{}=\"'\\\n 1#,-_x", max_size=80))
def test_any_text_like_toml_is_tables_or_a_sentence(text: str) -> None:
    with suppress(InputError):
        assert isinstance(parse_toml(text.encode(), "my.toml"), dict)


@pytest.mark.parametrize(
    ("name", "value", "sentence"),
    [
        ("SEED", "many", "EXECUTIVE_SEED: .*valid integer"),
        ("SEED", str(2**63), "EXECUTIVE_SEED: .*less than 9223372036854775808"),
        ("MEMORY", "a\udcff.db", r"setting 'memory': is 'a\\udcff.db', which is no UTF-8"),
        ("KB", '["a\\ud800.owl"]', r"setting 'kb': is \['a\\ud800.owl'\], which is no UTF-8"),
        ("TEMPERATURE", "inf", "EXECUTIVE_TEMPERATURE: .*finite"),
        ("PLACE", '{"mug":', "EXECUTIVE_PLACE: is not JSON"),
        ("PLACE", "9" * 5000, "EXECUTIVE_PLACE: is not JSON"),
        ("PLACE", '{"mug": {"a": 1}}', "EXECUTIVE_PLACE.mug: .*valid string"),
        (
            "PLACE",
            '{"mug": "desk", "mug": "bed"}',
            "EXECUTIVE_PLACE: has 'mug' 2 times; give it once",
        ),
        ("KB", "[" * 100_000, "EXECUTIVE_.*nested too deep"),
    ],
)
def test_a_wrong_variable_of_the_environment_is_named(
    name: str, value: str, sentence: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv(f"EXECUTIVE_{name}", value)
    with pytest.raises(InputError, match=sentence):
        load_settings()


def test_two_variables_of_one_setting_are_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("EXECUTIVE_SEED", "3")
    monkeypatch.setenv("executive_seed", "4")
    sentence = "EXECUTIVE_SEED and executive_seed: are the same setting; keep one"
    with pytest.raises(InputError, match=sentence):
        load_settings()


def test_a_bool_in_a_settings_file_or_a_programs_setting_is_no_number(tmp_path: Path) -> None:
    file = tmp_path / "settings.toml"
    file.write_text("question_s = true")
    with pytest.raises(InputError, match=r"settings.toml: question_s: is true; should be a number"):
        load_settings(file)
    with pytest.raises(InputError, match=r"setting 'seed': is true; should be a number"):
        load_settings(seed=True)


def test_a_bool_in_a_profile_is_no_number(tmp_path: Path) -> None:
    content, _ = profile_text("nav2")
    file = tmp_path / "profile.toml"
    file.write_text(re.sub(r"= \d[\d.]*$", "= true", content.decode(), count=1, flags=re.M))
    with pytest.raises(InputError, match=r"profile.toml: \S+ is true; should be a number"):
        load_profile(str(file))
