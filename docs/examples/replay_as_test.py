"""A recording is a regression test: its events, fed to today's tree, make the same mission.

    pytest docs/examples/replay_as_test.py

Keep the recordings that you care about (`mission.mcap` of a run is enough) in a folder, and hold
each against the tree in every test run. What parts is told with the tick and the behaviour.
"""

from pathlib import Path

import pytest

from executive import Session, load_settings
from executive.replay import replay


@pytest.fixture
def recordings(tmp_path: Path) -> Path:
    """A folder of recordings; yours is in your repository, this one is made on the spot."""
    settings = load_settings(world="fake", user="oracle", llm="none", runs=tmp_path)
    with Session(settings) as robot:
        for words in ("Find an apple", "Bring the mug"):
            robot.run(words)
    return tmp_path


def test_the_tree_still_decides_as_recorded(recordings: Path) -> None:
    """None of the missions parts from its recording."""
    for mission in sorted(recordings.rglob("mission.mcap")):
        again = replay(mission)
        assert again.parting is None, again.parting
