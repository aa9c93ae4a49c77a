"""The example of a policy looks near the person first, replays, and runs in a campaign."""

import runpy
from pathlib import Path
from typing import Any

import pytest

from executive import InputError, MissionStatus
from executive.campaign import blocks
from executive.campaign.__main__ import main
from executive.config import load_settings
from executive.replay import replay

EXAMPLES = Path(__file__).parents[2] / "docs" / "examples"


@pytest.fixture
def example(tmp_path: Path) -> dict[str, Any]:
    names = runpy.run_path(str(EXAMPLES / "own_policy.py"))
    names["outcome"] = names["find"]("Find the mug", tmp_path)
    return names


def test_the_room_of_the_person_is_searched_first(example: dict[str, Any]) -> None:
    outcome = example["outcome"]
    assert (outcome.status, outcome.inquiries) == (MissionStatus.DONE, 0)
    assert outcome.visited == ("dining_table", "coffee_table")


def test_its_recording_replays_with_it_and_says_what_it_needs(example: dict[str, Any]) -> None:
    run = Path(example["outcome"].run_dir)
    assert replay(run, change=example["near_the_person"]).parting is None
    with pytest.raises(InputError, match=r"'near_the_person', unknown here.*change=\.\.\."):
        replay(run)


def campaign(policy: str, out: Path, *options: str) -> int:
    commands = out / "commands.txt"
    commands.write_text("Find the mug")
    of_one = ["--seeds", "1", "--systems", "okb+llm", "--commands", str(commands)]
    return main(["--policy", policy, "--out", str(out / "out"), *of_one, *options])


@pytest.mark.parametrize("workers", ["1", "2"])
def test_a_campaign_takes_it_by_its_name(
    workers: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(EXAMPLES)
    assert campaign("own_policy:near_the_person", tmp_path, "--workers", workers) == 0
    results = (tmp_path / "out" / "results.csv").read_text()
    assert results.count("\nown_policy:near_the_person,") == 2


OWN = """
def none(parts):
    return None

def broken(parts):
    raise OSError("no such list")
"""


@pytest.mark.parametrize(
    ("policy", "sentence"),
    [
        ("no_such:policy", "--policy no_such:policy: there is no module no_such"),
        ("own_rule:other", "own_rule has no function other; name a Policy, or a function"),
        ("own_rule:none", "--policy own_rule:none: returned a NoneType; name a Policy"),
        ("own_rule:broken", "--policy own_rule:broken: cannot be built: OSError: no such list"),
    ],
)
def test_what_is_wrong_with_a_policy_is_told_in_a_sentence(
    policy: str,
    sentence: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    (tmp_path / "own_rule.py").write_text(OWN)
    monkeypatch.syspath_prepend(tmp_path)
    assert campaign(policy, tmp_path) == 2
    assert sentence in capsys.readouterr().err


@pytest.mark.parametrize("kind", [["--commands", "asked.txt"], ["--weeks", "1"]])
def test_it_is_tried_before_anything_is_done(
    kind: list[str],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.syspath_prepend(tmp_path)
    Path("own_trial.py").write_text(OWN)
    Path("asked.txt").write_text("Find the mug")
    policies = ["--policy", "nearest", "--policy", "own_trial:none"]
    assert main([*policies, *kind, "--seeds", "1", "--llm", "none", "--out", "out"]) == 2
    assert "own_trial:none: returned a NoneType" in capsys.readouterr().err
    assert not Path("out").exists()


def test_a_name_without_a_module_has_to_be_one_of_ours(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit, match="2"):
        campaign("near", tmp_path)
    assert "'near' (choose from 'ours', 'paper', " in capsys.readouterr().err


def test_its_settings_come_before_those_of_the_campaign(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(EXAMPLES)
    given = load_settings(world="fake", llm="embedded", elicit="generate")
    block = blocks.Block(given, ("Find the mug",), "own_policy:near_the_person")
    assert (block.settings_used.llm, block.settings_used.elicit) == ("none", "rank")
