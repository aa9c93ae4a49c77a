"""What all tests share: settings of hypothesis, and fixtures."""

import gc

import hypothesis
import pytest

from executive.testing.bench import four_rooms

hypothesis.settings.register_profile("machines are noisy", deadline=None)
hypothesis.settings.load_profile("machines are noisy")


def pytest_collection_finish() -> None:
    """Look for garbage less often, and never among what is there now: all of it is in use.

    A sixth of the time of tests in the instant world went there.
    """
    gc.collect()
    gc.freeze()
    gc.set_threshold(5000, 10, 10)


@pytest.fixture(scope="session")
def places() -> tuple[str, ...]:
    return tuple(place.name for place in four_rooms().places())


@pytest.fixture
def no_plots(monkeypatch: pytest.MonkeyPatch) -> None:
    """Reports without their plots, which take seconds to draw."""
    monkeypatch.setattr("executive.campaign.report.report._plots", lambda found: iter(()))
