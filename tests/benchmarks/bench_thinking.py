"""What the seconds of thinking cost a mission while the search goes on.

    python tests/benchmarks/bench_thinking.py

The paper's nine commands in the instant world, with the embedded model's rankings, which are there
after so many seconds of mission time. Told is how much longer a mission takes than with a model
that thinks in no time. If the robot thought before it moves, all of the seconds would be lost.
"""

import sys
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from statistics import fmean
from typing import Any

sys.path.insert(0, str(Path(__file__).parent.parent / "helpers"))

from thinking import Slow

from executive.app.parts import Parts
from executive.campaign.report.paper import COMMANDS
from executive.config import load_settings
from executive.events import Ended, Inbox
from executive.testing.bench import Run, run_mission
from executive.types.llm import RankRequest
from executive.types.results import Scored
from kb.llm.open import model_for_missions
from sim.fake import FakeRobot

THINKING_S = (0.0, 0.3, 0.63, 1.0, 2.0, 5.0)


class Ranking(Slow):
    """Has the embedded model rank, once for each request."""

    known: dict[RankRequest, Scored] = {}

    def _answer(self, request: Any) -> int:
        if request not in self.known:
            self.known[request] = ranked(request)
        return self._world.schedule(self._thinking_s, lambda: self.known[request])


def ranked(request: RankRequest) -> Scored:
    within = Inbox()
    model = model_for_missions(load_settings(world="fake"), within)
    assert model
    try:
        model.rank(request)
        while True:
            within.wait(None)
            for event in within.take_all():
                if isinstance(event, Ended) and isinstance(event.result, Scored):
                    return event.result
    finally:
        model.close()


def mission(command: str, defaults: bool, thinking_s: float) -> Run:
    def change(parts: Parts) -> Parts:
        assert isinstance(parts.robot, FakeRobot)
        return replace(parts, model=Ranking((), parts.robot._world, thinking_s))

    return run_mission(command, search="plan", defaults=defaults, change=change)


def rows() -> Iterator[tuple[bool, list[float]]]:
    for defaults in (False, True):
        took = [
            fmean(mission(c, defaults, s).outcome.mission_time_s for c in COMMANDS)
            for s in THINKING_S
        ]
        yield defaults, took


def main() -> None:
    print(f"{'':14}{'mission [s]':>12}" + "".join(f"{s:>8g} s" for s in THINKING_S[1:]))
    for defaults, (at_once, *later) in rows():
        longer = "".join(f"{took - at_once:+10.2f}" for took in later)
        print(f"{'defaults' if defaults else 'no defaults':14}{at_once:12.2f}{longer}", flush=True)


if __name__ == "__main__":
    main()
