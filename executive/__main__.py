"""The door: `python -m executive "Bring a sugar_box"`."""

import argparse
import logging
import signal
import sys
from collections.abc import Sequence
from importlib.metadata import version
from pathlib import Path
from types import FrameType
from typing import Any

from executive.config import KnowledgeSystem, Settings, load_settings
from executive.errors import ExecutiveError, InputError
from executive.events import Inbox, StopRequested
from executive.shell import BAD_INPUT, DONE, NOT_DONE, STOPPED, entry_point
from executive.text import writable
from executive.types import Outcome, Status

EXIT = {
    Status.DONE: DONE,
    Status.NOT_DONE: NOT_DONE,
    Status.NOT_UNDERSTOOD: BAD_INPUT,
    Status.STOPPED: STOPPED,
}

log = logging.getLogger(__name__)


@entry_point
def main(arguments: Sequence[str] | None = None) -> int:
    """Run a mission, or one for each line that the person types; return the exit code."""
    options = vars(parser().parse_args(arguments))
    words = options.pop("words")
    as_json, verbose = options.pop("json"), options.pop("verbose")
    view, gui = options.pop("view"), options.pop("gui")
    logging.basicConfig(
        level=[logging.WARNING, logging.INFO, logging.DEBUG][min(verbose, 2)],
        format="%(levelname)s %(name)s: %(message)s",
    )
    inbox = Inbox()
    stop_on_signals(inbox)
    try:
        settings = load_settings(**options)
        if words is None and settings.user != "console":
            raise InputError("command", "no words", 'say for example "Bring a sugar_box"')
        return serve(settings, words, inbox, view=view, gui=gui, as_json=as_json)
    except (ExecutiveError, BrokenPipeError):
        raise
    except Exception as error:
        log.debug("internal error", exc_info=error)
        print(f"internal error: {type(error).__name__}: {error} (-vv says where)", file=sys.stderr)
        return NOT_DONE


def serve(
    settings: Settings, words: str | None, inbox: Inbox, *, view: bool, gui: bool, as_json: bool
) -> int:
    """Build the parts, run what is asked, free the parts."""
    from executive.app import Session  # heavy: not for --help or a wrong option

    session = Session(settings, inbox=inbox, view=view, gui=gui)
    try:
        if words is not None:
            return conclude(session.run(writable(words)), as_json)
        code = DONE
        print("What can I do for you? (stop ends)", file=sys.stderr)
        while (line := session.next_command()) is not None:
            code = conclude(session.run(line), as_json)
            if code == STOPPED:
                break
        return code
    finally:
        session.close()


def conclude(outcome: Outcome, as_json: bool) -> int:
    """Print the outcome, and turn it into an exit code."""
    if as_json:
        from executive.runs import to_json

        print(to_json(outcome), flush=True)
    else:
        print(f"{outcome.status}: {outcome.reason}", flush=True)
        print(
            f"  {outcome.mission_time_s:.1f} s of mission, {outcome.wall_time_s:.1f} s of yours; "
            f"visited {', '.join(outcome.visited) or 'nothing'}; "
            f"asked you {outcome.inquiries}, the model {outcome.llm_calls} times\n"
            f"  recorded in {outcome.run_dir}",
            flush=True,
        )
    return EXIT[outcome.status]


def stop_on_signals(inbox: Inbox) -> None:
    """Ctrl-C and SIGTERM stop the robot; a second one ends the program at once."""
    asked = False

    def stop(number: int, frame: FrameType | None) -> None:
        nonlocal asked
        if asked:
            raise KeyboardInterrupt
        asked = True
        inbox.post(StopRequested("Ctrl-C" if number == signal.SIGINT else "SIGTERM"))

    signal.signal(signal.SIGINT, stop)
    signal.signal(signal.SIGTERM, stop)


def parser() -> argparse.ArgumentParser:
    """The command line; what is not given comes from the config file or its default."""
    p = argparse.ArgumentParser(
        prog="python -m executive",
        description="Ask a home robot to find, take or bring a thing.",
        epilog="exit: 0 done, 1 not done, 2 bad usage or input, 130 stopped",
    )

    def option(name: str, help: str | None = None, **kwargs: Any) -> None:
        field = Settings.model_fields[name.removeprefix("--").replace("-", "_")]
        default = "" if field.default in (None, ()) else f" (default: {field.default})"
        p.add_argument(name, help=f"{help or field.description}{default}", **kwargs)

    p.add_argument("words", nargs="?", help='a command such as "Bring a sugar_box"; none: ask')
    option("--home", metavar="NAME or FILE.toml")
    option("--knowledge", choices=[str(k) for k in KnowledgeSystem])
    p.add_argument(
        "--defaults",
        action=argparse.BooleanOptionalAction,
        help="whether the ontology knows default locations (default: it does)",
    )
    option("--llm", metavar="embedded, FILE.gguf, http://host:port/v1 or none")
    option("--llm-model", metavar="NAME")
    p.add_argument(
        "--elicit",
        choices=["generate", "rank"],
        help="ask for a list (paper) or score each known place "
        "(default: rank for the embedded model, else generate)",
    )
    p.add_argument(
        "--grammar",
        action=argparse.BooleanOptionalAction,
        help="hold the model's replies to their JSON schema (default: trust and verify)",
    )
    option("--prompts", type=Path, metavar="FILE")
    option("--kb", action="append", type=Path, metavar="FILE")
    option("--person", metavar="NAME")
    option("--user", choices=["console", "oracle", "none"])
    p.add_argument(
        "--place",
        action=_Placement,
        metavar="OBJECT=FURNITURE",
        help="where a thing truly is; repeatable (default: as in the home file)",
    )
    option("--world", choices=["physics", "fake"])
    option("--detector", metavar="learned, simulated or FILE.onnx")
    option("--camera-hz", type=float, metavar="RATE")
    option("--fault", action="append", metavar="FAULT[=VALUE][@FROM[-TO]]")
    option("--ycb", type=Path, metavar="DIR")
    option("--seed", type=int, metavar="N")
    option("--memory", type=Path, metavar="FILE")
    p.add_argument(
        "--learn",
        action=argparse.BooleanOptionalAction,
        help="whether to remember what is seen and said (default: it does)",
    )
    option("--runs", type=Path, metavar="DIR")
    p.add_argument("--config", type=Path, metavar="FILE", help="settings in TOML")
    p.add_argument("--gui", action="store_true", help="show PyBullet's own window")
    p.add_argument("--view", action="store_true", help="show the recording live in rerun's viewer")
    p.add_argument("--json", action="store_true", help="print the outcome as JSON")
    p.add_argument("-v", "--verbose", action="count", default=0, help="say more (-vv: all)")
    p.add_argument("--version", action="version", version=version("robot-executive"))
    return p


class _Placement(argparse.Action):
    """Gathers OBJECT=FURNITURE pairs."""

    def __call__(
        self,
        parser: argparse.ArgumentParser,
        namespace: argparse.Namespace,
        values: Any,
        option_string: str | None = None,
    ) -> None:
        """Add one pair."""
        name, equals, furniture = values.partition("=")
        if not (name and equals and furniture):
            parser.error(f"--place {values}: should be OBJECT=FURNITURE, as in mug=desk")
        setattr(namespace, self.dest, {**(getattr(namespace, self.dest) or {}), name: furniture})


if __name__ == "__main__":
    sys.exit(main())
