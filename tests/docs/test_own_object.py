"""The example in docs/examples/own_object.toml does what docs/own-home.md says."""

import io
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from onnx_models import v8, write_model

from executive.app.session import Session
from executive.app.simulation import blind_to
from executive.config import KnowledgeSystem, Settings
from executive.perception.detector import OnnxDetector
from executive.replay import replay
from executive.types.outcome import Outcome

HOME = Path(__file__).parents[2] / "docs" / "examples" / "own_object.toml"


def run(words: str, runs: Path, **given: object) -> Outcome:
    """One mission in the home of the example, which replays as it was."""
    base = {"home": str(HOME), "runs": runs, "llm": "none", "user": "oracle", "world": "fake"}
    settings = Settings(**{**base, "knowledge": KnowledgeSystem.OKB, **given})
    session = Session(settings, out=io.StringIO())
    try:
        outcome = session.run(words)
    finally:
        session.close()
    assert session.folder
    assert replay(session.folder).parting is None
    return outcome


def test_the_page_shows_what_the_example_has() -> None:
    page = (HOME.parents[1] / "own-home.md").read_text()
    shown = page.split("## Objects of your own")[1].split("```toml\n")[1].split("```")[0]
    assert shown in HOME.read_text()


@pytest.mark.parametrize("thing", ["teapot", "doorstop"])
def test_a_declared_object_is_brought_in_the_instant_world(tmp_path: Path, thing: str) -> None:
    outcome = run(f"Bring the {thing}", tmp_path)
    assert (outcome.status, outcome.object) == ("done", thing)


def test_it_is_found_where_it_is_placed(tmp_path: Path) -> None:
    outcome = run("Find the teapot", tmp_path, place={"teapot": "rack"})
    assert (outcome.status, outcome.location) == ("done", "rack")


def test_what_is_too_wide_for_the_hand_is_found_and_not_brought(tmp_path: Path) -> None:
    assert run("Find the crate", tmp_path).status == "done"
    outcome = run("Bring the crate", tmp_path)
    assert outcome.status == "not_done"
    assert outcome.reason == "I cannot grasp the crate as it lies: it is wider than my hand opens"


@pytest.mark.physics
@pytest.mark.parametrize("thing", ["teapot", "doorstop"])
def test_it_is_brought_in_physics_by_its_form(tmp_path: Path, thing: str) -> None:
    outcome = run(f"Bring the {thing}", tmp_path, world="physics", detector="simulated")
    assert (outcome.status, outcome.object) == ("done", thing)


@pytest.mark.physics
def test_the_learned_detector_does_not_know_it_and_that_is_the_reason(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    outcome = run("Bring the teapot", tmp_path, world="physics")
    assert (outcome.status, outcome.visited) == ("not_done", ())
    assert outcome.reason == "I would not recognise the teapot: my detector does not know it"
    assert "the detector does not know teapot, doorstop, crate" in caplog.text


@pytest.fixture
def session(tmp_path: Path) -> Iterator[Session]:
    """What knows the home of the example."""
    made = Session(Settings(home=str(HOME), world="fake", llm="none", runs=tmp_path))
    yield made
    made.close()


def test_a_detector_of_ones_own_knows_what_its_class_list_names(
    tmp_path: Path, session: Session
) -> None:
    said = np.asarray(v8([]))
    file = write_model(tmp_path, said, names="['teapot', 'mug']")
    detector = OnnxDetector(file, session.parts.knowledge.objects_named)
    assert blind_to(session.parts.home, detector) == ("doorstop", "crate")
    assert blind_to(session.parts.home, session.parts.robot) == ()
