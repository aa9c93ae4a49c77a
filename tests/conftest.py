"""What all tests share: settings of hypothesis, and fixtures."""

import gc
import os
import signal
import sys
from collections.abc import Iterator
from pathlib import Path

import hypothesis
import pytest
from patience import PATIENCE_S

from executive.testing.bench import four_rooms

pytest.register_assert_rewrite("executive.testing.contracts")  # so that they tell what was there

LIMITS = {
    "executive.campaign.cluster": ("CONNECTING_S",),
    "executive.ros.actions": ("LINK_S", "PATH_S"),
    "executive.ros.camera": ("LINK_S",),
    "executive.ros.rclpy_link": ("SERVER_S",),
    "executive.ros.thread": ("LEAVING_S",),
    "kb.llm.llama": ("CLOSING_S",),
    "kb.llm.server.asking": ("LOOKING_S",),
    "kb.llm.server.server": ("CLOSING_S",),
    "logs.recorder": ("PATIENCE_S", "CLOSE_S"),
    "logs.viewer.program": ("START_S", "SETTLE_S"),
}
"""How long is waited for what comes at once on a machine with nothing else to do."""

SLOW = (hypothesis.HealthCheck.too_slow,)
hypothesis.settings.register_profile(
    "machines are noisy",
    deadline=None,
    suppress_health_check=SLOW,
    derandomize="CI" in os.environ,  # a change is judged by the same examples as the one before it
)
hypothesis.settings.load_profile("machines are noisy")


def pytest_collection_finish() -> None:
    """Look for garbage less often, and never among what is there now: all of it is in use.

    A sixth of the time of tests in the instant world went there.
    """
    gc.collect()
    gc.freeze()
    gc.set_threshold(5000, 10, 10)
    for module, limits in LIMITS.items():
        for limit in limits if module in sys.modules else ():
            setattr(sys.modules[module], limit, PATIENCE_S)


@pytest.fixture(scope="session")
def places() -> tuple[str, ...]:
    return tuple(place.name for place in four_rooms().places())


@pytest.fixture
def own_folder_and_signals(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """For tests that call a program's `main`, which writes into its folder and hears signals."""
    monkeypatch.chdir(tmp_path)
    before = {number: signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM)}
    yield
    for number, handler in before.items():
        signal.signal(number, handler)


@pytest.fixture
def no_plots(monkeypatch: pytest.MonkeyPatch) -> None:
    """Reports without their plots, which take seconds to draw."""
    monkeypatch.setattr("executive.campaign.report.report._plots", lambda found: iter(()))
