"""Help comes at once: nothing is loaded for it that only missions need."""

import subprocess
import sys

import pytest

HEAVY = {
    "asyncio",
    "cv2",
    "lark",
    "llama_cpp",
    "mcap",
    "numpy",
    "py_trees",
    "pybullet",
    "pydantic_settings",
    "rdflib",
    "rerun",
    "scipy",
}
DOORS = ("executive", "executive.campaign", "kb", "kb.benchmark", "logs", "sim", "trees")
ASK = """
import runpy, sys
sys.argv = ["door", "--help"]
try:
    runpy.run_module(sys.orig_argv[-1], run_name="__main__")
except SystemExit:
    print(*sys.modules, file=sys.stderr)
"""


@pytest.mark.parametrize("door", DOORS)
def test_help_loads_no_big_library(door: str):
    asked = subprocess.run(
        [sys.executable, "-c", ASK, door], capture_output=True, text=True, check=True
    )
    assert asked.stdout.startswith("usage:")
    assert HEAVY.isdisjoint(asked.stderr.split())
