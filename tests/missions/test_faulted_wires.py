"""Over a wire that delays, cuts, halves and reorders, missions end, tell no lie, and stop."""

from pathlib import Path

import pytest
from faulted_wire import missions


@pytest.mark.parametrize("seed", range(10))
def test_missions_over_a_bad_wire_end_and_tell_no_lie(seed: int, tmp_path: Path) -> None:
    assert missions(seed, tmp_path).faults == []
