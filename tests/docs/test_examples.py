"""What stands in docs/examples runs, and does what it says."""

import runpy
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from executive import MissionStatus, Source

EXAMPLES = Path(__file__).parents[2] / "docs" / "examples"
FILES = sorted(f.name for f in EXAMPLES.iterdir() if f.is_file() and f.suffix != ".md")


def example(name: str) -> dict[str, Any]:
    return runpy.run_path(str(EXAMPLES / f"{name}.py"))


def test_the_smallest_program_brings_the_thing(tmp_path: Path) -> None:
    outcome = example("bring")["bring"]("Bring a sugar_box", tmp_path)
    assert outcome.status is MissionStatus.DONE
    assert Path(outcome.run_dir).parent == tmp_path


def test_the_added_behaviour_takes_the_robot_home() -> None:
    run = example("own_behaviour")["bring"]("Bring the mug")
    assert (run.outcome.status, run.world.at) == (MissionStatus.DONE, "desk")


def test_the_added_behaviour_is_called_off_by_a_stop() -> None:
    from executive import DriveTo, Goal, Halt, Inbox, StopRequested
    from executive.testing.bench import run_mission
    from trees.tree import MissionTree

    def stop(goal: Goal, inbox: Inbox) -> None:
        if goal == DriveTo("desk"):
            inbox.post(StopRequested("the test"))

    tree = example("own_behaviour")["mission_and_home"]
    run = run_mission("Bring the mug", during=stop, build=lambda c: MissionTree(tree(c)))
    assert run.goals[-2:] == [DriveTo("desk"), Halt()]
    assert run.world.at != "desk"


def test_the_home_of_the_example_is_the_one_that_its_page_explains(tmp_path: Path) -> None:
    page = (EXAMPLES.parent / "own-home.md").read_text()
    assert page.split("```toml\n")[1].split("```")[0] in (EXAMPLES / "own_home.toml").read_text()
    outcome = example("own_home")["bring"]("Bring the sugar_box", tmp_path)
    assert outcome.location == "pantry_rack"


def test_the_ontology_adds_a_name_a_place_and_a_taste(tmp_path: Path) -> None:
    find = example("own_ontology")["find"]
    hammer, fruit = find("Find the whacker", tmp_path), find("Find a fruit", tmp_path)
    assert (hammer.location, hammer.source) == ("desk", Source.ONTOLOGY)
    assert (fruit.object, fruit.inquiries) == ("pear", 0)


def test_the_detector_sees_what_has_a_tag_and_nothing_else() -> None:
    find = example("own_detector")["find"]
    assert find("Find the hammer").status is MissionStatus.DONE
    assert find("Find the pear").status is MissionStatus.NOT_DONE


def test_the_model_is_asked_and_its_invented_place_is_not_visited(tmp_path: Path) -> None:
    outcome = example("own_model")["find"]("Find the pitcher", tmp_path)
    assert (outcome.status, outcome.source) == (MissionStatus.DONE, Source.LLM)
    assert outcome.visited == ("counter_wagon",)


def test_a_model_that_does_not_know_leaves_it_to_the_person(tmp_path: Path) -> None:
    outcome = example("own_model")["find"]("Find the mug", tmp_path)
    assert outcome.status is MissionStatus.NOT_DONE
    assert outcome.model_failure == "my table has no such thing"


def test_the_recordings_replay_under_pytest() -> None:
    file = EXAMPLES / "replay_as_test.py"
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", str(file)]
    ran = subprocess.run(command, capture_output=True, text=True, cwd=EXAMPLES.parents[1])
    assert ran.returncode == 0, ran.stdout


def test_a_recording_tells_its_story(tmp_path: Path) -> None:
    outcome = example("bring")["bring"]("Find an apple", tmp_path)
    first, *_, last = example("read_a_recording")["story"](Path(outcome.run_dir))
    assert first.startswith("run ")
    assert last == "done: The apple is at dining_table."


@pytest.mark.parametrize("file", FILES)
def test_every_example_stands_in_the_table(file: str) -> None:
    assert f"]({file})" in (EXAMPLES / "README.md").read_text()
