"""Runs the rerun viewer as a separate program, reachable from this machine only."""

import os
import signal
import socket
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path

from executive.errors import ExecutiveError
from executive.text import printable
from logs.viewer.display import has_display
from logs.viewer.timelines import MISSION_TIME

COMMAND = [sys.executable, "-m", "rerun", "--bind", "127.0.0.1"]
START_S = 20.0
"""Time limit for the start of a viewer (s)."""
SETTLE_S = 30.0
"""Time limit until the viewer's picture no longer changes (s)."""
_NO_VIEWER = "the rerun viewer does not start; it needs a display"


def show(recording: Path, *, web: bool = False) -> None:
    """Open a recording and wait until the viewer is closed; in the browser, until Ctrl-C.

    Raises:
        ExecutiveError: if it does not start, for example without a display.
    """
    if not web and not has_display():
        raise ExecutiveError(_NO_VIEWER)
    options = ["--web-viewer"] if web else []
    try:
        ended = subprocess.run([*COMMAND, *options, str(recording.absolute())], check=False)
    except KeyboardInterrupt:
        return
    if ended.returncode:
        raise ExecutiveError(_NO_VIEWER)


@dataclass(frozen=True, slots=True)
class LiveViewer:
    """A viewer that waits for data at an address; it outlives this process."""

    address: str
    process: subprocess.Popen[bytes]

    def close(self) -> None:
        """End `process` and the viewer, which is its child."""
        os.killpg(self.process.pid, signal.SIGKILL)
        self.process.wait()


def picture(recording: Path, mission_s: float) -> bytes:
    """A PNG picture of the viewer at a mission time (s), once it no longer changes.

    Needs no display, but a Vulkan driver (Debian's mesa-vulkan-drivers).

    Raises:
        ExecutiveError: if the viewer does not start, or its picture keeps changing.
    """
    from rerun.experimental import ViewerClient

    live = start("--headless")
    try:
        client = ViewerClient.connect(live.address)
        client.open(str(recording.resolve()))
        client.set_time(MISSION_TIME, duration=mission_s, play_state="paused")
        latest = time.monotonic() + SETTLE_S
        pictures: list[bytes] = [b"", client.take_screenshot()]
        while client.get_state().loading or len(set(pictures[-3:])) > 1:
            if time.monotonic() > latest:
                raise ExecutiveError("the viewer's picture does not come to rest")
            time.sleep(0.2)
            pictures.append(client.take_screenshot())
        return pictures[-1]
    except (RuntimeError, OSError, ValueError) as error:
        raise ExecutiveError(f"the viewer does not show {printable(recording)}: {error}") from error
    finally:
        live.close()


def start(*options: str) -> LiveViewer:
    """Start a viewer.

    Raises:
        ExecutiveError: if it does not start, for example without a display.
    """
    if "--headless" not in options and not has_display():
        raise ExecutiveError(_NO_VIEWER)
    port = _free_port()
    process = subprocess.Popen(
        [*COMMAND, *options, "--port", str(port), "--expect-data-soon"],
        start_new_session=True,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    latest = time.monotonic() + START_S
    while not _listens(port):
        if process.poll() is not None or time.monotonic() > latest:
            raise ExecutiveError(_NO_VIEWER)
        time.sleep(0.1)
    return LiveViewer(f"rerun+http://127.0.0.1:{port}/proxy", process)


def _free_port() -> int:
    with socket.socket() as any_port:
        any_port.bind(("127.0.0.1", 0))
        return int(any_port.getsockname()[1])


def _listens(port: int) -> bool:
    with socket.socket() as probe:
        return probe.connect_ex(("127.0.0.1", port)) == 0
