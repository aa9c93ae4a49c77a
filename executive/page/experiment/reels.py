"""The reels that pages look at: of the mission that runs, and of the past runs looked at last."""

import threading
from collections import OrderedDict
from collections.abc import Callable
from pathlib import Path
from typing import Any

from executive.errors import ExecutiveError
from executive.page.board import Board
from executive.page.experiment.reel import READ, Reel
from executive.records import Record
from logs.recorder import Stamp
from logs.recording.reader import Run

MOST_KEPT = 4
"""Past runs: two side by side, and two before."""
LIVE = "live"
"""What pages call the mission that runs, or that ran last."""


class LiveReel:
    """Implements Sink: keeps the mission that runs on a reel. It outlives missions."""

    live = True
    """Someone watches: it is flushed soon."""

    def __init__(self, board: Board) -> None:
        """Tell this board how far it is."""
        self._board = board
        self._number = 0
        self.name: Callable[[], str] = lambda: ""
        """Tells the name of the mission's folder; empty if it is not recorded."""
        self.flushed: Callable[[], None] = lambda: None
        """Is called before the pages are told."""
        self.reel = Reel(LIVE)
        self.reel.whole = True

    def write(self, stamp: Stamp, record: Record) -> None:
        """Keep it; the first record after the end of a mission begins another reel."""
        if self.reel.whole:
            self._number += 1
            self.reel = Reel(LIVE)
        self.reel.take(stamp.mission_s, record)

    def going(self) -> str:
        """To which place the robot goes to look, or where it looks; empty if it does not."""
        reel = self.reel
        fact = reel.fact
        searches = fact("candidate") and not fact("found") and not reel.whole
        return str(fact("candidate")["place"]) if searches else ""

    def choosing(self) -> dict[str, Any] | None:
        """Which choice of a place waits for an experimenter; None if none does."""
        choice = None if self.reel.whole else self.reel.fact("held_choice")
        return choice if isinstance(choice, dict) else None

    def flush(self) -> None:
        """Tell the pages how far it is."""
        self.flushed()
        reel = self.reel
        self._board.put(
            "live",
            {
                "mission": self._number,
                "run": self.name(),
                "nodes": len(reel.nodes),
                "last": reel.last,
                "lines": len(reel.lines),
                "over": reel.whole,
            },
        )
        self._board.flush()

    def close(self) -> None:
        """The mission is over."""
        self.reel.whole = True
        self.flush()


class Reels:
    """Past runs, read in threads of their own: what is read already can be shown meanwhile."""

    def __init__(self) -> None:
        """None is read yet."""
        self._lock = threading.Lock()
        self._kept: OrderedDict[str, Reel] = OrderedDict()

    def of(self, folder: Path, *, anew: bool = False) -> Reel:
        """The reel of a run; it is being read, or was. `anew`: it may go on further by now."""
        with self._lock:
            reel = self._kept.get(folder.name)
            if reel is None or (anew and reel.whole and reel.outcome is None):
                reel = self._kept[folder.name] = Reel(folder.name)
                threading.Thread(target=read, args=[reel, folder], daemon=True).start()
            self._kept.move_to_end(folder.name)
            while len(self._kept) > MOST_KEPT:
                _, dropped = self._kept.popitem(last=False)
                dropped.whole = True  # whoever reads it may stop
            return reel


def read(reel: Reel, folder: Path) -> None:
    """Read a recording to its end, or until the reel is not wanted any more."""
    try:
        for at in Run(folder).records(*READ):
            if reel.whole:
                return
            reel.take(at.time_s, at.value)
    except (ExecutiveError, OSError) as error:
        reel.trouble = str(error)
    finally:
        reel.whole = True
