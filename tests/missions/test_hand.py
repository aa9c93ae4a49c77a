"""What the robot does with a thing that it holds, or that is at the delivery place already."""

import io
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from executive.app.session import Session
from executive.config import load_settings
from executive.replay.replaying import replay
from executive.types.outcome import MissionStatus


@contextmanager
def serving(runs: Path, recorded: bool, user: str = "oracle") -> Iterator[Session]:
    settings = load_settings(world="fake", user=user, llm="none", runs=runs)
    session = Session(settings, out=io.StringIO(), recorded=recorded)
    yield session
    session.close()


@pytest.fixture
def session(tmp_path: Path) -> Iterator[Session]:
    with serving(tmp_path, recorded=False) as session:
        yield session


def test_a_held_thing_is_handed_over_without_a_search(session: Session) -> None:
    session.run("Take the hammer")
    outcome = session.run("Bring the hammer")
    assert (outcome.status, outcome.visited) == (MissionStatus.DONE, ())
    assert session.world.resting_place("hammer") == "delivery"
    assert session.run("Take the mug").status == MissionStatus.DONE


@pytest.mark.parametrize("words", ["Take the hammer", "Where is the hammer?"])
def test_a_held_thing_is_said_to_be_held(session: Session, words: str) -> None:
    session.run("Take the hammer")
    outcome = session.run(words)
    assert (outcome.status, outcome.reason) == (MissionStatus.DONE, "I hold the hammer.")
    assert outcome.mission_time_s == 0.0


def test_what_is_held_is_put_back_for_another_thing_with_nobody_to_ask(tmp_path: Path) -> None:
    with serving(tmp_path, recorded=False, user="none") as session:
        place = session.world.resting_place("hammer")
        session.run("Take the hammer")
        outcome = session.run("Bring the power_drill")
        assert (outcome.status, outcome.object) == (MissionStatus.DONE, "power_drill")
        assert "I put the hammer back on the shelf in the lobby first." in session.parts.user.told
        assert session.world.resting_place("hammer") == place


def test_a_thing_at_the_delivery_place_stays_there(session: Session) -> None:
    session.run("Bring the hammer")
    outcome = session.run("Bring the hammer")
    assert (outcome.status, outcome.location) == (MissionStatus.DONE, "delivery")
    assert "is here already" in outcome.reason
    assert session.world.resting_place("hammer") == "delivery"


def test_a_mission_that_began_with_a_thing_in_the_hand_is_replayed(tmp_path: Path) -> None:
    with serving(tmp_path, recorded=True) as session:
        session.run("Take the hammer")
        run_dir = session.run("Bring the hammer").run_dir
    assert run_dir
    assert replay(Path(run_dir)).parting is None
