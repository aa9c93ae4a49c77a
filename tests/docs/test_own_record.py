"""The page on records: its three changes are made to a copy of the packages, and they suffice."""

import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from rerun.chunk import RrdReader

HOUSE = Path(__file__).parents[2]
PAGE = HOUSE / "docs" / "examples" / "own_record.md"


def blocks(language: str) -> list[str]:
    return [part.split("```")[0] for part in PAGE.read_text().split(f"```{language}\n")[1:]]


def changes() -> Iterator[tuple[str, str, str]]:
    """Each hunk of the page: the file, what stands there, and what shall."""
    for block in blocks("diff"):
        file, *hunks = block.split("@@\n")
        for hunk in hunks:
            lines = hunk.splitlines(keepends=True)
            old = "".join(line[1:] for line in lines if line.startswith(" "))
            yield file.removeprefix("+++ ").strip(), old, "".join(line[1:] for line in lines)


@pytest.fixture
def house(tmp_path: Path) -> Path:
    """The two packages as the page has them, and its program beside them."""
    for package in ("executive", "logs"):
        ignored = shutil.ignore_patterns("__pycache__")
        shutil.copytree(HOUSE / package, tmp_path / package, ignore=ignored)
    for name, old, new in changes():
        file = tmp_path / name
        text = file.read_text()
        assert text.count(old) == 1, f"{name} has no such lines any more, or several:\n{old}"
        file.write_text(text.replace(old, new))
    (program,) = blocks("python")
    (tmp_path / "battery_robot.py").write_text(program)
    return tmp_path


def run(house: Path) -> subprocess.CompletedProcess[str]:
    paths = {**os.environ, "PYTHONPATH": str(HOUSE)}  # for the other packages
    command = [sys.executable, "battery_robot.py"]
    return subprocess.run(command, cwd=house, env=paths, capture_output=True, text=True)


def test_the_record_is_recorded_read_back_and_in_the_viewer(house: Path) -> None:
    ran = run(house)
    assert ran.stdout == "0.0 s: 12.4 V\n", ran.stderr
    (recording,) = house.glob("runs/*/mission.rrd")
    (shown,) = (c for c in RrdReader(recording).stream() if str(c.entity_path) == "/battery")
    assert shown.to_record_batch().column("Scalars:scalars").to_pylist() == [[12.4]]


def test_without_its_entry_it_fails_at_import(house: Path) -> None:
    shutil.copy(HOUSE / "logs/recording/channels.py", house / "logs/recording/channels.py")
    assert "BatteryLevel would not be recorded: give each kind of record an" in run(house).stderr


def test_the_page_names_the_files_that_it_changes() -> None:
    rows = [line.split("`")[1] for line in PAGE.read_text().splitlines() if line.startswith("| `")]
    assert rows == list(dict.fromkeys(name for name, _, _ in changes()))
