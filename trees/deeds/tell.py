"""Tell what is at a place: go there, look at all of it, come back, and say what was seen."""

from collections.abc import Callable, Mapping

from executive.types.commands import CommandKind
from trees.context import MissionContext
from trees.deeds.answer import Answer
from trees.survey import found_where, not_seen, nothing_there

Lengths = tuple[float, ...]


def area(lengths: Lengths) -> float:
    """Area of the largest side (m^2), from lengths in descending order."""
    return lengths[0] * lengths[1]


def width(lengths: Lengths) -> float:
    """Width across the longest direction (m)."""
    return lengths[1]


MEASURES: Mapping[str, tuple[Callable[[Lengths], float], bool]] = {
    "largest": (area, True),
    "smallest": (area, False),
    "thinnest": (width, False),
}
"""How to compare things by sight: the measure, and whether the largest value is meant."""
CLEARLY = 1.1
"""The factor by which the first must differ from the second: only a part of a thing is visible."""


class TellWhatIsThere(Answer):
    """As in "What is on the table?", "What is the biggest fruit on the table?"."""

    kind = CommandKind.TELL

    def answer(self, context: MissionContext) -> tuple[str, str]:
        """What was seen; the thing with a superlative first, if sight can decide which it is."""
        found, command = context.situation.survey.found, context.situation.request.asked_for
        why_not = not_seen(context)
        if not found:
            return f"{nothing_there(context)}.", why_not
        seen = f"I see {found_where(found, context.say)}."
        if not command.superlative:
            return seen, why_not
        if len(found) == 1:
            [only] = found
            return f"{context.say.the(only).capitalize()}: I see no other there.", why_not
        most = utmost(command.superlative, list(found), context.situation.survey.lengths)
        if not most:
            return seen, why_not or f"I cannot tell by looking which is the {command.superlative}"
        return f"{context.say.are(most).capitalize()} the {command.superlative}; {seen}", why_not


def utmost(superlative: str, names: list[str], lengths: Mapping[str, Lengths]) -> str:
    """Which of the things it is, judged by what is visible; empty if that does not decide it."""
    if superlative not in MEASURES or not all(lengths.get(name) for name in names):
        return ""
    measure, most = MEASURES[superlative]
    sizes = {name: measure(lengths[name]) for name in names}
    first, second, *_ = sorted(names, key=lambda name: sizes[name], reverse=most)
    larger, smaller = max(sizes[first], sizes[second]), min(sizes[first], sizes[second])
    return first if larger > CLEARLY * smaller else ""
