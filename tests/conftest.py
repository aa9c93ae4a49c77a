"""What all tests share: settings of hypothesis, and fixtures."""

import hypothesis
import pytest

from executive.testing.bench import four_rooms

hypothesis.settings.register_profile("machines are noisy", deadline=None)
hypothesis.settings.load_profile("machines are noisy")


@pytest.fixture(scope="session")
def places() -> tuple[str, ...]:
    return tuple(place.name for place in four_rooms().places())


@pytest.fixture
def no_plots(monkeypatch: pytest.MonkeyPatch) -> None:
    """Reports without their plots, which take seconds to draw."""
    monkeypatch.setattr("executive.campaign.report.report._plots", lambda found: iter(()))
