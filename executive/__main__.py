"""The main program: `python -m executive "Bring a sugar_box"`."""

from executive.start import begin

if __name__ == "__main__":
    begin()

import argparse
import logging
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from importlib.metadata import version
from io import StringIO
from pathlib import Path
from typing import TYPE_CHECKING

from executive.config import Settings, load_settings
from executive.errors import ExecutiveError, InputError
from executive.needs import warn_of_vain
from executive.options import add_settings
from executive.page.address import Address, add_page, address_of
from executive.shell import (
    BAD_INPUT,
    DONE,
    NOT_DONE,
    STOPPED,
    all_is_kept,
    end_at_once,
    entry_point,
    handle_stop_signals,
    leave,
    leave_within,
    on_stop_signals,
    stops_in_order,
)
from executive.terminal import Terminal
from executive.text import counted, printable, too_long
from executive.usage import Parser

if TYPE_CHECKING:  # what takes long to import is not for --help or a wrong option
    from executive.app.session import Session
    from executive.events import Inbox
    from executive.page.page import Page
    from executive.types.outcome import Outcome
    from executive.user import Console

EXIT = {"done": DONE, "not_done": NOT_DONE, "not_understood": BAD_INPUT, "stopped": STOPPED}
"""Exit statuses by the mission's status."""

log = logging.getLogger(__name__)


PROMPT = "What can I do for you?"
CLOSED_S = 1.0
"""How long (s) freeing the model and the simulator may take before the program ends anyway."""


@entry_point
def main(arguments: Sequence[str] | None = None) -> int:
    """Run one mission, or one for each line that the person types; return the exit status."""
    options = vars(parsed(arguments))
    said = options.pop("words")
    words = " ".join(said) if said else None
    as_json, verbose = options.pop("json"), options.pop("verbose")
    given = {name for name, value in options.items() if value is not None and value is not False}
    view, gui = options.pop("view"), options.pop("gui")
    address = address_of(options)
    with on_stop_signals(end_at_once):
        log_to_stderr(verbose)
        let_no_reader_hold_the_robot()
        try:
            settings = load_settings(**options)
            warn_of_vain(settings, given)
            if address and settings.user != "console":
                right = "use --user console, or leave --page out"
                raise InputError("--page", "it is the person, and the settings name another", right)
            if words is None and settings.user != "console":
                raise InputError("command", "no words", 'say for example "Bring a sugar_box"')
            if why := too_long(words or ""):
                raise InputError("command", why, "say it in fewer words")
            from executive.events import Inbox

            inbox = Inbox()
            with opened_page(address, inbox) as page:
                return serve(settings, words, inbox, page, view=view, gui=gui, as_json=as_json)
        except ExecutiveError:
            raise
        except Exception as error:
            log.debug("internal error", exc_info=error)
            what = printable(f"{type(error).__name__}: {error}")
            print(f"internal error: {what} (-vv says where)", file=sys.stderr)
            return NOT_DONE


@contextmanager
def opened_page(address: Address | None, inbox: "Inbox") -> "Iterator[Page | None]":
    """Serve the person's page inside the block, and print its address."""
    if address is None:
        yield None
        return
    from executive.page.page import Page  # heavy

    with Page(inbox, address) as page:
        print(f"Open {page.url}", file=sys.stderr, flush=True)
        if page.experimenter_url:
            print(f"Experimenter: {page.experimenter_url}", file=sys.stderr, flush=True)
        yield page


def serve(
    settings: Settings,
    words: str | None,
    inbox: "Inbox",
    page: "Page | None" = None,
    *,
    view: bool,
    gui: bool,
    as_json: bool,
) -> int:
    """Build the parts, run the missions, free the parts; return the exit status."""
    console = person_of(settings, inbox, page)  # from now on, a stop is heard
    with all_is_kept():
        from executive.app.session import Session

        session = Session(
            settings,
            inbox=inbox,
            user=console,
            view=view,
            gui=gui,
            sinks=page.sinks if page else (),
        )
        with suppress(ImportError):  # it is reported when the logs are opened
            import logs.viewer.sink  # noqa: F401 - what is imported now is looked through no more
    with session:
        if page:
            page.follow(session)
        stop_on_signals(inbox)
        try:
            if console and (words is None or page):
                code = converse(session, console, as_json, words)
            else:
                code = do_all(session, words or "", as_json)
            leave_within(CLOSED_S, code)
            return code
        except KeyboardInterrupt:
            leave_within(CLOSED_S, STOPPED)
            raise


def person_of(settings: Settings, inbox: "Inbox", page: "Page | None") -> "Console | None":
    """The person at the page or the terminal; None if the settings name a stand-in."""
    from executive.user import Console

    if settings.user != "console":
        return None
    return page.person if page else Console(inbox, None if settings.is_typed else StringIO())


def do_all(session: "Session", words: str, as_json: bool) -> int:
    """Handle a command, then those heard too late for its mission; return the last exit status."""
    code = do(session, words, as_json)
    while session.heard:
        code = do(session, session.heard.popleft(), as_json)
    return code


def do(session: "Session", words: str, as_json: bool) -> int:
    """Answer the words, or run a mission for them; return the exit status."""
    if not as_json and session.talk(words):
        return DONE
    outcome = session.run(words)
    return conclude(outcome, session.is_recorded, as_json)


def conclude(outcome: "Outcome", is_recorded: bool, as_json: bool) -> int:
    """Print the outcome, and whether all of it is recorded; return the exit status."""
    if as_json:
        from executive.app.run_folder import to_json

        print(to_json(outcome), flush=True)
    else:
        visited = ", ".join(outcome.visited) or "nothing"
        print(
            f"{outcome.status}: {printable(outcome.reason)}\n"
            f"  {outcome.mission_time_s:.1f} s of mission, {outcome.wall_time_s:.1f} s of yours; "
            f"visited {printable(visited)}; "
            f"{counted(outcome.inquiries, 'question')} asked, "
            f"{counted(outcome.llm_calls, 'call')} of the model",
            flush=True,
        )
        if outcome.run_dir:
            lacks = "" if is_recorded else ", but not all of it: see the warnings"
            print(f"  recorded in {printable(outcome.run_dir)}{lacks}", flush=True)
    if isinstance(sys.stdout, Terminal) and sys.stdout.lost:
        print(f"warning: standard output is lost: {sys.stdout.lost}", file=sys.stderr)
    return EXIT[outcome.status]


def converse(session: "Session", console: "Console", as_json: bool, line: str | None = None) -> int:
    """Handle what the person types, until they end the session; return the last exit status.

    A stop signal ends the session, not only the mission. If a `line` is given, it is handled
    first.
    """
    code = DONE
    if line is None:
        help_ = f"{PROMPT} (stop ends what I do, quit ends the session)"
        line = session.next_command(console, help_)
    while line is not None:
        code = do(session, line, as_json)
        if session.stopped_by:
            return STOPPED
        line = session.next_command(console, PROMPT)
    return code


def stop_on_signals(inbox: "Inbox") -> None:
    """Let a stop signal stop the robot, with a reply at once; a second Ctrl-C ends the program."""
    from executive.events import StopRequested
    from executive.user import STOPPING

    handle_stop_signals(stops_in_order(lambda by: inbox.post(StopRequested(by)), STOPPING))


def let_no_reader_hold_the_robot() -> None:
    """Let missions go on if nobody reads the output: a lost or blocked stream is tolerated."""
    if isinstance(sys.stdout, Terminal) and isinstance(sys.stderr, Terminal):
        sys.stdout.dispensable = True
        sys.stderr.hurried = True


class _OneLine(logging.Formatter):
    """Keeps each message on one line, so that quoted text cannot forge another message."""

    def formatMessage(self, record: logging.LogRecord) -> str:  # logging's name
        return printable(super().formatMessage(record))


def log_to_stderr(verbose: int) -> None:
    """Log to standard error: warnings, or more with -v and -vv."""
    handler = logging.StreamHandler()
    handler.setFormatter(_OneLine("%(levelname)s %(name)s: %(message)s"))
    level = [logging.WARNING, logging.INFO, logging.DEBUG][min(verbose, 2)]
    logging.basicConfig(level=level, handlers=[handler])


def parsed(arguments: Sequence[str] | None) -> argparse.Namespace:
    """Parse options and words; words may also follow an option: `Bring --seed 3 a mug`.

    `parse_intermixed_args` does not handle `--` in Python 3.11.
    """
    p = parser()
    options, rest = p.parse_known_args(arguments)
    if any(word.startswith("-") for word in rest):
        p.error(f"unrecognized arguments: {' '.join(rest)}")
    options.words += rest
    return options


def parser() -> argparse.ArgumentParser:
    """The command-line parser; settings that are not given come from a file or their defaults."""
    p = Parser(
        prog="python -m executive",
        description="Ask a home robot to find, take or bring a thing.",
        epilog="exit: 0 done, 1 not done, 2 bad usage or input, 130 stopped",
    )

    p.add_argument("words", nargs="*", help='a command such as "Bring a sugar_box"; none: ask')
    add_settings(p)
    p.add_argument("--config", type=Path, metavar="FILE", help="settings in TOML")
    p.add_argument("--gui", action="store_true", help="show PyBullet's own window")
    add_page(p)
    p.add_argument("--view", action="store_true", help="show the recording live in rerun's viewer")
    p.add_argument("--json", action="store_true", help="print the outcome as JSON")
    p.add_argument("-v", "--verbose", action="count", default=0, help="say more (-vv: all)")
    p.add_argument("--version", action="version", version=version("robot-executive"))
    return p


if __name__ == "__main__":
    leave(main())
