"""The page on verbs: its deed does what it says, tried under the name of a verb that there is."""

from pathlib import Path
from typing import Any

import pytest

import trees.act
from executive.testing.bench import run_mission
from executive.types.commands import CommandKind
from executive.types.outcome import MissionStatus
from trees.deeds import DEEDS

PAGE = Path(__file__).parents[2] / "docs" / "examples" / "own_verb.md"


def deed() -> Any:
    """What the page defines, as a way to find things."""
    blocks = [block.split("```")[0] for block in PAGE.read_text().split("```python\n")[1:]]
    names: dict[str, Any] = {"__name__": "show"}
    exec(blocks[-1].replace("CommandKind.SHOW", "CommandKind.FIND"), names)
    return names["Show"]()


def test_the_robot_stays_where_it_found_the_thing(monkeypatch: pytest.MonkeyPatch) -> None:
    show = deed()
    others = [each for each in DEEDS if each.kind != CommandKind.FIND]
    monkeypatch.setattr(trees.act, "DEEDS", (show, *others))
    run = run_mission("Find a power_drill", llm=False)
    assert run.outcome.status == MissionStatus.DONE
    assert run.outcome.reason == "Look, here is the power drill, on the shelf in the lobby."
    assert run.world.at == "shelf_lobby"
    assert show.is_true(run.outcome, "shelf_lobby")
    assert not show.is_true(run.outcome, "bed")


def test_every_file_that_the_page_names_is_there() -> None:
    rows = [line for line in PAGE.read_text().splitlines() if line.startswith("| `")]
    files = [row.split("`")[1] for row in rows if "show.py" not in row]
    assert len(files) == 5
    assert all((PAGE.parents[2] / file).is_file() for file in files)
