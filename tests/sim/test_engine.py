"""PyBullet is imported in silence, and nothing else is silenced with it."""

import subprocess
import sys
from pathlib import Path

import pytest


def imported(before: str = "", redirection: str = "") -> "subprocess.CompletedProcess[str]":
    code = f"{before}\nimport sim.engine\nprint(sim.engine.pybullet.__name__)"
    script = f'exec "$@" {redirection}'
    return subprocess.run(
        ["bash", "-c", script, "bash", sys.executable, "-c", code], capture_output=True, text=True
    )


def test_the_import_says_nothing() -> None:
    ended = imported()
    assert (ended.returncode, ended.stdout, ended.stderr) == (0, "pybullet\n", "")


def test_what_else_is_written_meanwhile_is_not_lost(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "pybullet.py").write_text(
        "import os\nos.write(2, b'pybullet build time: x\\nno GPU\\n')\n"
    )
    monkeypatch.setenv("PYTHONPATH", str(tmp_path))
    assert imported().stderr == "no GPU\n"


def test_why_it_cannot_be_imported_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "pybullet.py").write_text("raise ImportError('libGL is missing')\n")
    monkeypatch.setenv("PYTHONPATH", str(tmp_path))
    ended = imported()
    assert ended.returncode == 1
    assert "libGL is missing" in ended.stderr


@pytest.mark.parametrize("redirection", ["2>&-", "2>/dev/full", "2> >(true)"])
def test_a_lost_standard_error_does_not_keep_it_from_being_imported(redirection: str) -> None:
    ended = imported(redirection=redirection)
    assert (ended.returncode, ended.stdout) == (0, "pybullet\n")


def test_a_world_is_opened_by_a_program_whose_standard_output_is_closed() -> None:
    code = "from sim.bullet.client import connect; connect().disconnect()"
    script = f"{sys.executable} -c '{code}' >&-"
    assert subprocess.run(["bash", "-c", script], capture_output=True).returncode == 0
