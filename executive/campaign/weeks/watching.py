"""A campaign of weeks: simulated households, and the folder that keeps their results."""

import argparse
from pathlib import Path

from executive.campaign.campaign import all_settings
from executive.campaign.folder import Folder, Progress
from executive.campaign.runners import on_this_machine
from executive.campaign.trial import try_policies
from executive.campaign.weeks.household import Household
from executive.campaign.weeks.lived import COMMANDS_A_DAY, DAYS_A_WEEK, Diary, Line, write_table
from executive.campaign.weeks.report import write_report
from executive.errors import InputError
from executive.shell import DONE, STOPPED
from sim.home.habits import load_habits
from sim.home.home_file import load_home

POLICIES = ("plan", "paper", "nearest", "memory")
"""The policies that are compared by default."""
HABITS = "household"
SEEDS = 3
MOST_WEEKS = 520
ASKED = f"{COMMANDS_A_DAY} a day, drawn by the seed"


class Weeks:
    """Households by policy, home, model and seed, and the folder that keeps their results."""

    def __init__(self, options: argparse.Namespace) -> None:
        """Read the options, make the folder and lock it.

        Raises:
            InputError: if an option or a file is wrong, or the folder holds another campaign, or
                another process runs one in it.
        """
        refuse_what_does_not_fit(options)
        self._out: Path = options.out or Path("campaigns") / "weeks"
        self._policies = tuple(dict.fromkeys(options.policy or POLICIES))
        found = all_settings(options)
        settings = [s.model_copy(update={"habits": s.habits or HABITS}) for s in found]
        for one in settings:
            load_habits(one.habits or HABITS, load_home(one.home))
        self._households = [
            Household(one.model_copy(update={"seed": seed}), policy, options.weeks * DAYS_A_WEEK)
            for one in settings
            for policy in self._policies
            for seed in range(options.seeds or SEEDS)
        ]
        try_policies({one.policy: one.settings_used for one in self._households})
        self._names = {household.name: None for household in self._households}
        self._days = options.weeks * DAYS_A_WEEK
        self._workers: int = options.workers
        self._diary = Diary(self._out / "journal.jsonl")
        self._folder = Folder(self._out, settings[0], (ASKED,), self._diary)

    def run(self) -> int:
        """Run the remaining commands; return the exit status.

        The report is written however the run ends.

        Raises:
            ExecutiveError: if missions cannot be run, or journal or report cannot be written.
        """
        total = len(self._households) * self._days * COMMANDS_A_DAY
        progress = Progress(total, lambda: len(self._lines()))
        runner = on_this_machine(self._workers, self._folder.is_interrupted)
        came_to_the_end = self._folder.run(
            runner, self._households, progress, lambda: self._write(total)
        )
        return DONE if came_to_the_end else STOPPED

    def _lines(self) -> list[Line]:
        """The journal's lines of this campaign; the folder may have others, too."""
        return [
            line
            for line in self._diary.entries()
            if line.lived.household in self._names and line.lived.day < self._days
        ]

    def _write(self, total: int) -> None:
        rank = {name: number for number, name in enumerate(self._names)}
        rows = [line.lived for line in self._lines()]
        rows.sort(key=lambda one: (rank[one.household], one.day, one.turn))
        about = {
            **self._folder.about,
            "policies": ", ".join(self._policies),
            "homes": ", ".join(dict.fromkeys(one.home for one in rows)),
            "seeds": ", ".join(str(seed) for seed in sorted({one.seed for one in rows})),
            "commands given": f"{len(rows)} of {total}",
            "sum of the missions' wall time": f"{sum(one.wall_time_s for one in rows):.0f} s",
        }
        write_table(rows, self._out / "results.parquet")
        write_report(rows, about, self._out)


def refuse_what_does_not_fit(options: argparse.Namespace) -> None:
    """Refuse options that only apply to a grid of missions, and too many weeks.

    Raises:
        InputError: names the option.
    """
    if options.weeks > MOST_WEEKS:
        raise InputError("--weeks", f"more than {MOST_WEEKS} weeks", "give fewer")
    for option, given in (
        ("--commands", options.commands),
        ("--draw", options.draw),
        ("--runs", options.runs),
        ("--cluster", options.cluster),
    ):
        if given:
            raise InputError(
                option, "a household of weeks has none", f"leave {option} or --weeks out"
            )
