"""Commands whose output is read by another program."""

import subprocess
import sys

import pytest


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
