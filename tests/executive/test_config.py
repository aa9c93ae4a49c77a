"""Settings come from a file, the environment and the command line, and faults are named."""

from pathlib import Path
from typing import Any

import pytest

from executive.cache import VARIABLE
from executive.config import KnowledgeSystem, load_settings
from executive.errors import InputError
from executive.events import Inbox
from executive.ros.address import HEADERS
from executive.servers.key import EARS_KEY, LLM_KEY
from kb.llm import open as opening
from kb.llm.options import ModelOptions


def file_with(tmp_path: Path, text: str) -> Path:
    path = tmp_path / "my.toml"
    path.write_text(text)
    return path


def test_the_command_line_beats_the_environment_and_it_beats_the_file(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    config = file_with(tmp_path, 'seed = 1\nhome = "a"\nknowledge = "okb"')
    monkeypatch.setenv("EXECUTIVE_SEED", "2")
    monkeypatch.setenv("EXECUTIVE_HOME", "b")
    settings = load_settings(config, seed=3, home=None)
    assert (settings.seed, settings.home, settings.knowledge) == (3, "b", KnowledgeSystem.OKB)


def test_the_written_settings_read_back_the_same(tmp_path: Path) -> None:
    settings = load_settings(place={"mug": "desk"}, elicit="generate", seed=7)
    assert load_settings(file_with(tmp_path, settings.to_toml())) == settings


def test_one_of_what_is_repeatable_needs_no_list(tmp_path: Path) -> None:
    settings = load_settings(file_with(tmp_path, 'kb = "a.owl"'), fault="slip=0.3")
    assert (settings.fault, settings.kb) == (("slip=0.3",), (Path("a.owl"),))
    assert load_settings(kb=Path("a.owl")).kb == settings.kb


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("seed = -1", "my.toml: seed: .*greater than or equal to 0"),
        ("sede = 1", "my.toml: sede: .*; known are home, knowledge"),
        ("seed = ", "my.toml: is not TOML"),
        ('llm = "gpt"', "my.toml: llm: .*FILE.gguf or http"),
        ('llm = "http://"', "my.toml: llm: should be an address such as http://host:port/v1"),
        ('robot = "ws://"', "my.toml: robot: should be an address such as ws://HOST:PORT"),
        ("kb = [1]", "my.toml: kb.0: Input is no name of a file"),
        ('runs = ""', "my.toml: runs: is empty: name one, or leave it out"),
        ('home = " "', "my.toml: home: is empty: name one, or leave it out"),
        ('knowledge = "all"', "my.toml: knowledge: .*'okb', 'okb.llm'"),
    ],
)
def test_a_fault_is_named_with_what_would_be_right(
    tmp_path: Path, text: str, sentence: str
) -> None:
    with pytest.raises(InputError, match=sentence):
        load_settings(file_with(tmp_path, text))


@pytest.mark.parametrize("maker", ["LlamaCpp", "Server"])
def test_the_settings_reach_the_model(maker: str, monkeypatch: pytest.MonkeyPatch) -> None:
    given: dict[str, Any] = {}

    def made(_: object, __: object, options: ModelOptions, **others: Any) -> None:
        given.update(others, grammar=options.grammar, temperature=options.temperature)

    home = {"LlamaCpp": "kb.llm.llama", "Server": "kb.llm.server.server"}[maker]
    monkeypatch.setattr(f"{home}.{maker}", made)
    llm = {"LlamaCpp": "my.gguf", "Server": "http://127.0.0.1:1/v1"}[maker]
    opening.model_for_missions(
        load_settings(llm=llm, grammar=True, threads=3, gpu_layers=-1, temperature=0.5), Inbox()
    )
    assert (given["grammar"], given["temperature"]) == (True, 0.5)
    if maker == "LlamaCpp":
        assert (given["threads"], given["gpu_layers"]) == (3, -1)


def test_a_missing_file_is_named(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="none.toml: cannot be read: No such file"):
        load_settings(tmp_path / "none.toml")


@pytest.mark.parametrize(
    ("given", "elicitation"),
    [
        ({}, "rank"),
        ({"llm": "http://127.0.0.1:8000/v1"}, "generate"),
        ({"llm": "other.gguf"}, "generate"),
        ({"llm": "other.gguf", "elicit": "rank"}, "rank"),
    ],
)
def test_ranking_is_the_default_for_the_embedded_model_only(
    given: dict[str, str], elicitation: str
) -> None:
    assert load_settings(**given).elicitation == elicitation


def test_a_variable_that_is_no_setting_is_refused_with_the_nearest_that_is(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setenv("EXECUTIVE_TEMPERATUR", "sk-a-secret-perhaps")
    with pytest.raises(InputError, match="EXECUTIVE_TEMPERATUR: .* EXECUTIVE_TEMPERATURE$") as told:
        load_settings()
    assert "secret" not in str(told.value)


@pytest.mark.parametrize("name", [LLM_KEY, EARS_KEY, HEADERS, VARIABLE, "executive_seed"])
def test_variables_that_others_read_are_no_fault(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv(name, "1")
    load_settings()
