"""The robot searches while its language model is still thinking, and the plan changes its mind.

    python docs/examples/thinking_on_the_way.py [RUNS]   # about 20 s; then: python -m logs view

Nothing is known of the mug, so the robot looks where it comes by first. The model stands in for a
slow one: after some seconds it writes that the mug is in the bedroom, and the robot turns to there.
"""

import sys
from pathlib import Path
from threading import Timer

from executive import Inbox, MissionStatus, Session, load_settings
from executive.types.llm import ChatRequest, Usage
from executive.types.results import Replied
from kb.llm.scripted import Scripted

THINKING_S = 9.0
LIST = '{"places": ["bookshelf_bedroom"]}'


class Slow(Scripted):
    """Writes one list, after a while of real time."""

    def chat(self, request: ChatRequest) -> int:
        """Begin to think; the reply ends the request, from another thread."""
        number = self._inbox.open(real=True)
        reply = Replied(request, LIST, Usage(self.name))
        later = Timer(THINKING_S, self._inbox.end, (number, reply))
        later.daemon = True
        later.start()
        return number


def main(runs: str = "runs") -> None:
    """Find the mug, which is on the bookshelf in the bedroom."""
    inbox = Inbox()
    settings = load_settings(
        runs=Path(runs),
        user="none",
        defaults=False,
        elicit="generate",
        place={"mug": "bookshelf_bedroom"},
    )
    with Session(settings, inbox=inbox, model=Slow((), inbox)) as robot:
        outcome = robot.run("Find the mug")
    assert outcome.status == MissionStatus.DONE, outcome.reason
    assert outcome.visited[-1] == "bookshelf_bedroom"


if __name__ == "__main__":
    main(*sys.argv[1:])
