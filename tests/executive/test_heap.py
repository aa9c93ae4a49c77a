"""What is freed is kept, so that what is taken next costs no new pages."""

import ctypes
import subprocess
import sys
from typing import Any

import pytest

from executive.heap import keep_what_is_freed

FAULTS = """
import resource, sys
import numpy as np
from executive.heap import keep_what_is_freed

if sys.argv[1] == "keep":
    keep_what_is_freed()

def pictures():
    [np.ones(2**20, np.uint8) for _ in range(6)]

def faults():
    return resource.getrusage(resource.RUSAGE_SELF).ru_minflt

pictures()
before = faults()
for _ in range(20):
    pictures()
print(faults() - before)
"""


def faults(how: str) -> int:
    """How often a new page was handed out, while pictures came and went."""
    command = [sys.executable, "-c", FAULTS, how]
    return int(subprocess.run(command, capture_output=True, text=True, check=True).stdout)


@pytest.mark.skipif(not hasattr(ctypes.CDLL(None), "mallopt"), reason="another C library")
def test_the_memory_of_a_picture_serves_the_next() -> None:
    assert faults("keep") < faults("give back") / 10


def test_another_c_library_has_its_own_ways(monkeypatch: pytest.MonkeyPatch) -> None:
    def none(name: Any) -> Any:
        raise OSError(name)

    monkeypatch.setattr(ctypes, "CDLL", none)
    keep_what_is_freed()
