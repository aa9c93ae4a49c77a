"""`python -m executive.page runs`: past runs, without a robot."""

import argparse
import sys
import threading
from pathlib import Path
from typing import Any

from executive.config import load_settings
from executive.page.address import PORT, add_page, address_of
from executive.page.experiment.alone import PastRuns
from executive.shell import STOPPED, on_stop_signals, stops_in_order

LOOK_S = 3600.0


def add_to(commands: Any) -> None:
    """Add the command to a parser's."""
    p = commands.add_parser(
        "runs",
        help="go through past runs, in the browser; no robot is needed",
        description="Go through past runs, in the browser, without a robot (docs/page.md).",
        epilog="It goes on until it is stopped. exit: 2 bad usage or input, 130 stopped",
    )
    p.add_argument(
        "folder",
        type=Path,
        nargs="?",
        metavar="DIR",
        help="where the runs are (default: as --runs of missions)",
    )
    add_page(p, experimenter=False)
    p.set_defaults(run=run, page=PORT)


def run(options: argparse.Namespace) -> int:
    """Serve until a signal says stop; the exit code."""
    given = vars(options)
    address = address_of({**given, "page_experimenter": True})
    assert address
    over = threading.Event()
    with (
        on_stop_signals(stops_in_order(lambda by: over.set(), "Stopping.")),
        PastRuns(options.folder or load_settings().runs, address) as page,
    ):
        print(f"Open {page.url}", file=sys.stderr, flush=True)
        while not over.wait(LOOK_S):
            pass
    return STOPPED
