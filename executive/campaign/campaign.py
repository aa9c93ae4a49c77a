"""A campaign: a grid of missions, and the folder that keeps their results."""

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from executive.campaign import blocks, draws
from executive.campaign.folder import Folder, Progress, make_folder
from executive.campaign.journal import CRASHED, Entry, Journal, in_order, write_tables
from executive.campaign.report import paper
from executive.campaign.report.report import not_counted, write_report
from executive.campaign.runners import Runner, on_this_machine
from executive.campaign.trial import try_policies
from executive.config import KnowledgeSystem, Settings, load_settings
from executive.errors import InputError
from executive.files import read_text
from executive.shell import DONE, NOT_DONE, STOPPED
from executive.text import printable

SEEDS = 10
LONGEST_COMMAND = 1000
MOST_MISSIONS = 1_000_000
"""The largest number of missions in a campaign."""


class Campaign:
    """A grid of missions, and the folder that keeps their results."""

    def __init__(self, options: argparse.Namespace) -> None:
        """Read the options, make the folder and lock it.

        Raises:
            InputError: if an option or a file is wrong, or a folder cannot be written to, or it
                holds another campaign, or another process runs one in it.
        """
        self._out: Path = options.out or Path("campaigns") / options.setting
        self._policies = tuple(dict.fromkeys(options.policy or ["ours"]))
        if len(self._policies) > 1 and set(options.systems) == {KnowledgeSystem.OKB}:
            once = "okb asks no model, and is run under the first policy alone"
            raise InputError("--policy", once, "add okb+llm to --systems")
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
        try_policies({block.policy: block.settings_used for block in self._blocks})
        self._keys = {key for block in self._blocks for key in block.keys}
        self._as_in_paper = as_in_paper(settings, commands)
        self._journal = Journal(self._out / "journal.jsonl")
        self._runner = self._runner_for(options)
        if options.runs:
            make_folder(options.runs, "--runs")
        self._folder = Folder(self._out, settings[0], commands, self._journal)

    def run(self) -> int:
        """Run the missions that have not ended; return the exit status.

        The tables are written however the run ends.

        Raises:
            ExecutiveError: if missions cannot be run, or journal or tables cannot be written.
        """
        progress = Progress(len(self._keys), lambda: len(self._entries()))
        if not self._folder.run(self._runner, self._blocks, progress, self._write):
            return STOPPED
        without_model = [e.row for e in self._entries() if e.row.model_failure]
        if without_model:
            print(printable(not_counted(without_model)), file=sys.stderr)
        return NOT_DONE if without_model else DONE

    def _runner_for(self, options: argparse.Namespace) -> Runner:
        if options.cluster:
            return cluster(options.cluster)
        return on_this_machine(options.workers, lambda: self._folder.is_interrupted())

    def _entries(self) -> list[Entry]:
        """The ended missions of this campaign; the journal may have others, too."""
        return [entry for entry in self._journal.entries() if entry.row.key in self._keys]

    def _write(self) -> None:
        """Write tables and report of the missions in the journal."""
        rows = in_order((entry.row for entry in self._entries()), self._policies)
        models = sorted({row.model for row in rows if row.model})
        results = [row for row in rows if not row.model_failure]
        wall_s = sum(row.wall_time_s for row in rows)
        about = {
            **self._folder.about,
            "policies": ", ".join(self._policies),
            "homes": ", ".join(dict.fromkeys(row.home for row in rows)),
            "models": ", ".join(models) or "none",
            "seeds": ", ".join(str(seed) for seed in sorted({row.seed for row in rows})),
            "missions": f"{len(results)} of {len(self._keys)}",
            "crashed": str(sum(row.status == CRASHED for row in rows)),
            "without a working model": str(len(rows) - len(results)),
            "damaged lines of the journal": str(len(self._folder.damage)),
            "sum of the missions' wall time": f"{wall_s:.0f} s",
        }
        write_tables(results, self._out)
        write_report(rows, about, self._out, self._as_in_paper)


# --- the command line ---


def all_settings(options: argparse.Namespace) -> tuple[Settings, ...]:
    """The settings for each home and each language model, by the options and `--config`.

    Raises:
        InputError: if a setting is wrong, or two homes or models have the same name in tables.
    """
    found = tuple(
        load_settings(
            options.config,
            world="fake" if options.setting == "ideal" else "physics",
            user="oracle",
            home=home and absolute_if_file(home),
            llm=llm and absolute_if_file(llm),
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


def absolute_if_file(name_or_file: str) -> str:
    """The absolute path of a file, so that other processes find it; other names unchanged."""
    is_file = blocks.label_of(name_or_file) != name_or_file
    return str(Path(name_or_file).resolve()) if is_file else name_or_file


def cluster(address: str) -> Runner:
    """A runner on the workers of a Dask cluster.

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
    """The homes whose figures are comparable with the paper's.

    That is only the paper's own, with its commands, and without changed places or faults.
    """
    if tuple(commands) != paper.COMMANDS:
        return ()
    return tuple({s.home for s in settings if not (s.place or s.fault)} & {paper.HOME})


def read_commands(file: Path) -> tuple[str, ...]:
    """Read commands, one per line; empty lines and those that begin with # are left out.

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
