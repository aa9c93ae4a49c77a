"""A study's file is read whole, or it is said where and what is wrong."""

import json
from contextlib import suppress
from importlib.resources import files
from pathlib import Path
from typing import Any

import pytest
import tomli_w
from hypothesis import given
from hypothesis import strategies as st

from executive.errors import InputError
from executive.page.__main__ import main
from executive.page.study.command import try_conditions
from executive.page.study.file import read_study, settings_of
from executive.page.study.steps import Kind, steps

EXAMPLE = Path(__file__).parents[4] / "docs/examples/study.toml"

LEAST: dict[str, Any] = {
    "title": "T",
    "consent": "Yes?",
    "instructions": "Talk.",
    "conditions": [{"name": "a"}],
    "tasks": [{"name": "t", "text": "Do."}],
}


def written(folder: Path, **changed: Any) -> Path:
    file = folder / "study.toml"
    file.write_text(tomli_w.dumps({**LEAST, **changed}), encoding="utf-8")
    return file


@pytest.mark.parametrize("ask", [["--report"], ["--withdraw", "P01"]])
def test_who_asks_about_a_folder_that_there_is_not_makes_none(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], ask: list[str]
) -> None:
    data = tmp_path / "data"
    assert main(["study", str(written(tmp_path)), "--data", str(data), *ask]) == 2
    assert "data: there is no such folder; lead a participant first" in capsys.readouterr().err
    assert not data.exists()


def test_the_example_of_the_docs_is_whole() -> None:
    study = read_study(EXAMPLE)
    assert [step.key for step in steps(study, 1)] == [
        "consent",
        "instructions",
        "part/plans",
        "task/plans/fruit",
        "task/plans/mug",
        "questionnaire/plans/sus",
        "questionnaire/plans/trust",
        "part/lists",
        "task/lists/fruit",
        "task/lists/mug",
        "questionnaire/lists/sus",
        "questionnaire/lists/trust",
        "questionnaire/comparison",
        "thanks",
    ]
    assert [step.condition for step in steps(study, 2) if step.kind == "part"] == ["lists", "plans"]


def test_each_condition_has_its_own_settings_over_those_of_all(tmp_path: Path) -> None:
    conditions = [
        {"name": "a", "settings": {"search": "paper"}},
        {"name": "b", "settings": {"world": "physics"}},
    ]
    file = written(tmp_path, settings={"world": "fake", "llm": "none"}, conditions=conditions)
    study = read_study(file)
    a, b = (settings_of(study, one, str(file)) for one in study.conditions)
    assert (a.world, a.search, b.world, b.search) == ("fake", "paper", "physics", "plan")


QUESTIONS = {"title": "Q", "items": [{"name": "a", "text": "A?"}]}
UNSURE = {"name": "a", "text": "A?", "needed": 0}


@pytest.mark.parametrize(
    ("changed", "said"),
    [
        ({"tilte": "T"}, "there is no key tilte; see docs/study.md"),
        ({"conditions": []}, "conditions is []; list should have at least 1 item, not 0"),
        ({"conditions": [{"name": "a"}] * 2}, "has two conditions called 'a'"),
        ({"conditions": [{"name": "a"}, {"name": "A"}]}, "has two conditions called 'a'"),
        ({"conditions": [{"name": "../a"}]}, "conditions.0.name is '../a'; use up to 40 letters"),
        ({"tasks": [{"name": "t"}]}, "tasks.0.text is missing"),
        ({"tasks": [{"name": "t", "text": "Do.", "limit_s": 0}]}, "tasks.0.limit_s is 0; input"),
        ({"tasks": [{"name": "t", "text": "Do.", "limit_s": True}]}, ".limit_s is true; should be"),
        ({"tasks": [{"name": "t", "text": "Do.", "limit_s": "5"}]}, "is '5'; should be a number"),
        (
            {"at_end": ["q"], "questionnaires": {"q": {**QUESTIONS, "points": True}}},
            "questionnaires.q.points is",
        ),
        (
            {"at_end": ["q"], "questionnaires": {"q": {**QUESTIONS, "items": [UNSURE]}}},
            "items.0.needed is 0; should",
        ),
        (
            {"at_end": ["sus"], "questionnaires": {"q": QUESTIONS}},
            "asks questionnaire 'q' nowhere: name it in at_start, after_each or at_end",
        ),
        ({"settings": {"seed": True}}, "setting 'seed': is true; should be a number"),
        ({"title": 3}, "title is 3; should be text, in quotes"),
        ({"order": "random"}, "order is 'random'; input should be 'balanced' or 'as written'"),
        ({"after_each": ["suz"]}, "has no questionnaire 'suz': there are sus, nasa_tlx, godspeed"),
        ({"settings": {"serach": "plan"}}, "setting 'serach': is no setting; known are home"),
        ({"settings": {"search": "plans"}}, "settings of condition 'a': setting 'search'"),
        ({"settings": {"runs": "x"}}, "runs is not for a study: the study keeps recordings"),
        ({"settings": {"user": "oracle"}}, "user is not for a study: the participant is"),
        ({"conditions": [{"name": "a", "settings": {"memory": "m"}}]}, "memory is not for a study"),
        ({"settings": {"home_state": "h.toml"}}, "home_state is not for a study: what one"),
        ({"settings": {"config": "c.toml"}}, "config is not for a study: all settings stand in"),
        ({"settings": {"ears": "pocketsphinx"}}, "ears is not for a study: participants speak by"),
        ({"after_each": "sus"}, "after_each is 'sus'; input should be a valid list"),
        ({"settings": 3}, "settings is 3; input should be a valid table"),
    ],
)
def test_what_is_wrong_is_said_with_where_and_what_would_be_right(
    tmp_path: Path, changed: dict[str, Any], said: str
) -> None:
    file = written(tmp_path, **changed)
    with pytest.raises(InputError) as raised:
        read_study(file)
    assert str(raised.value).startswith(str(file))
    assert said in str(raised.value)


@pytest.mark.parametrize(
    ("setting", "value", "said"),
    [
        ("home", "nowhere", "home nowhere: there is no home of this name"),
        ("habits", "none_such", "habits none_such: there are no habits of this name"),
        ("kb", ["nowhere.owl"], "nowhere.owl: cannot be read"),
        ("world", "no.such:thing", "--world no.such:thing: there is no module no"),
        ("detector", "nowhere.onnx", "nowhere.onnx: cannot be read"),
        ("llm", "nowhere.gguf", "setting 'llm': model nowhere.gguf cannot be read"),
        ("fault", ["slip=2"], "--fault slip=2: should be a probability"),
        ("ycb", "nowhere", "--ycb nowhere: has no model"),
    ],
)
def test_what_a_later_condition_reads_is_tried_before_anyone_sits_down(
    tmp_path: Path, setting: str, value: Any, said: str
) -> None:
    conditions = [{"name": "a"}, {"name": "b", "settings": {setting: value}}]
    study = read_study(written(tmp_path, conditions=conditions))
    with pytest.raises(InputError) as raised:
        try_conditions(study, "study.toml")
    assert str(raised.value).startswith(f"study.toml: settings of condition 'b': {said}")


@pytest.mark.parametrize("name", ["MEMORY", "HOME_STATE"])
def test_what_would_outlive_a_participant_is_not_taken_from_the_environment_either(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str
) -> None:
    monkeypatch.setenv(f"EXECUTIVE_{name}", str(tmp_path / "kept"))
    with pytest.raises(InputError, match=f"EXECUTIVE_{name}: is not for a study"):
        read_study(written(tmp_path))


KEYS = st.sampled_from([*LEAST, "settings", "after_each", "questionnaires", "order", "x"])
VALUES = st.recursive(
    st.none() | st.booleans() | st.integers(-(2**62), 2**62) | st.text(max_size=8),
    lambda inner: (
        st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=4), inner, max_size=3)
    ),
    max_leaves=6,
)


@given(st.dictionaries(KEYS, VALUES, max_size=3))
def test_whatever_is_in_it_is_a_study_or_an_error_in_a_sentence(
    tmp_path_factory: pytest.TempPathFactory, changed: dict[str, Any]
) -> None:
    file = tmp_path_factory.mktemp("study") / "study.toml"
    try:
        file.write_text(tomli_w.dumps({**LEAST, **changed}), encoding="utf-8", errors="replace")
    except (TypeError, ValueError):
        return  # no TOML
    with suppress(InputError):  # whose message is one line by itself
        assert steps(read_study(file), 1)


def test_the_same_said_in_other_lines_is_the_same_study(tmp_path: Path) -> None:
    one = read_study(written(tmp_path)).canonical()
    assert read_study(written(tmp_path, order="balanced")).canonical() == one
    assert read_study(written(tmp_path, consent="No?")).canonical() != one


def test_the_page_has_a_heading_for_each_kind_of_step() -> None:
    texts = files("executive.page").joinpath("assets/english.json").read_text("utf-8")
    assert set(Kind) <= set(json.loads(texts)["study"])
