"""What lies in the folder neither breaks a command nor is run in place of what is ours."""

import subprocess
import sys
import tomllib
from pathlib import Path

import pytest
from patience import PATIENCE_S

SCRIPTS = tomllib.loads((Path(__file__).parents[2] / "pyproject.toml").read_text())["project"][
    "scripts"
]


def run(*command: str, folder: Path) -> "subprocess.CompletedProcess[str]":
    return subprocess.run(
        [sys.executable, *command], cwd=folder, capture_output=True, text=True, timeout=PATIENCE_S
    )


@pytest.mark.parametrize("door", ["executive", "executive.campaign", "kb"])
def test_a_file_of_the_folder_that_shadows_a_package_is_named(door: str, tmp_path: Path) -> None:
    (tmp_path / "sim.py").write_text("raise RuntimeError('not mine')\n")
    ended = run("-m", door, "--help", folder=tmp_path)
    assert (ended.returncode, ended.stdout) == (2, "")
    assert ended.stderr.startswith(
        f"error: {tmp_path}/sim.py shadows the package sim of robot-executive; run robot-executive"
    )
    assert ended.stderr.count("\n") == 1


def test_a_package_of_the_folder_is_named_too(tmp_path: Path) -> None:
    (tmp_path / "logs").mkdir()
    (tmp_path / "logs/__init__.py").touch()
    ended = run("-m", "executive", "--version", folder=tmp_path)
    assert ended.returncode == 2
    assert f"{tmp_path}/logs shadows" in ended.stderr


@pytest.mark.parametrize(("name", "entry"), SCRIPTS.items())
def test_the_commands_do_not_import_from_the_folder(name: str, entry: str, tmp_path: Path) -> None:
    for shadow in ("sim", "logs", "kb", "trees", "numpy"):
        (tmp_path / f"{shadow}.py").write_text("raise RuntimeError('not mine')\n")
    module, function = entry.split(":")
    (tmp_path / "bin").mkdir()
    script = tmp_path / "bin" / name
    script.write_text(f"import sys\nfrom {module} import {function}\nsys.exit({function}())\n")
    ended = run(str(script), "--help", folder=tmp_path)
    assert (ended.returncode, ended.stderr) == (0, "")
    door = {"": "executive", "-campaign": "executive.campaign"}.get(
        name.removeprefix("robot-executive"), name.removeprefix("robot-executive-")
    )
    assert ended.stdout.startswith(f"usage: python -m {door} ")
