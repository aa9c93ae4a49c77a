"""A knowledge source of one's own: a calendar that says where things are lent to, day by day.

A source is a name, a clause that tells the person who says so, and a method. It is asked after the
robot's own memory and before the ontology and the language model; what it names is looked at only
if the home has such a place, and the person hears whose word it is.

    python docs/examples/own_source.py
"""

import csv
from dataclasses import dataclass
from datetime import date
from pathlib import Path

from executive.app import Session
from executive.config import load_settings
from executive.types import Outcome


@dataclass(frozen=True)
class Calendar:
    """Implements `PlaceSource` over a CSV file with the columns from, to, thing, place."""

    file: Path
    today: date
    name = "calendar"
    says = "your calendar says so"

    def places_of(self, name: str) -> tuple[str, ...]:
        """Where it is today; no places if no entry is about it."""
        with self.file.open(newline="", encoding="utf-8") as lines:
            return tuple(
                entry["place"]
                for entry in csv.DictReader(lines)
                if entry["thing"] == name
                and date.fromisoformat(entry["from"]) <= self.today
                and self.today <= date.fromisoformat(entry["to"])
            )


def bring(words: str, calendar: Calendar, runs: Path | None = None) -> Outcome:
    """One mission in the instant world, by a robot that can look into this calendar."""
    home = {"world": "fake", "place": {"hammer": "sofa"}}
    settings = load_settings(**home, llm="none", user="oracle", runs=runs)
    with Session(settings, sources=[calendar]) as session:
        return session.run(words)


if __name__ == "__main__":
    entries = Path(__file__).with_name("calendar.csv")
    outcome = bring("Bring the hammer", Calendar(entries, date(2026, 11, 25)))
    print(f"{outcome.status}: it was at {outcome.location}, as the {outcome.source} said")
