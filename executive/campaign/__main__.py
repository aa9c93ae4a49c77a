"""Many missions: `python -m executive.campaign` runs the paper's experiment and tabulates it."""

from executive.start import begin

if __name__ == "__main__":
    begin()

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from executive.campaign.names import DESCRIPTIONS
from executive.campaign.workers import start_loading
from executive.config import KnowledgeSystem
from executive.errors import InputError
from executive.options import add_setting
from executive.shell import all_is_kept, entry_point
from executive.usage import Parser


@entry_point
def main(arguments: Sequence[str] | None = None) -> int:
    """Run the missing missions of a campaign, write its tables, return the exit status."""
    options = parser().parse_args(arguments)
    if options.workers > 1:
        start_loading()  # while this process does its own imports
    # slow to import: not for --help or a wrong option
    if options.weeks:
        with all_is_kept():
            from executive.campaign.weeks.watching import Weeks

        return Weeks(options).run()
    if options.habits:
        raise InputError("--habits", "nobody lives in a grid of missions", "add --weeks 8")
    with all_is_kept():
        from executive.campaign.campaign import Campaign

    return Campaign(options).run()


def parser() -> argparse.ArgumentParser:
    """The command line."""
    p = Parser(
        prog="python -m executive.campaign",
        description="Run the paper's experiment with a simulated person, and tabulate it. "
        "Stopped with Ctrl-C, the same command goes on.",
        formatter_class=argparse.RawDescriptionHelpFormatter,
        epilog="policies:\n"
        + "".join(f"  {name:<17} {says}\n" for name, says in DESCRIPTIONS.items())
        + "  package.module:function\n"
        + f"  {'':<17} one of your own: a function from parts to parts\n"
        + "\nexit: 0 all missions have ended, 1 some had no working model, 2 bad usage or input, "
        "130 stopped",
    )
    _add_missions(p)
    _add_folders_and_workers(p)
    _add_settings(p)
    return p


def _add_missions(p: argparse.ArgumentParser) -> None:
    """Options for the choice of missions."""
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
    p.add_argument(
        "--seeds", type=_count, metavar="N", help="0 to N-1 (default: 10; with --weeks 3)"
    )
    p.add_argument(
        "--systems",
        nargs="+",
        choices=[str(s) for s in KnowledgeSystem],
        default=[str(s) for s in KnowledgeSystem],
        help="which of the paper's systems (default: all)",
    )
    asked = p.add_mutually_exclusive_group()
    asked.add_argument(
        "--commands", type=Path, metavar="FILE", help="one a line (default: the paper's)"
    )
    asked.add_argument(
        "--draw",
        action="store_true",
        help="find every thing there is, each at a place that the seed draws from the survey",
    )
    asked.add_argument(
        "--weeks",
        type=_count,
        metavar="N",
        help="live with households of 10 commands a day whose things wander by habits",
    )


def _add_folders_and_workers(p: argparse.ArgumentParser) -> None:
    """Options for folders and worker processes."""
    p.add_argument(
        "--out", type=Path, metavar="DIR", help="default: campaigns/ideal, /physics or /weeks"
    )
    p.add_argument("--runs", type=Path, metavar="DIR", help="record each mission there")
    workers = p.add_mutually_exclusive_group()
    workers.add_argument(
        "--workers", type=_count, default=1, metavar="N", help="processes (default: 1)"
    )
    workers.add_argument(
        "--cluster", metavar="ADDRESS", help="of a Dask scheduler; its workers run the missions"
    )


def _add_settings(p: argparse.ArgumentParser) -> None:
    """Options for the settings of the missions."""
    p.add_argument(
        "--policy",
        action="append",
        type=_policy,
        metavar="NAME",
        help="who says where to look; may be repeated (default: ours; with --weeks plan, paper, "
        "nearest and memory)",
    )
    add_setting(p, "home", action="append", help="may be repeated")
    add_setting(p, "llm", action="append", help="may be repeated")
    add_setting(p, "habits", help="of the households of --weeks (default: household)")
    add_setting(p, "question_s")
    add_setting(p, "elicit", help="default: rank for the embedded model, else generate")
    add_setting(
        p, "top", type=_count, metavar="N", help="places of a ranking worth a visit (default: 5)"
    )
    p.add_argument("--config", type=Path, metavar="FILE", help="settings in TOML")


def _policy(name: str) -> str:
    if name not in DESCRIPTIONS and ":" not in name:
        ours = ", ".join(map(repr, DESCRIPTIONS))
        raise argparse.ArgumentTypeError(
            f"invalid choice: {name!r} (choose from {ours}, or package.module:function)"
        )
    return name


def _count(text: str) -> int:
    if not (text.isdecimal() and len(text) < 16 and int(text)):
        raise argparse.ArgumentTypeError("should be 1 or more")
    return int(text)


if __name__ == "__main__":
    sys.exit(main())
