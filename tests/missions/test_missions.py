"""The paper's commands in the physics world, with the real model: all systems, both situations.

Nothing is scripted but the simulated person: the robot ranks with the embedded model, drives, sees,
grasps and delivers. Whether it did is decided by the simulator's truth.
"""

import io
from collections.abc import Iterator
from pathlib import Path

import pytest

from executive.app.session import Session
from executive.config import KnowledgeSystem, load_settings
from executive.events import StopRequested
from executive.records import Tick, Transforms
from executive.testing.bench import Notebook
from executive.types.commands import CommandKind
from executive.types.outcome import MissionStatus, Outcome

pytestmark = [pytest.mark.physics, pytest.mark.llm]

COMMANDS = {
    "Find an apple.": "dining_table",
    "Find a power_drill.": "shelf_lobby",
    "Find a colored_wood_blocks.": "bookshelf_bedroom",
    "Find a pitcher.": "counter_wagon",
    "Find a potted_meat_can.": "cabinet_kitchen",
    "Take a peach.": "high_table",
    "Take a mug.": "coffee_table",
    "Bring a mustard_bottle.": "cabinet_kitchen",
    "Bring a sugar_box.": "counter_wagon",
}
"""The paper's table of commands, with where the thing is."""


@pytest.fixture
def camera_hz() -> float:
    """No pictures for the log, which take a third of a mission: what it looks at, it sees."""
    return 0.0


@pytest.fixture
def session(
    tmp_path: Path, knowledge: KnowledgeSystem, defaults: bool, camera_hz: float
) -> Iterator[Session]:
    settings = load_settings(
        knowledge=knowledge, defaults=defaults, user="oracle", runs=tmp_path, camera_hz=camera_hz
    )
    session = Session(settings, out=io.StringIO())
    yield session
    session.close()


@pytest.mark.parametrize("words", COMMANDS)
@pytest.mark.parametrize("defaults", [True, False], ids=["defaults", "no defaults"])
@pytest.mark.parametrize("knowledge", list(KnowledgeSystem), ids=str)
def test_a_command_of_the_paper_is_done(session: Session, words: str) -> None:
    outcome = session.run(words)
    assert outcome.status == MissionStatus.DONE, outcome.reason
    assert outcome.location == COMMANDS[words]
    assert the_thing_is_where_it_belongs(session, outcome)


def the_thing_is_where_it_belongs(session: Session, outcome: Outcome) -> bool:
    """By the simulator's truth: untouched, between the fingers, or on the delivery table."""
    assert outcome.object
    resting = session.world.resting_place(outcome.object)
    match outcome.kind:
        case CommandKind.FIND:
            return resting == outcome.location
        case CommandKind.TAKE:
            return resting is None and session.parts.robot.holding
        case _:
            return resting == "delivery" and not session.parts.robot.holding


def test_the_same_seed_gives_the_same_ticks_and_times(tmp_path: Path) -> None:
    def one() -> list[object]:
        settings = load_settings(knowledge="okb", user="oracle", runs=tmp_path, seed=5)
        session, notebook = Session(settings, out=io.StringIO()), Notebook()
        record = session.recorder.record
        session.recorder.record = lambda r: (notebook.record(r), record(r))[1]  # type: ignore[method-assign]
        outcome = session.run("Take a peach.")
        session.close()
        ticks = [(t.cause, t.tip, t.nodes, t.situation) for t in notebook.all(Tick)]
        return [outcome.mission_time_s, outcome.visited, ticks]

    assert one() == one()


@pytest.mark.parametrize("knowledge", [KnowledgeSystem.OKB], ids=str)
@pytest.mark.parametrize("defaults", [False], ids=["no defaults"])
@pytest.mark.parametrize("camera_hz", [1.0], ids=["pictures"])
@pytest.mark.parametrize("when_s", [1.5, 9.0, 14.0], ids=["driving", "reaching", "carrying"])
def test_stop_leaves_the_robot_at_rest(
    session: Session, when_s: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    advance = session.world.advance

    def advance_and_stop(at_most: float) -> float:
        if session.parts.clock.now() >= when_s:
            session.inbox.post(StopRequested("the person"))
            monkeypatch.setattr(session.world, "advance", advance)
        return advance(at_most)

    monkeypatch.setattr(session.world, "advance", advance_and_stop)
    outcome = session.run("Bring a sugar_box.")
    assert outcome.status == MissionStatus.STOPPED
    assert when_s < outcome.mission_time_s < when_s + 2.0
    assert not session.inbox.awaits_anything
    before = where_the_robot_is(session)
    for _ in range(30):
        session.world.advance(1 / 60)
    assert where_the_robot_is(session) == pytest.approx(before, abs=2e-3)


def where_the_robot_is(session: Session) -> tuple[float, ...]:
    """Positions of all its frames (metres), as the world draws them."""
    notebook = Notebook()
    record = session.recorder.record
    session.recorder.record = notebook.record  # type: ignore[method-assign]
    session.world.describe()
    session.recorder.record = record  # type: ignore[method-assign]
    [transforms] = notebook.all(Transforms)
    things = set(session.parts.home.placement)
    return tuple(
        value for t in transforms.transforms if t.child not in things for value in t.pose.position
    )
