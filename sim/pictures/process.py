"""The process that draws, as seen from the one that asks it."""

import os
import pickle
import select
import subprocess
import sys
from collections.abc import Sequence
from concurrent.futures import Future, ThreadPoolExecutor, wait
from contextlib import suppress
from typing import IO

from sim.pictures.coming import NotDrawnError
from sim.pictures.painter import PROTOCOL, Asked, Pixels, Stage

MOST_WAITING = 4
"""Pictures that may wait to be drawn; any more are for who asks for them to draw."""
PATIENCE_S = 10.0
"""The longest that a picture may take (real seconds), the start of the process included."""
ENDING_S = 0.2
"""How long the process may take to end by itself (real seconds)."""
PIPE_BYTES = 1 << 20
"""Room for a picture on its way, where the system allows to set it."""
PROGRAM = "import sys; sys.path[:] = {path!r}; from sim.pictures.painter import main; main()"
_NO_THREADS = {"OPENBLAS_NUM_THREADS": "1"}
"""It does no linear algebra."""


def command() -> list[str]:
    """What starts it, with the packages of this process."""
    return [sys.executable or "", "-c", PROGRAM.format(path=sys.path)]


class Painter:
    """Asks the process for one picture after the other, on a thread of its own."""

    def __init__(self, stage: Stage, program: Sequence[str] = ()) -> None:
        """Start it, and have it build its copy of a world; `program` is another one to start.

        Raises:
            OSError: if there can be no such process.
        """
        self._process = subprocess.Popen(
            program or command(),
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            env={**os.environ, **_NO_THREADS},
            start_new_session=True,  # Ctrl-C is not for it
            pipesize=PIPE_BYTES,
        )
        self._thread = ThreadPoolExecutor(1, "pictures")
        self._waiting: list[Future[Pixels]] = []
        self.failure = ""
        """Why it draws no more; empty while it does."""
        self._thread.submit(self._say, stage)

    def paint(self, asked: Asked) -> "Future[Pixels] | None":
        """Ask for a picture; None if it draws no more, or too many others wait already.

        One that is awaited is drawn in any case: who asks for it asks for one at a time.
        """
        self._waiting = [coming for coming in self._waiting if not coming.done()]
        if self.failure or (len(self._waiting) >= MOST_WAITING and not asked.awaited):
            return None
        coming = self._thread.submit(self._painted, asked)
        self._waiting.append(coming)
        return coming

    def close(self) -> None:
        """Have what was asked for drawn, and end the process."""
        wait(self._waiting, PATIENCE_S)
        self._end()
        self._thread.shutdown()

    # --- on its thread ---

    def _painted(self, asked: Asked) -> Pixels:
        if self.failure:
            raise NotDrawnError(self.failure)
        try:
            self._say(asked)
            pixels: Pixels = pickle.load(self._answers())
        except Exception as error:
            self.failure = self._why(error)
            raise NotDrawnError(self.failure) from error
        return pixels

    def _why(self, error: Exception) -> str:
        if isinstance(error, TimeoutError):
            return f"the process that drew them has not answered for {PATIENCE_S:g} s"
        self._process.kill()
        return f"the process that drew them has ended (exit status {self._process.wait()})"

    def _say(self, what: Stage | Asked) -> None:
        assert self._process.stdin is not None
        pickle.dump(what, self._process.stdin, PROTOCOL)
        self._process.stdin.flush()

    def _answers(self) -> IO[bytes]:
        """What it says, once it says something."""
        answers = self._process.stdout
        assert answers is not None
        if not select.select([answers], [], [], PATIENCE_S)[0]:
            raise TimeoutError
        return answers

    def _end(self) -> None:
        if self.failure or not all(coming.done() for coming in self._waiting):
            self._process.kill()
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        with suppress(OSError):  # what it did not read
            self._process.stdin.close()
        try:
            self._process.wait(ENDING_S)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
        self._process.stdout.close()
