"""Many missions: `python -m executive.campaign` runs the paper's experiment and tabulates it."""

import argparse
import json
import multiprocessing
import os
import platform
import signal
import sys
import time
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from importlib.metadata import version
from multiprocessing.synchronize import Event
from pathlib import Path
from types import FrameType
from typing import TextIO

from executive import households, paper
from executive.app import PACKAGES
from executive.config import KnowledgeSystem, Settings, load_settings
from executive.errors import ExecutiveError, InputError
from executive.experiment import report
from executive.households import Household
from executive.journal import CRASHED, Entry, Journal, in_order, write_tables

POLL_S = 0.5
"""How often the journal is looked at while workers write it."""
OF_A_MISSION = {"knowledge", "defaults", "seed", "runs"}
"""Settings that the campaign itself varies."""
BAD_INPUT, STOPPED = 2, 130


def main(arguments: Sequence[str] | None = None) -> int:
    """Run what is left of a campaign, write its tables, return the exit code."""
    try:
        return Campaign(parser().parse_args(arguments)).run()
    except ExecutiveError as error:
        print(f"error: {error}", file=sys.stderr)
        return BAD_INPUT


class Campaign:
    """A grid of missions, and the folder that keeps what came of them."""

    def __init__(self, options: argparse.Namespace) -> None:
        """Read the options and make the folder.

        Raises:
            InputError: if an option or a file is wrong, or the folder holds another campaign.
        """
        self._workers: int = options.workers
        self._out: Path = options.out or Path("campaigns") / options.setting
        settings = load_settings(
            options.config,
            world="fake" if options.setting == "ideal" else "physics",
            user="oracle",
            home=options.home,
            llm=options.llm,
            elicit=options.elicit,
            top=options.top,
        )
        commands = read_commands(options.commands) if options.commands else paper.COMMANDS
        self._households = households.for_conditions(
            settings,
            [KnowledgeSystem(name) for name in options.systems],
            commands,
            options.seeds,
            options.runs.resolve() if options.runs else None,
        )
        self._keys = {key for household in self._households for key in household.keys}
        self._about = claim(self._out, settings, commands)
        self._journal = Journal(self._out / "journal.jsonl")
        self._journal.mend()
        self._interrupted = False

    def run(self) -> int:
        """Run what has not ended yet; the tables are written however it ends."""
        progress = Progress(len(self._keys), len(self._entries()))
        before = signal.signal(signal.SIGINT, self._interrupt)
        try:
            if self._workers == 1:
                self._run_here(progress)
            else:
                self._run_in_pool(progress)
        except KeyboardInterrupt:
            print("\nstopped; the same command goes on from here", file=sys.stderr)
            return STOPPED
        finally:
            signal.signal(signal.SIGINT, before)
            self._write()
        print(f"\n{self._out / 'report.md'}", file=sys.stderr)
        return 0

    def _interrupt(self, number: int, frame: FrameType | None) -> None:
        """Note Ctrl-C, too: the exception is lost if it is raised within a callback."""
        self._interrupted = True
        raise KeyboardInterrupt

    def _run_here(self, progress: "Progress") -> None:
        before = self._entries()
        for household in self._households:
            for entry in households.run(household, before):
                self._journal.append(entry)
                progress.one_more()

    def _run_in_pool(self, progress: "Progress") -> None:
        """Give households to worker processes; if one is killed, go on with what is left.

        Raises:
            ExecutiveError: if workers die without any mission ending in between.
        """
        while True:
            ended = len(self._entries())
            try:
                return self._run_pool(progress)
            except BrokenProcessPool:
                if self._interrupted:  # it reached a worker that was still starting
                    raise KeyboardInterrupt from None
                if len(self._entries()) == ended:
                    raise ExecutiveError(
                        "a worker process died, and the next one, too, before any mission ended; "
                        "try --workers 1, which shows why"
                    ) from None

    def _run_pool(self, progress: "Progress") -> None:
        before = self._entries()
        context = multiprocessing.get_context("spawn")
        stop = context.Event()
        pool = ProcessPoolExecutor(
            self._workers, mp_context=context, initializer=start_worker, initargs=(stop,)
        )
        try:
            left = {
                pool.submit(work, household, of(household, before), self._journal)
                for household in self._households
            }
            while left:
                if self._interrupted:
                    raise KeyboardInterrupt
                done, left = wait(left, timeout=POLL_S)
                for future in done:
                    future.result()
                progress.so_many(len(self._entries()))
        except BaseException:
            stop.set()
            print("\nends when the missions under way have ended", file=sys.stderr)
            raise
        finally:
            pool.shutdown(cancel_futures=True)

    def _entries(self) -> list[Entry]:
        """Missions of this campaign that have ended; the folder may hold those of more seeds."""
        return [entry for entry in self._journal.entries() if entry.row.key in self._keys]

    def _write(self) -> None:
        rows = in_order(entry.row for entry in self._entries())
        models = sorted({row.model for row in rows if row.model})
        wall_s = sum(row.wall_time_s for row in rows)
        about = {
            **self._about,
            "model": ", ".join(models) or "none",
            "seeds": ", ".join(str(seed) for seed in sorted({row.seed for row in rows})),
            "missions": f"{len(rows)} of {len(self._keys)}",
            "crashed": str(sum(row.status == CRASHED for row in rows)),
            "sum of the missions' wall time": f"{wall_s:.0f} s",
        }
        write_tables(rows, self._out)
        (self._out / "report.md").write_text(report(rows, about), encoding="utf-8")


class Progress:
    """One line on standard error: missions done, and the time left at the pace so far."""

    def __init__(self, total: int, before: int, out: TextIO | None = None) -> None:
        """Begin with so many missions of a resumed campaign."""
        self._total, self._before, self._done = total, before, before
        self._began = time.monotonic()
        self._out = out or sys.stderr

    def one_more(self) -> None:
        """A mission has ended."""
        self.so_many(self._done + 1)

    def so_many(self, done: int) -> None:
        """So many have ended in all."""
        self._done = done
        if now := done - self._before:
            left_s = (time.monotonic() - self._began) / now * (self._total - done)
            line = f"{done} of {self._total} missions, {clock(left_s)} left"
            print(f"\r{line:<60}", end="", file=self._out, flush=True)


def clock(seconds: float) -> str:
    """As hours, minutes and seconds, h:mm:ss."""
    minutes, s = divmod(round(seconds), 60)
    return f"{minutes // 60}:{minutes % 60:02}:{s:02}"


def of(household: Household, entries: Sequence[Entry]) -> list[Entry]:
    """The household's missions among these."""
    keys = set(household.keys)
    return [entry for entry in entries if entry.row.key in keys]


# --- in a worker process ---

_stop: Event | None = None


def start_worker(stop: Event) -> None:
    """Leave Ctrl-C to the parent, which sets `stop`."""
    global _stop
    _stop = stop
    signal.signal(signal.SIGINT, signal.SIG_IGN)


def work(household: Household, before: Sequence[Entry], journal: Journal) -> None:
    """Run a household until it ends or all shall stop."""
    if _stop and _stop.is_set():
        return
    for entry in households.run(household, before):
        journal.append(entry)
        if _stop and _stop.is_set():
            return


# --- the folder and the command line ---


def claim(out: Path, settings: Settings, commands: Sequence[str]) -> dict[str, str]:
    """Make the folder and note in `campaign.json` what it is for; return what a report says of it.

    Raises:
        InputError: if it cannot be made, or holds a campaign with other settings.
    """
    grid = settings.model_dump(mode="json", exclude=OF_A_MISSION)
    mine = {"settings": grid, "commands": list(commands)}
    file = out / "campaign.json"
    try:
        out.mkdir(parents=True, exist_ok=True)
        if not file.exists():
            file.write_text(json.dumps(mine, indent=2) + "\n", encoding="utf-8")
        theirs = json.loads(file.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise InputError("--out", f"cannot use {out}: {error}") from None
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
    try:
        lines = [line.strip() for line in file.read_text(encoding="utf-8").splitlines()]
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(f"--commands {file}", f"cannot be read: {error}") from None
    commands = tuple(line for line in lines if line and not line.startswith("#"))
    if not commands or len(set(commands)) < len(commands):
        raise InputError(f"--commands {file}", "should have one command a line, none twice")
    return commands


def parser() -> argparse.ArgumentParser:
    """The command line."""
    p = argparse.ArgumentParser(
        prog="python -m executive.campaign",
        description="Run the paper's experiment with a simulated person, and tabulate it. "
        "Stopped with Ctrl-C, the same command goes on.",
        epilog="exit: 0 all missions have ended, 2 bad usage or input, 130 stopped",
    )
    setting = p.add_mutually_exclusive_group()
    setting.add_argument(
        "--ideal",
        dest="setting",
        action="store_const",
        const="ideal",
        help="instant world, recognition and action always succeed (default)",
    )
    setting.add_argument(
        "--physics", dest="setting", action="store_const", const="physics", help="PyBullet"
    )
    p.set_defaults(setting="ideal")
    p.add_argument("--seeds", type=_count, default=10, metavar="N", help="0 to N-1 (default: 10)")
    p.add_argument(
        "--systems",
        nargs="+",
        choices=[str(s) for s in KnowledgeSystem],
        default=[str(s) for s in KnowledgeSystem],
        help="which of the paper's systems (default: all)",
    )
    p.add_argument(
        "--commands", type=Path, metavar="FILE", help="one a line (default: the paper's)"
    )
    p.add_argument("--out", type=Path, metavar="DIR", help="default: campaigns/ideal or /physics")
    p.add_argument("--runs", type=Path, metavar="DIR", help="record each mission there")
    p.add_argument("--workers", type=_count, default=1, metavar="N", help="processes (default: 1)")
    p.add_argument("--home", metavar="NAME or FILE.toml")
    p.add_argument("--llm", metavar="embedded, FILE.gguf, http://host:port/v1 or none")
    p.add_argument("--elicit", choices=["generate", "rank"])
    p.add_argument("--top", type=_count, metavar="N", help="places of a ranking worth a visit")
    p.add_argument("--config", type=Path, metavar="FILE", help="settings in TOML")
    return p


def _count(text: str) -> int:
    number = int(text)
    if number < 1:
        raise argparse.ArgumentTypeError("should be 1 or more")
    return number


if __name__ == "__main__":
    sys.exit(main())
