"""In no stretch of a mission in PyBullet the thread that ticks is deaf for long to a stop.

Judged by the thread's processor time, as other programs on the machine are not in it. Pictures are
left out: what PyBullet's renderer takes for one is the renderer's. So is the opening of the logs,
while nothing moves yet.
"""

from pathlib import Path

import pytest
from stretches import OPENING, PICTURES, Stretches

from executive import Session, load_settings
from executive.types.outcome import MissionStatus

LONGEST_S = 0.25

pytestmark = pytest.mark.physics


def test_a_stop_is_heard_again_and_again_while_a_thing_is_brought(tmp_path: Path) -> None:
    settings = load_settings(user="oracle", llm="none", runs=tmp_path)
    with Session(settings) as session, Stretches().watching() as stretches:
        outcome = session.run("Bring a mug")
    assert outcome.status == MissionStatus.DONE
    assert stretches.longest(PICTURES, OPENING).processor_s < LONGEST_S
