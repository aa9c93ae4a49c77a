"""What stands in docs/examples runs, and does what it says."""

import re
import runpy
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from executive import MissionStatus, Source
from executive.replay import replay
from logs.questions.decision import why_text
from logs.questions.why import why
from logs.recording.reader import Run

EXAMPLES = Path(__file__).parents[2] / "docs" / "examples"
FILES = sorted(f.name for f in EXAMPLES.iterdir() if f.is_file() and f.suffix != ".md")


def example(name: str) -> dict[str, Any]:
    return runpy.run_path(str(EXAMPLES / f"{name}.py"))


def test_the_smallest_program_brings_the_thing(tmp_path: Path) -> None:
    outcome = example("bring")["bring"]("Bring a sugar_box", tmp_path)
    assert outcome.status is MissionStatus.DONE
    assert Path(outcome.run_dir).parent == tmp_path


@pytest.mark.physics
def test_the_person_changes_their_mind_and_gets_the_other_thing(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    example("changing_ones_mind")["main"](str(tmp_path))
    assert "All right: I bring the scissors instead." in capsys.readouterr().err


@pytest.mark.physics
def test_the_robot_searches_while_the_model_thinks(tmp_path: Path) -> None:
    example("thinking_on_the_way")["main"](str(tmp_path))
    (run,) = tmp_path.iterdir()
    told = why_text(why(Run(run)))
    assert "I look at coffee_table 0.08 (anywhere 0.08)" in told
    assert re.search(
        r"I look at bookshelf_bedroom 0\.[789]", told
    )  # more, the more was seen before
    assert replay(run).parting is None


def test_the_added_behaviour_takes_the_robot_home(tmp_path: Path) -> None:
    own = example("own_behaviour")
    outcome = own["bring"]("Bring the mug", tmp_path)
    run = Path(outcome.run_dir)
    *_, last = Run(run).ticks()
    home = next(node for node in last.value.nodes if node.path.endswith("/go home"))
    assert (outcome.status, home.status, home.message) == (MissionStatus.DONE, "SUCCESS", "desk")
    assert replay(run, own["whole_tree"]).parting is None
    assert "behaviour gone since: day" in replay(run).notes


def test_the_added_behaviour_is_called_off_by_a_stop() -> None:
    from executive import DriveTo, Goal, Halt, Inbox, StopRequested
    from executive.testing.bench import run_mission

    def stop(goal: Goal, inbox: Inbox) -> None:
        if goal == DriveTo("desk"):
            inbox.post(StopRequested("the test"))

    tree = example("own_behaviour")["whole_tree"]
    run = run_mission("Bring the mug", during=stop, build=tree)
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
    assert "which object: pear  [ontology]" in why_text(why(Run(Path(fruit.run_dir))))


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


@pytest.fixture
def reads(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[[], object]:
    """Have the example read, without an argument, what is in runs/ of an own folder."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(sys, "argv", ["read_a_recording.py"])
    file = str(EXAMPLES / "read_a_recording.py")
    return lambda: runpy.run_path(file, run_name="__main__")


def test_without_a_name_the_newest_recording_is_told(
    reads: Callable[[], object], capsys: pytest.CaptureFixture[str]
) -> None:
    for words in ("Find an apple", "Find the mug"):
        example("bring")["bring"](words, Path("runs"))
    reads()
    assert "done: The mug is on " in capsys.readouterr().out


def test_without_any_recording_it_is_said_in_a_sentence(reads: Callable[[], object]) -> None:
    with pytest.raises(SystemExit, match="error: runs: there is no run; name a run's folder"):
        reads()


def test_a_recording_tells_its_story(tmp_path: Path) -> None:
    outcome = example("bring")["bring"]("Find an apple", tmp_path)
    first, *_, last = example("read_a_recording")["story"](Path(outcome.run_dir))
    assert first.startswith("run ")
    assert last == "done: The apple is on the dining table in the living room."


@pytest.mark.parametrize("file", FILES)
def test_every_example_stands_in_the_table(file: str) -> None:
    assert f"]({file})" in (EXAMPLES / "README.md").read_text()
