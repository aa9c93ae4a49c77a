"""A grid of missions: which there are, which have ended, and the folder that keeps them."""

import argparse
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
from types import FrameType
from typing import TextIO

from executive.app.recording import PACKAGES
from executive.campaign import blocks, draws
from executive.campaign.claim import lock_folder
from executive.campaign.journal import CRASHED, Entry, Journal, in_order, write_tables
from executive.campaign.report import paper
from executive.campaign.report.report import not_counted, write_report
from executive.campaign.runners import InProcess, ProcessPool, Runner
from executive.config import KnowledgeSystem, Settings, load_settings
from executive.errors import InputError
from executive.files import read_text, write_whole
from executive.shell import DONE, NOT_DONE, STOPPED, on_stop_signals
from executive.terminal import show_over
from executive.text import printable

OF_A_MISSION = {"knowledge", "defaults", "seed", "runs", "home", "llm"}
"""Settings that the campaign itself varies."""
SEEDS = 10
SHOWN_EVERY_S = 0.5
LONGEST_COMMAND = 1000
MOST_MISSIONS = 1_000_000
"""Of one campaign."""


class Campaign:
    """A grid of missions, and the folder that keeps what came of them."""

    def __init__(self, options: argparse.Namespace) -> None:
        """Read the options, and make the folder and have it to oneself.

        Raises:
            InputError: if an option or a file is wrong, or the folder holds another campaign, or
                another process runs one in it.
        """
        self._out: Path = options.out or Path("campaigns") / options.setting
        self._policies = tuple(dict.fromkeys(options.policy or ["ours"]))
        settings = all_settings(options)
        commands: tuple[str, ...] = paper.COMMANDS
        if options.draw:
            commands = draws.commands()
        elif options.commands:
            commands = read_commands(options.commands)
        seeds = options.seeds or SEEDS
        most = seeds * len(commands) * len(settings) * len(self._policies)
        if most > MOST_MISSIONS:
            raise InputError("--seeds", f"more than {MOST_MISSIONS:,} missions", "give fewer")
        self._blocks = blocks.grid(
            settings,
            self._policies,
            [KnowledgeSystem(name) for name in options.systems],
            commands,
            seeds,
            options.runs.resolve() if options.runs else None,
            draws=options.draw,
        )
        self._keys = {key for block in self._blocks for key in block.keys}
        self._as_in_paper = as_in_paper(settings, commands)
        self._interrupted = False
        self._runner = self._runner_for(options)
        make_folder(self._out)
        with ExitStack() as until_it_fails:
            self._lock = until_it_fails.enter_context(lock_folder(self._out, "--out"))
            self._about = claim(self._out, settings[0], commands)
            self._journal = Journal(self._out / "journal.jsonl")
            self._journal.mend()
            self._damage = self._journal.damage()
            until_it_fails.pop_all()
        for sentence in self._damage:
            print(f"warning: {printable(sentence)}; it is not counted", file=sys.stderr)

    def run(self) -> int:
        """Run what has not ended yet; the tables are written however it ends.

        Raises:
            ExecutiveError: if missions cannot be run, or journal or tables cannot be written.
        """
        progress = Progress(len(self._keys), lambda: len(self._entries()))
        try:
            with on_stop_signals(self._interrupt):
                self._runner.run(self._blocks, self._journal, progress)
            progress.show()
        except KeyboardInterrupt:
            print("\nstopped; the same command goes on from here", file=sys.stderr)
            return STOPPED
        finally:
            with self._lock:
                self._write()
        folder = printable(self._out)
        print(f"\n{folder}/report.md\n{folder}/report.html", file=sys.stderr)
        without_model = [e.row for e in self._entries() if e.row.model_failure]
        if without_model:
            print(printable(not_counted(without_model)), file=sys.stderr)
        return NOT_DONE if without_model else DONE

    def _runner_for(self, options: argparse.Namespace) -> Runner:
        if options.cluster:
            return cluster(options.cluster)
        return (
            InProcess()
            if options.workers == 1
            else ProcessPool(options.workers, lambda: self._interrupted)
        )

    def _interrupt(self, number: int, frame: FrameType | None) -> None:
        """Note it, too: the exception is lost if it is raised within a callback."""
        again, self._interrupted = self._interrupted, True
        if number == signal.SIGINT or not again:  # a terminal that ends says so several times
            raise KeyboardInterrupt

    def _entries(self) -> list[Entry]:
        """Missions of this campaign that have ended; the folder may hold those of others."""
        return [entry for entry in self._journal.entries() if entry.row.key in self._keys]

    def _write(self) -> None:
        """The tables and the report of what is in the journal.

        Raises:
            InputError: if they cannot be written.
        """
        try:
            self._write_tables()
        except OSError as error:
            raise InputError(
                f"--out {self._out}",
                f"the tables cannot be written: {error.strerror or error}",
                "make room; the same command writes them",
            ) from None

    def _write_tables(self) -> None:
        rows = in_order((entry.row for entry in self._entries()), self._policies)
        models = sorted({row.model for row in rows if row.model})
        results = [row for row in rows if not row.model_failure]
        wall_s = sum(row.wall_time_s for row in rows)
        about = {
            **self._about,
            "policies": ", ".join(self._policies),
            "homes": ", ".join(dict.fromkeys(row.home for row in rows)),
            "models": ", ".join(models) or "none",
            "seeds": ", ".join(str(seed) for seed in sorted({row.seed for row in rows})),
            "missions": f"{len(results)} of {len(self._keys)}",
            "crashed": str(sum(row.status == CRASHED for row in rows)),
            "without a working model": str(len(rows) - len(results)),
            "damaged lines of the journal": str(len(self._damage)),
            "sum of the missions' wall time": f"{wall_s:.0f} s",
        }
        write_tables(results, self._out)
        write_report(rows, about, self._out, self._as_in_paper)


class Progress:
    """One line on standard error: missions done, and the time left at the pace so far."""

    def __init__(self, total: int, count: Callable[[], int], out: TextIO | None = None) -> None:
        """`count` tells how many have ended; those of a resumed campaign are no pace."""
        self._total, self._count = total, count
        self._before = count()
        self._began = self._shown = time.monotonic()
        self._out = out or sys.stderr

    def __call__(self) -> None:
        """Show it, at most every half second."""
        if time.monotonic() - self._shown > SHOWN_EVERY_S:
            self.show()

    def show(self) -> None:
        """Show it now."""
        self._shown, done = time.monotonic(), self._count()
        if now := done - self._before:
            left_s = (self._shown - self._began) / now * (self._total - done)
            line = f"{done} of {self._total} missions, {clock(left_s)} left"
            show_over(line, self._out)


def clock(seconds: float) -> str:
    """As hours, minutes and seconds, h:mm:ss."""
    minutes, s = divmod(round(seconds), 60)
    return f"{minutes // 60}:{minutes % 60:02}:{s:02}"


# --- the folder and the command line ---


def all_settings(options: argparse.Namespace) -> tuple[Settings, ...]:
    """One for each home and each language model, as the options and the file of settings say.

    Raises:
        InputError: if a setting is wrong, or tables would call two homes or models the same.
    """
    found = tuple(
        load_settings(
            options.config,
            world="fake" if options.setting == "ideal" else "physics",
            user="oracle",
            home=home and at_any_folder(home),
            llm=llm and at_any_folder(llm),
            habits=options.habits,
            question_s=options.question_s,
            elicit=options.elicit,
            top=options.top,
        )
        for home in dict.fromkeys(options.home or [None])
        for llm in dict.fromkeys(options.llm or [None])
    )
    for option, names in (
        ("--home", {settings.home for settings in found}),
        ("--llm", {settings.llm for settings in found}),
    ):
        if len(names) > len({blocks.label_of(name) for name in names}):
            raise InputError(option, f"two of {', '.join(sorted(names))} are called the same")
    return found


def at_any_folder(name_or_file: str) -> str:
    """A file as other processes find it, too; the name of anything else as it is."""
    is_file = blocks.label_of(name_or_file) != name_or_file
    return str(Path(name_or_file).resolve()) if is_file else name_or_file


def cluster(address: str) -> Runner:
    """The workers of a Dask cluster.

    Raises:
        InputError: if Dask is not installed.
    """
    try:
        from executive.campaign.cluster import Cluster
    except ImportError:
        raise InputError(
            "--cluster", "Dask is not installed", "pip install 'robot-executive[campaign]'"
        ) from None
    return Cluster(address)


def as_in_paper(settings: Sequence[Settings], commands: Sequence[str]) -> tuple[str, ...]:
    """The homes in which the paper's figures may stand beside ours: its own, if its commands."""
    if tuple(commands) != paper.COMMANDS:
        return ()
    return tuple({s.home for s in settings if not (s.place or s.fault)} & {paper.HOME})


def make_folder(out: Path) -> None:
    """Make the campaign's folder if there is none.

    Raises:
        InputError: if it cannot be made.
    """
    try:
        out.mkdir(parents=True, exist_ok=True)
    except (OSError, ValueError) as error:
        why = error.strerror if isinstance(error, OSError) else error
        raise InputError("--out", f"cannot make {out}: {why}") from None


def claim(out: Path, settings: Settings, commands: Sequence[str]) -> dict[str, str]:
    """Note in the folder's `campaign.json` what it is for; return what a report says of it.

    Raises:
        InputError: if it cannot be written, or holds a campaign with other settings.
    """
    grid = settings.model_dump(mode="json", exclude=OF_A_MISSION)
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


def read_commands(file: Path) -> tuple[str, ...]:
    """One command a line; empty lines and those that begin with # are left out.

    Raises:
        InputError: if the file cannot be read, has no command, or has one twice.
    """
    text = read_text(file, f"--commands {file}", "give a text file with one command a line")
    lines = [line.strip() for line in text.splitlines()]
    commands = tuple(line for line in lines if line and not line.startswith("#"))
    if not commands or len(set(commands)) < len(commands):
        raise InputError(f"--commands {file}", "should have one command a line, none twice")
    for command in commands:
        if len(command) > LONGEST_COMMAND or printable(command) != command:
            what = f"this is no command: {command[:60]}"
            right = f"up to {LONGEST_COMMAND} characters, all of them visible"
            raise InputError(f"--commands {file}", what, right)
    return commands
