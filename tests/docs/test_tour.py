"""What docs/tour.md shows is what the robot says, as far as no model has to think for it."""

import re
import shlex
from pathlib import Path

import pytest

from executive.__main__ import main

PAGE = (Path(__file__).parents[2] / "docs" / "tour.md").read_text()
SHOWN = re.findall(r"^\$ python -m executive (.*)\n((?:[^`$].*\n)*)", PAGE, re.MULTILINE)
WITHOUT_MODEL = [
    (command, said)
    for command, said in SHOWN
    if "--llm none" in command and "--memory" not in command
]


@pytest.mark.parametrize(("command", "said"), WITHOUT_MODEL)
def test_it_says_what_the_tour_shows(
    command: str,
    said: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(shlex.split(command)) == 0
    heard = "".join(capsys.readouterr())
    for line in said.splitlines():
        assert line in (*heard.splitlines(), "...")


def test_the_tour_shows_missions() -> None:
    assert len(SHOWN) > len(WITHOUT_MODEL) > 0
