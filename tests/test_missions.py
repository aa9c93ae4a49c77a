"""The paper's commands in the physics world, with the real model: all systems, both situations.

Nothing is scripted but the simulated person: the robot ranks with the embedded model, drives, sees,
grasps and delivers. Whether it did is decided by the simulator's truth.
"""

import io
from collections.abc import Iterator
from pathlib import Path

import pytest

from executive.app import Session
from executive.config import KnowledgeSystem, load_settings
from executive.types import Kind, Outcome, Status

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
def session(
    tmp_path: Path, knowledge: KnowledgeSystem, defaults: bool, request: pytest.FixtureRequest
) -> Iterator[Session]:
    settings = load_settings(knowledge=knowledge, defaults=defaults, user="oracle", runs=tmp_path)
    session = Session(settings, out=io.StringIO())
    yield session
    session.close()


@pytest.mark.parametrize("words", COMMANDS)
@pytest.mark.parametrize("defaults", [True, False], ids=["defaults", "no defaults"])
@pytest.mark.parametrize("knowledge", list(KnowledgeSystem), ids=str)
def test_a_command_of_the_paper_is_done(session: Session, words: str) -> None:
    outcome = session.run(words)
    assert outcome.status == Status.DONE, outcome.reason
    assert outcome.location == COMMANDS[words]
    assert the_thing_is_where_it_belongs(session, outcome)


def the_thing_is_where_it_belongs(session: Session, outcome: Outcome) -> bool:
    """By the simulator's truth: untouched, between the fingers, or on the delivery table."""
    assert outcome.object
    resting = session.world.resting_place(outcome.object)
    match outcome.kind:
        case Kind.FIND:
            return resting == outcome.location
        case Kind.TAKE:
            return resting is None and session.robot.holding
        case _:
            return resting == "delivery" and not session.robot.holding
