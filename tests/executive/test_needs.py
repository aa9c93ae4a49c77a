"""An option that does nothing without another one is told, with what it needs."""

import re
from pathlib import Path

import pytest

from executive.__main__ import parsed
from executive.config import Settings, load_settings
from executive.needs import NEEDS, warn_of_vain
from executive.options import option_of

pytestmark = pytest.mark.usefixtures("own_folder_and_signals")

IN_VAIN = {
    "world": "--robot ws://host:1 --world physics",
    "place": "--robot ws://host:1 --place mug=desk",
    "ycb": "--world fake --ycb scans",
    "camera_hz": "--world fake --camera-hz 5",
    "gui": "--world fake --gui",
    "detector": "--world fake --detector mine.onnx",
    "llm": "--knowledge okb --llm mine.gguf",
    "knowledge": "--llm none --knowledge okb+llm",
    "elicit": "--llm none --elicit rank",
    "grammar": "--knowledge okb --grammar",
    "prompts": "--llm none --prompts mine.toml",
    "llm_model": "--llm-model llama3",
    "question_s": "--search paper --question-s 5",
    "microphone": "--microphone arecord",
    "hours_between": "--hours-between 8",
}
"""For each option that needs another, a command line without that."""
HAVING = re.compile(r"(--[a-z-]+) ([^ ,]+)")
LEAVING_OUT = re.compile(r"leave out (--[a-z-]+)")


def check(words: list[str]) -> None:
    given = {name: value for name, value in vars(parsed(words)).items() if value}
    fields = {name: value for name, value in given.items() if name in Settings.model_fields}
    warn_of_vain(load_settings(**fields), given)


def test_there_is_a_command_line_for_each_option_of_the_table() -> None:
    named = {name for need in NEEDS for name in need.of}
    options = {n for n in named if n == "gui" or option_of(Settings.model_fields[n])}
    assert options == set(IN_VAIN)


@pytest.mark.parametrize("name", IN_VAIN)
def test_an_option_without_effect_is_told_and_what_is_said_mends_it(
    name: str, caplog: pytest.LogCaptureFixture
) -> None:
    words = IN_VAIN[name].split()
    option = f"--{name.replace('_', '-')}"
    check(words)
    said = next(one for one in caplog.messages if one.startswith(f"{option} has no effect: "))
    mends, _, leaves_out = said.rpartition("(")[2].rstrip(")").partition(", or ")
    assert leaves_out == f"leave {option} out"
    for unwanted in LEAVING_OUT.findall(mends):
        at = words.index(unwanted)
        del words[at : at + 2]
    wanted = [word.replace(":port", ":1") for pair in HAVING.findall(mends) for word in pair]
    caplog.clear()
    check([*words, *wanted])
    assert not caplog.messages


def test_what_a_file_or_the_environment_says_in_vain_is_told_and_does_no_harm(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    file = tmp_path / "mine.toml"
    file.write_text('microphone = "mine.wav"\nquestion_s = 5.0\nseed = 3')
    monkeypatch.setenv("EXECUTIVE_LLM_MODEL", "llama3")
    warn_of_vain(load_settings(file), {"seed"})
    assert sorted(record.getMessage() for record in caplog.records) == [
        "setting 'llm_model' has no effect: no server has the language model",
        "setting 'microphone' has no effect: nobody hears by it",
    ]


def test_the_settings_that_a_run_keeps_are_no_reason_to_warn(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    file = tmp_path / "config.toml"
    file.write_text(load_settings(world="fake", llm="none", search="paper").to_toml())
    warn_of_vain(load_settings(file), ())
    assert not caplog.records
