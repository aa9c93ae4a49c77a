"""Text lines for a person about what was learned of where things are."""

import math
from collections.abc import Iterable, Iterator

from executive.geometry import Floats
from kb.between import HOURS
from kb.experience import Experience

WORTH_TELLING = 0.01
BUSY = 2.0
"""An hour is reported if more than this multiple of the mean is moved in it."""


def lines(experience: Experience, names: Iterable[str]) -> Iterator[str]:
    """The likely places of each thing, with their sources and the half-life of a sighting."""
    for name in names:
        belief = experience.belief(name)
        likely = [one for one in belief.places if one.probability >= WORTH_TELLING]
        if likely:
            half = worth(experience.rates().of(name, likely[0].place))
            yield f"{name:20} a sighting at {likely[0].place} is worth half after {half}"
            yield from (f"  {one}" for one in likely)


def habits(experience: Experience) -> Iterator[str]:
    """For each class of things, how long a sighting is worth, and when people move things."""
    rates = experience.rates()
    for name in sorted(set(rates.of_class) - {""}):
        rate = rates.of_class[name]
        moved = f"moved {at_hours(rate)}"
        yield f"{name:20} a sighting is worth half after {worth(rate)}; {moved}"


def worth(rate: Floats) -> str:
    """The half-life of a sighting, as text: until the thing is as likely moved as not."""
    hours = math.log(2) / float(rate.mean())
    return f"{hours / HOURS:.1f} days" if hours >= 2 * HOURS else f"{hours:.0f} hours"


def at_hours(rate: Floats) -> str:
    """The hours of the day (UTC) in which most things are moved."""
    busy = [hour for hour in range(HOURS) if rate[hour] > BUSY * rate.mean()]
    return f"mostly at {', '.join(f'{hour}:00' for hour in busy)} UTC" if busy else "at any hour"
