"""A setting is one field: the command line's options are made of the fields."""

import argparse
from pathlib import Path
from typing import Annotated, Literal

import pytest
from pydantic import Field

from executive import options
from executive.__main__ import parsed, parser
from executive.config import Option, Settings
from executive.options import add_settings, option_of


class More(Settings):
    price_s: Annotated[float, Option("SECONDS")] = Field(60.0, description="of a question")
    mood: Annotated[Literal["calm", "brisk"] | None, Option(after="home")] = Field(
        None, description="how it drives"
    )


def test_a_new_field_is_a_new_option(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(options, "Settings", More)
    made = argparse.ArgumentParser()
    add_settings(made)
    given = made.parse_args(["--price-s", "5", "--mood", "calm"])
    assert (given.price_s, given.mood) == (5.0, "calm")
    text = made.format_help()
    assert "--price-s SECONDS" in text
    assert "of a question (default: 60.0)" in text
    assert text.index("--home") < text.index("--mood") < text.index("--knowledge")


def test_every_option_of_a_setting_is_read_as_the_setting_is() -> None:
    words = ["--kb", "a.owl", "--kb", "b.owl", "--no-learn", "--seed", "3", "--place", "mug=desk"]
    given = {
        n: v for n, v in vars(parser().parse_args(words)).items() if n in Settings.model_fields
    }
    read = Settings(**{name: value for name, value in given.items() if value is not None})
    assert (len(read.kb), read.learn, read.seed, read.place) == (2, False, 3, {"mug": "desk"})
    with_option = {n for n, field in Settings.model_fields.items() if option_of(field)}
    assert set(given) == with_option


def test_a_thing_is_truly_at_one_place(capsys: pytest.CaptureFixture[str]) -> None:
    again = ["--place", "mug=desk", "--place", "mug=desk", "--place", "apple=sofa"]
    assert parsed(again).place == {"mug": "desk", "apple": "sofa"}
    with pytest.raises(SystemExit):
        parsed([*again, "--place", "mug=sofa"])
    assert "--place mug=sofa: it is mug=desk, too; give one" in capsys.readouterr().err


@pytest.mark.parametrize("option", ["--home", "--kb", "--runs", "--memory", "--config"])
def test_an_option_that_is_empty_is_refused_and_does_not_mean_this_folder(
    option: str, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit):
        parsed([option, "", "bring", "a", "mug"])
    assert f"argument {option}: is empty; name one, or leave it out" in capsys.readouterr().err


def test_words_need_no_quotes() -> None:
    assert parsed(["--seed", "1", "bring", "a", "mug"]).words == ["bring", "a", "mug"]
    assert parsed(["--", "-x"]).words == ["-x"]
    assert parsed([]).words == []


def test_options_may_stand_between_the_words() -> None:
    given = parsed(["Bring", "--seed", "3", "a", "--json", "mug"])
    assert (given.words, given.seed, given.json) == (["Bring", "a", "mug"], 3, True)


def test_an_option_that_there_is_not_is_refused_among_words(
    capsys: pytest.CaptureFixture[str],
) -> None:
    with pytest.raises(SystemExit):
        parsed(["Bring", "--sead", "3", "a", "mug"])
    assert "error: unrecognized arguments: --sead 3 a mug" in capsys.readouterr().err


def test_the_page_of_options_names_each_of_them() -> None:
    page = (Path(__file__).parents[2] / "docs/options.md").read_text()
    options = {name for action in parser()._actions for name in action.option_strings}
    assert sorted(name for name in options - {"-h", "--help"} if name not in page) == []
