"""Starts the drawing process, sends it requests and receives its pictures."""

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
"""Pictures that may be queued; for any more, the caller has to draw."""
PATIENCE_S = 10.0
"""Timeout of a picture (real seconds); the first includes the start of the process."""
ENDING_S = 0.2
"""How long the process may take to end by itself (real seconds)."""
PIPE_BYTES = 1 << 20
"""Size of the pipe's buffer, large enough for a picture, where the system allows to set it."""
PROGRAM = "import sys; sys.path[:] = {path!r}; from sim.pictures.painter import main; main()"
_NO_THREADS = {"OPENBLAS_NUM_THREADS": "1"}
"""The drawing process does no linear algebra."""


def command() -> list[str]:
    """The command that starts the drawing process, with the module path of this process."""
    return [sys.executable or "", "-c", PROGRAM.format(path=sys.path)]


class Painter:
    """Requests pictures from the drawing process, one at a time, on a thread of its own."""

    def __init__(self, stage: Stage, program: Sequence[str] = ()) -> None:
        """Start the process, and send it the world to build.

        Args:
            stage: the world.
            program: a command to start instead of the drawing process.

        Raises:
            OSError: if the process cannot be started.
            RuntimeError: if no thread can be started.
        """
        self._process = subprocess.Popen(
            program or command(),
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            env={**os.environ, **_NO_THREADS},
            start_new_session=True,  # it must not get the Ctrl-C of the terminal
            pipesize=PIPE_BYTES,
        )
        self._thread = ThreadPoolExecutor(1, "pictures")
        self._waiting: list[Future[Pixels]] = []
        self.failure = ""
        """Why the process draws no more; empty while it works."""
        self._thread.submit(self._send, stage)

    def paint(self, asked: Asked) -> "Future[Pixels] | None":
        """Request a picture; None if the process draws no more, or if the queue is full.

        An awaited picture is queued in any case: its caller requests only one at a time.
        """
        self._waiting = [coming for coming in self._waiting if not coming.done()]
        if self.failure or (len(self._waiting) >= MOST_WAITING and not asked.awaited):
            return None
        coming = self._thread.submit(self._receive, asked)
        self._waiting.append(coming)
        return coming

    def close(self) -> None:
        """Wait until the requested pictures are drawn, at most PATIENCE_S; end the process."""
        wait(self._waiting, PATIENCE_S)
        self._end()
        self._thread.shutdown()

    # --- on its thread ---

    def _receive(self, asked: Asked) -> Pixels:
        """Send a request, and wait for its pixels."""
        if self.failure:
            raise NotDrawnError(self.failure)
        try:
            self._send(asked)
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

    def _send(self, what: Stage | Asked) -> None:
        assert self._process.stdin is not None
        pickle.dump(what, self._process.stdin, PROTOCOL)
        self._process.stdin.flush()

    def _answers(self) -> IO[bytes]:
        """The process's output, once there is something to read.

        Raises:
            TimeoutError: if there is nothing for PATIENCE_S.
        """
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
        with suppress(OSError):  # the process has not read everything
            self._process.stdin.close()
        try:
            self._process.wait(ENDING_S)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
        self._process.stdout.close()
