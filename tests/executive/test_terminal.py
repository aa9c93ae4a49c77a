"""What the doors print can do nothing to a terminal, and no loss of it does anything to them."""

import contextlib
import io
import os
import sys
from collections.abc import Sequence
from importlib import import_module

import pytest
from hypothesis import given
from hypothesis import strategies as st

from executive.shell import DONE, NOT_DONE, entry_point
from executive.terminal import Terminal, show_over


@given(st.text())
def test_no_control_character_but_line_breaks_and_tabs_gets_through(text: str) -> None:
    screen = io.StringIO(newline="")
    Terminal(screen, dispensable=False).write(text)
    shown = screen.getvalue()
    assert all(c.isprintable() or c in "\n\t" or c.isspace() for c in shown)
    assert not set("\x1b\r\x07\x9b\u202e\u2028") & set(shown)


@given(st.text())
def test_every_text_can_be_written_in_ascii(text: str) -> None:
    screen = io.TextIOWrapper(io.BytesIO(), encoding="ascii")
    Terminal(screen, dispensable=False).write(text)
    screen.flush()
    assert len(screen.buffer.getvalue()) >= len(text)  # what cannot be shown is spelled out


@pytest.mark.parametrize("arguments", [["--home", "\x1b[31m\nDONE"], ["\x1b]0;owned\x07"]])
def test_a_refused_option_reaches_the_terminal_spelled_out(
    arguments: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    from sim.__main__ import main

    with pytest.raises(SystemExit):
        main(arguments)
    assert "\x1b" not in capsys.readouterr().err


DOORS = {
    "executive.__main__": "",
    "executive.campaign.__main__": "",
    "sim.learning.__main__": "evaluate",
    "kb.__main__": "check",
    "logs.__main__": "why run",
    "sim.__main__": "check home",
    "trees.__main__": "show",
}


@pytest.mark.parametrize(("door", "words"), DOORS.items())
def test_what_a_door_does_not_know_forges_no_line(
    door: str, words: str, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit):
        import_module(door).main([*words.split(), "--unknown\nerror:all-is-well"])
    complaints = capsys.readouterr().err
    assert "unknown" in complaints
    assert "\nerror:" not in complaints


@pytest.mark.parametrize(("seen", "shown"), [(True, f"\r{'1 of 2':<78}"), (False, "1 of 2\n")])
def test_progress_is_shown_in_place_on_a_terminal_and_in_lines_elsewhere(
    monkeypatch: pytest.MonkeyPatch, seen: bool, shown: str
) -> None:
    screen = io.StringIO(newline="")
    monkeypatch.setattr(screen, "isatty", lambda: seen)
    show_over("1 of 2", Terminal(screen, dispensable=True))  # type: ignore[arg-type]
    assert screen.getvalue() == shown


class Full(io.StringIO):
    def write(self, text: str) -> int:
        raise OSError(28, "No space left on device")


def test_a_full_disk_under_standard_output_is_told_in_a_line(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    @entry_point
    def main(arguments: Sequence[str] | None = None) -> int:
        print("much")
        return DONE

    monkeypatch.setattr(sys, "stdout", Full())
    assert main([]) == NOT_DONE
    assert capsys.readouterr().err == "error: standard output: No space left on device\n"


def test_a_lost_standard_error_costs_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    @entry_point
    def main(arguments: Sequence[str] | None = None) -> int:
        print("a warning", file=sys.stderr)
        return DONE

    monkeypatch.setattr(sys, "stderr", Full())
    assert main([]) == DONE


def test_who_does_not_read_does_not_hold_up_a_hurried_writer() -> None:
    reader, writer = os.pipe()
    os.set_blocking(writer, False)
    with contextlib.suppress(BlockingIOError):
        while True:
            os.write(writer, bytes(4096))
    os.set_blocking(writer, True)
    with os.fdopen(writer, "w", buffering=1) as pipe:
        terminal = Terminal(pipe, dispensable=True)
        terminal.hurried = True
        terminal.write("Where is the mug?\n")  # else this waits for ever
    os.close(reader)
