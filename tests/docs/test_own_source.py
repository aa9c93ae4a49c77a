"""The example of a knowledge source runs, and says what its page says."""

import runpy
from datetime import date
from pathlib import Path

import pytest

EXAMPLE = Path(__file__).parents[2] / "docs" / "examples" / "own_source.py"


def test_the_robot_looks_where_the_calendar_says(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    example = runpy.run_path(str(EXAMPLE))
    calendar = example["Calendar"](EXAMPLE.with_name("calendar.csv"), date(2026, 11, 25))
    outcome = example["bring"]("Bring the hammer", calendar, tmp_path)
    assert (outcome.status, outcome.source, outcome.visited) == ("done", "calendar", ("sofa",))
    assert "I look for the hammer on the sofa: your calendar says so." in capsys.readouterr().err


def test_an_entry_counts_on_its_days_only() -> None:
    example = runpy.run_path(str(EXAMPLE))
    calendar = example["Calendar"](EXAMPLE.with_name("calendar.csv"), date(2026, 11, 5))
    assert calendar.places_of("hammer") == ("desk",)
    assert calendar.places_of("mug") == ()
