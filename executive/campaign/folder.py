"""A campaign's folder: locked by one process, with a journal, and consistent however it ends."""

import json
import os
import platform
import signal
import sys
import time
from collections.abc import Callable, Sequence
from contextlib import ExitStack
from importlib.metadata import version
from pathlib import Path
from tempfile import TemporaryFile
from types import FrameType
from typing import Any, Protocol, TextIO

from executive.app.recording import PACKAGES
from executive.campaign.claim import lock_folder
from executive.campaign.runners import Kept, Runner
from executive.config import Settings
from executive.errors import InputError
from executive.files import read_text, write_whole
from executive.shell import on_stop_signals
from executive.terminal import show_over
from executive.text import printable

VARIED = {"knowledge", "defaults", "seed", "runs", "home", "llm"}
"""Settings that a campaign varies."""
SHOWN_EVERY_S = 0.5


class Progress:
    """One line on standard error: missions done, and the time left at the pace so far."""

    def __init__(self, total: int, count: Callable[[], int], out: TextIO | None = None) -> None:
        """`count` returns how many missions have ended; those ended before do not count as pace."""
        self._total, self._count = total, count
        self._before = count()
        self._began = self._shown = time.monotonic()
        self._out = out or sys.stderr

    def __call__(self) -> None:
        """Show the progress, at most every half second."""
        if time.monotonic() - self._shown > SHOWN_EVERY_S:
            self.show()

    def show(self) -> None:
        """Show the progress now."""
        self._shown, done = time.monotonic(), self._count()
        if now := done - self._before:
            left_s = (self._shown - self._began) / now * (self._total - done)
            line = f"{done} of {self._total} missions, {clock(left_s)} left"
            show_over(line, self._out)


def clock(seconds: float) -> str:
    """A duration as h:mm:ss."""
    minutes, s = divmod(round(seconds), 60)
    return f"{minutes // 60}:{minutes % 60:02}:{s:02}"


class Journal(Kept, Protocol):
    """The file with the results of ended missions."""

    def mend(self) -> None:
        """Remove an incomplete line at the end."""
        ...

    def damage(self) -> list[str]:
        """A sentence for each damaged line."""
        ...


class Folder:
    """The folder, in which the remaining missions are run."""

    def __init__(
        self, out: Path, settings: Settings, commands: Sequence[str], journal: Journal
    ) -> None:
        """Make and lock the folder, and warn of damage in its journal.

        Raises:
            InputError: if it cannot be used, holds another campaign, or another process runs one
                in it.
        """
        self._out, self._journal = out, journal
        self._interrupted = False
        make_folder(out, "--out")
        with ExitStack() as until_it_fails:
            self.lock = until_it_fails.enter_context(lock_folder(out, "--out"))
            """Closing it releases the folder; `run` does that."""
            self.about = claim(out, settings, commands)
            """Facts for the report."""
            journal.mend()
            self.damage = journal.damage()
            until_it_fails.pop_all()
        for sentence in self.damage:
            print(f"warning: {printable(sentence)}; it is not counted", file=sys.stderr)

    def run(
        self, runner: Runner, units: Sequence[Any], count: Progress, write: Callable[[], None]
    ) -> bool:
        """Run the missions that have not ended, and write the results.

        Args:
            runner: runs the missions.
            units: all units of the campaign.
            count: shows the progress.
            write: writes tables and report; called however the run ends.

        Returns:
            False if it was interrupted.

        Raises:
            ExecutiveError: if missions cannot be run, or journal or tables cannot be written.
        """
        try:
            with on_stop_signals(self._interrupt):
                runner.run(units, self._journal, count)
            count.show()
        except KeyboardInterrupt:
            print("\nstopped; the same command goes on from here", file=sys.stderr)
            return False
        finally:
            with self.lock:
                self._write(write)
        folder = printable(self._out)
        print(f"\n{folder}/report.md\n{folder}/report.html", file=sys.stderr)
        return True

    def is_interrupted(self) -> bool:
        """Whether a stop signal has come."""
        return self._interrupted

    def _interrupt(self, number: int, frame: FrameType | None) -> None:
        """Raise, and set a flag, too: the exception is lost if it is raised within a callback."""
        again, self._interrupted = self._interrupted, True
        if number == signal.SIGINT or not again:  # a closing terminal sends several signals
            raise KeyboardInterrupt

    def _write(self, write: Callable[[], None]) -> None:
        try:
            write()
        except OSError as error:
            what = f"the tables cannot be written: {error.strerror or error}"
            right = "make room; the same command writes them"
            raise InputError(f"--out {self._out}", what, right) from None


def make_folder(folder: Path, option: str) -> None:
    """Make a folder if there is none, and check that it is writable.

    Raises:
        InputError: if it cannot be made or written to; names the option.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
        TemporaryFile(dir=folder).close()
    except (OSError, ValueError) as error:
        why = error.strerror if isinstance(error, OSError) else error
        what = f"cannot write to {folder}: {why}"
        raise InputError(option, what, "name a folder to write to") from None


def claim(out: Path, settings: Settings, commands: Sequence[str]) -> dict[str, str]:
    """Write the campaign's settings to `campaign.json`, or compare them with those in it.

    Returns:
        Facts for the report.

    Raises:
        InputError: if it cannot be written, or holds a campaign with other settings.
    """
    grid = settings.model_dump(mode="json", exclude=VARIED)
    mine = {"settings": grid, "commands": list(commands)}
    file = out / "campaign.json"
    try:
        if not file.exists():
            write_whole(file, f"{json.dumps(mine, indent=2)}\n".encode())
        theirs = json.loads(read_text(file))
    except OSError as error:
        raise InputError("--out", f"cannot use {out}: {error.strerror}") from None
    except (ValueError, RecursionError):
        right = "delete it if it is yours, or name another folder"
        raise InputError("--out", f"{file} is damaged", right) from None
    if theirs != mine:
        raise InputError(
            "--out", f"{out} holds a campaign with other settings", "name another folder"
        )
    return {
        "commands": " ".join(commands),
        **{name: str(value) for name, value in grid.items() if value is not None},
        "elicitation": settings.elicitation,
        "versions": ", ".join(f"{p} {version(p)}" for p in ("robot-executive", *PACKAGES)),
        "machine": f"{platform.platform()}, {os.cpu_count()} CPU cores",
        "Python": platform.python_version(),
    }
