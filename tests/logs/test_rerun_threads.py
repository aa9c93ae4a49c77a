"""What is left of a recording for the viewer when it is closed."""

import os
import sys
from pathlib import Path

import pytest

from logs.viewer.sink import RerunSink


@pytest.mark.skipif(sys.platform != "linux", reason="counts threads by /proc")
def test_a_closed_recording_leaves_no_threads(tmp_path: Path) -> None:
    def threads() -> int:
        return len(os.listdir("/proc/self/task"))

    RerunSink(tmp_path / "first.rrd").close()  # rerun keeps a few for all recordings
    before = threads()
    for number in range(5):
        RerunSink(tmp_path / f"{number}.rrd").close()
    assert threads() < before + 5
