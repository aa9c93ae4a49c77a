"""How commands end."""

import errno
import subprocess
import sys
from collections.abc import Sequence

import pytest

from executive.errors import InputError
from executive.shell import BAD_INPUT, STOPPED, entry_point


@pytest.mark.parametrize(
    "command", [("kb", "show", "apple"), ("trees", "show"), ("sim", "check", "four_rooms")], ids=str
)
def test_a_reader_that_has_seen_enough_ends_a_command_in_silence(command: tuple[str, ...]) -> None:
    with subprocess.Popen(
        [sys.executable, "-m", *command], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    ) as process:
        assert process.stdout is not None
        process.stdout.close()
        assert process.stderr is not None
        complaints = process.stderr.read()
    assert process.returncode == 1
    assert "BrokenPipe" not in complaints


def test_bad_input_ends_a_command_with_a_line_that_says_what_would_be_right(
    capsys: pytest.CaptureFixture[str],
) -> None:
    @entry_point
    def main(arguments: Sequence[str] | None = None) -> int:
        raise InputError("--rooms", "is 0", "give at least 1")

    assert main([]) == BAD_INPUT
    assert capsys.readouterr().err == "error: --rooms: is 0; give at least 1\n"


def test_what_the_user_may_not_use_ends_a_command_with_a_line_that_names_it(
    capsys: pytest.CaptureFixture[str],
) -> None:
    @entry_point
    def main(arguments: Sequence[str] | None = None) -> int:
        raise PermissionError(errno.EACCES, "Permission denied", "locked/mission.mcap")

    assert main([]) == BAD_INPUT
    line = "error: locked/mission.mcap: Permission denied; name what you may use\n"
    assert capsys.readouterr().err == line


def test_ctrl_c_ends_a_command_without_a_traceback(capsys: pytest.CaptureFixture[str]) -> None:
    @entry_point
    def main(arguments: Sequence[str] | None = None) -> int:
        raise KeyboardInterrupt

    assert main([]) == STOPPED
    assert capsys.readouterr().err == ""
