"""What the experimenter's page asks: of the mission that runs, and of past runs."""

import json
import shutil
import subprocess
import sys
import threading
from dataclasses import asdict
from pathlib import Path
from typing import Any

from executive.errors import InputError
from executive.events import Inbox
from executive.page.board import Board
from executive.page.experiment.because import because
from executive.page.experiment.reel import Line, Reel
from executive.page.experiment.reels import LIVE, LiveReel, Reels
from executive.page.experiment.runs import Runs
from executive.page.experiment.wizard import Wizard
from executive.page.person import PagePerson
from executive.types.results import Replied, Scored
from logs.questions.difference import parting
from logs.recording.reader import FILE_NAME, Run
from logs.viewer.display import has_display

MOST_LINES = 300
MARKED = ("said", "model", "intervened", "mishap", "end")
"""What stands in the strip above the slider."""
MOST_MARKS = 2000
REPLAY_S = 900.0
STARTED_S = 4.0
"""A viewer that cannot be shown has ended by then, as a rule."""
LONGEST_REPLAY = 20_000
"""Of what a replay says (characters)."""


class Desk:
    """Behind the experimenter's page: every answer is plain values for JSON. For any thread."""

    def __init__(self) -> None:
        """Nothing runs, and no past runs are known."""
        self.board = Board()
        self.live = LiveReel(self.board)
        self._reels = Reels()
        self._runs: Runs | None = None
        self.wizard: Wizard | None = None
        self._replaying = threading.Lock()
        self._viewers: list[subprocess.Popen[bytes]] = []

    def step_in(self, inbox: Inbox, person: PagePerson) -> None:
        """Have the experimenter speak for this person, and to the robot."""

        def asking(question: dict[str, Any] | None) -> None:
            self.board.put("question", question)
            self.board.flush()

        person.asking = asking
        self.wizard = Wizard(inbox, person, self.board)
        self.wizard.going = self.live.going
        self.wizard.choosing = self.live.choosing
        self.live.flushed = self.wizard.show_choice

    def look_in(self, folder: Path) -> None:
        """The past runs are in this folder."""
        self._runs = Runs(folder)

    def intervene(self, sent: dict[str, Any]) -> dict[str, Any]:
        """Step in.

        Raises:
            InputError: if that cannot be, or is over.
        """
        if self.wizard is None:
            raise InputError("deed", "nobody can step in here")
        return self.wizard.do(sent)

    # --- runs ---

    def runs(self, words: str, status: str) -> dict[str, Any]:
        """The past runs that have these words and ended so."""
        return self._past.found(words, status)

    def run(self, name: str, known: int = 0, *, anew: bool = False) -> dict[str, Any]:
        """A run's tree, how far it is read, and what is marked in it.

        The tree is left out if so many behaviours of it are known already: then it is all of it.
        One that had not ended when it was read is read again, `anew`.
        """
        reel = self._reel(name, anew=anew)
        whole = reel.whole  # first: what is whole then does not change below
        outcome = reel.outcome
        marks = [(ln.step, ln.kind) for ln in tuple(reel.lines) if ln.kind in MARKED]
        return {
            "run": reel.name,
            "size": len(reel.nodes),
            "nodes": [asdict(n) for n in reel.nodes] if len(reel.nodes) != known else [],
            "last": reel.last,
            "whole": whole,
            "trouble": reel.trouble,
            "marks": marks[:: 1 + len(marks) // MOST_MARKS],
            "status": outcome.status if outcome else "",
            "reason": outcome.reason if outcome else "",
        }

    def step(self, name: str, step: int, shown: int | None) -> dict[str, Any]:
        """All after a tick, as far as it is not as after the tick that is shown."""
        reel = self._reel(name)
        whole = reel.whole  # first, as above
        here = _within(reel, step)
        if here < 0:
            return {"step": -1, "last": -1, "whole": whole, "nodes": {}, "facts": {}}
        moment = reel.moments[here]
        return {
            "step": here,
            "last": reel.last,
            "whole": whole,
            **asdict(moment),
            "nodes": reel.differing(here, shown),
            "facts": _plain(reel.facts(here, shown)),
        }

    def lines(self, name: str, step: int, kinds: str, words: str) -> list[dict[str, Any]]:
        """What happened up to a tick, of these kinds and with these words, the latest last."""
        wanted, told = set(filter(None, kinds.split(","))), words.lower().split()

        def is_wanted(line: Line) -> bool:
            return line.kind in wanted and all(word in line.text.lower() for word in told)

        reel = self._reel(name)
        found = reel.lines_to(_within(reel, step), MOST_LINES, is_wanted)
        return [asdict(line) for line in found]

    def node(self, name: str, step: int, place: int) -> dict[str, Any]:
        """Why a behaviour has its status after a tick, and all that became of it."""
        reel = self._reel(name)
        if not 0 <= place < len(reel.nodes):
            raise InputError("node", "there is no such behaviour")
        return {
            "because": because(reel, place, _within(reel, step)),
            "changes": list(reel.changes(place))[-MOST_LINES:],
        }

    def call(self, name: str, number: int) -> dict[str, Any]:
        """What the model was asked, and what it answered."""
        calls = self._reel(name).calls
        if not 0 <= number < len(calls):
            raise InputError("call", "there is no such call")
        result = calls[number].result
        scored = result.scores if isinstance(result, Scored) else ()
        places = result.request.places if isinstance(result, Scored) else ()
        return {
            "label": result.request.label,
            "messages": [[one.role, one.content] for one in result.request.messages],
            "answer": result.text if isinstance(result, Replied) else "",
            "scores": sorted(zip(scored, places, strict=False), reverse=True),
            "model": result.usage.model,
            "seconds": result.usage.total_s,
            "tokens_in": result.usage.input_tokens,
            "tokens_out": result.usage.output_tokens,
        }

    # --- questions to recordings ---

    def parting(self, one: str, other: str) -> dict[str, Any]:
        """The first tick in which two runs are not alike, and in what."""
        found = parting(Run(self._past.path(one)), Run(self._past.path(other)))
        return {"parting": asdict(found) if found else None}

    def replay(self, name: str) -> dict[str, Any]:
        """A run held against today's tree, in a process of its own: the mission goes on meanwhile.

        Raises:
            InputError: if another one is being replayed.
        """
        folder = self._past.path(name)
        if not self._replaying.acquire(blocking=False):
            raise InputError("replay", "another run is being replayed", "wait until that is done")
        try:
            ended = subprocess.run(
                [*_gently(), sys.executable, "-m", "logs", "replay", str(folder)],
                capture_output=True,
                text=True,
                errors="replace",
                timeout=REPLAY_S,
                check=False,
            )
        except subprocess.TimeoutExpired:
            return {"same": False, "text": f"This takes longer than {REPLAY_S:.0f} s."}
        finally:
            self._replaying.release()
        told = (ended.stdout or ended.stderr)[:LONGEST_REPLAY]
        return {"same": ended.returncode == 0, "text": told}

    def view(self, name: str) -> dict[str, str]:
        """Open a run in the rerun viewer, on the machine where the robot's program runs.

        It may take a while until the viewer is seen.

        Raises:
            InputError: if it does not start, as without a display.
        """
        folder = self._past.path(name)
        drawn = folder / "mission.rrd"
        recording = drawn if drawn.is_file() else folder / FILE_NAME
        if has_display():
            viewer = subprocess.Popen(
                [sys.executable, "-m", "logs", "view", str(recording)],
                stdin=subprocess.DEVNULL,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL,
                start_new_session=True,
            )
            self._viewers = [one for one in self._viewers if one.poll() is None]
            try:
                viewer.wait(STARTED_S)
            except subprocess.TimeoutExpired:
                self._viewers.append(viewer)
                return {"shown": str(recording)}
        what = "the viewer does not start; it needs a display where the robot's program runs"
        raise InputError("rerun", what, f"on a machine with one: python -m logs view {recording}")

    @property
    def _past(self) -> Runs:
        if self._runs is None:
            raise InputError("run", "the robot is getting ready", "wait a little")
        return self._runs

    def _reel(self, name: str, *, anew: bool = False) -> Reel:
        """The reel of a run.

        Raises:
            InputError: if there is none.
        """
        if name == LIVE or name == self.live.name():
            return self.live.reel
        return self._reels.of(self._past.path(name), anew=anew)


def _within(reel: Reel, step: int) -> int:
    return max(-1, min(step, reel.last))


def _plain(facts: dict[str, Any]) -> dict[str, str]:
    """Each as the text of its JSON."""
    return {key: json.dumps(value, default=str)[:4000] for key, value in facts.items()}


def _gently() -> list[str]:
    """Have a process leave the machine to the mission, where that can be said."""
    nice = shutil.which("nice")
    return [nice, "-n", "10"] if nice else []
