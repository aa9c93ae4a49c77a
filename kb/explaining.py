"""What was learned of where things are, in lines for a person."""

import math
from collections.abc import Iterable, Iterator

from executive.geometry import Floats
from kb.between import HOURS
from kb.experience import Experience

WORTH_TELLING = 0.01
BUSY = 2.0
"""An hour is told in which so many times more is moved than in the mean hour."""


def lines(experience: Experience, names: Iterable[str]) -> Iterator[str]:
    """Where each thing is likely now, with who gave how much of it, and how fast that fades."""
    for name in names:
        belief = experience.belief(name)
        likely = [one for one in belief.places if one.probability >= WORTH_TELLING]
        if likely:
            half = worth(experience.rates().of(name, likely[0].place))
            yield f"{name:20} a sighting at {likely[0].place} is worth half after {half}"
            yield from (f"  {one}" for one in likely)


def habits(experience: Experience) -> Iterator[str]:
    """How long a sighting is worth for each class of things, and when people move things."""
    rates = experience.rates()
    for name in sorted(set(rates.of_class) - {""}):
        rate = rates.of_class[name]
        moved = f"moved {at_hours(rate)}"
        yield f"{name:20} a sighting is worth half after {worth(rate)}; {moved}"


def worth(rate: Floats) -> str:
    """After how long the chance is even that a thing was moved."""
    hours = math.log(2) / float(rate.mean())
    return f"{hours / HOURS:.1f} days" if hours >= 2 * HOURS else f"{hours:.0f} hours"


def at_hours(rate: Floats) -> str:
    """The hours of the day (UTC) in which most is moved."""
    busy = [hour for hour in range(HOURS) if rate[hour] > BUSY * rate.mean()]
    return f"mostly at {', '.join(f'{hour}:00' for hour in busy)} UTC" if busy else "at any hour"
