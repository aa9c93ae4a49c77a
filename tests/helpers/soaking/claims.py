"""Whether what the robot says is so, by the truth of the simulator."""

import re
from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from executive.events import Ended, StopRequested
from executive.interfaces.simulation import SimulatedHome
from executive.language.wording import Wording
from executive.records import EventTaken, Record, Tick
from executive.text import printable
from executive.types.goals import Goal, LookAt
from executive.types.home import FLOOR, HAND
from executive.types.results import Saw, Succeeded
from logs.recorder import Stamp

NAME = r"(?P<thing>[a-z][a-z0-9_]*)"
PLACE = r"(?P<place>[a-z][a-z0-9_]*)"
NOT_FOUND = re.compile(r"I did not find the \w+(?P<places>(?:(?:,| or)? (?:at|the) \w+)+)")
BY_THE_PERSON = "delivery"


@dataclass
class Notes:
    """A sink that keeps what the questions below are asked of, in order."""

    records: list[Record] = field(default_factory=list)
    walls_ns: list[int] = field(default_factory=list)

    def write(self, stamp: Stamp, record: Record) -> None:
        if isinstance(record, EventTaken | Tick):
            self.records.append(record)
            self.walls_ns.append(stamp.wall_ns)

    def flush(self) -> None:
        pass

    def close(self) -> None:
        pass


class Names:
    """Knows what the words stand for that the robot says: "on the high table" is at high_table."""

    def __init__(self, say: Wording, things: Sequence[str], places: Sequence[str]) -> None:
        names = {say.the(thing): f"the {thing}" for thing in things}
        for place in (*places, BY_THE_PERSON, FLOOR):
            names |= {say.the(place): f"the {place}"}
            names |= {at: f"at {place}" for at in (say.at(place), say.at_in_full(place))}
        self._names = names
        self.identifiers = frozenset(name for name in (*things, *places) if "_" in name)
        found = "|".join(map(re.escape, sorted(names, key=len, reverse=True)))
        self._pattern = re.compile(rf"\b(?:{found})\b", re.IGNORECASE)

    def in_names(self, text: str) -> str:
        """What was said, with the names that things and places have in the world."""
        return self._pattern.sub(lambda found: self._names[found[0].lower()], text)


class Witness:
    """Hears what the robot says, and knows the truth at that moment."""

    def __init__(self, world: SimulatedHome, names: Iterable[str], words: Names) -> None:
        self._world = world
        self._names = tuple(names)
        self.in_names = words.in_names
        self._identifiers = words.identifiers
        self.said: list[str] = []
        self.wrong: list[str] = []
        self.was_at: defaultdict[str, set[str]] = defaultdict(set)
        """Where each thing has been so far in this mission."""

    def begin(self) -> None:
        """A mission begins."""
        self.said.clear()
        self.wrong.clear()
        self.was_at.clear()
        self.look()

    def look(self) -> None:
        """Note where everything is; what is on no furniture is most likely in the hand."""
        for name in self._names:
            self.was_at[name].add(self._world.resting_place(name) or HAND)

    def heard(self, text: str) -> None:
        """Judge a sentence of the robot's."""
        self.look()
        self.said.append(text)
        if not text.strip() or text != printable(text):
            self.wrong.append(f"no sentence for a terminal: {text!r}")
        self.wrong += [f"said {text!r}, but {but}" for but in self._untrue(text)]

    def _untrue(self, text: str) -> Iterator[str]:
        """What of a sentence is not so now, or no language."""
        for name in self._identifiers & {*re.findall(r"\w+", re.sub(r"'[^']*'", "", text))}:
            yield f"one says {name} otherwise"
        held, text = self._world.held, self.in_names(text)
        if re.search(r"\bNone\b|: \.|: *$|\(\)", text):
            yield "that is no sentence"
        for pattern in (rf"I took the {NAME} from", rf"[Ii] hold the {NAME}"):
            for match in re.finditer(pattern, text):
                if match["thing"] != held:
                    yield f"it holds {held}"
        for match in re.finditer(rf"my hand holds the {NAME}", text):
            if match["thing"] not in (held, "something"):
                yield f"it holds {held}"
        if "my hand is empty" in text and held:
            yield f"it holds {held}"
        if match := re.match(rf"Here (?:is|are) the {NAME}", text):
            place = self._world.resting_place(match["thing"])
            if place != BY_THE_PERSON:
                yield f"it is at {place}"
        if match := re.match(rf"the {NAME} (?:is|are) here already", text):
            place = self._world.resting_place(match["thing"])
            if place != BY_THE_PERSON:
                yield f"it is at {place}"
        if match := re.match(rf"the {NAME} (?:is|are) at {PLACE}\.", text):
            been = self.was_at[match["thing"]]
            if match["place"] not in been:
                yield f"it was only at {sorted(been)}"


def looked_at(
    records: Iterable[Record], goals: Mapping[int, Goal], views: Callable[[str], int]
) -> frozenset[str]:
    """The places of which every view was seen, by a picture after the head was there."""
    seen: defaultdict[str, set[int]] = defaultdict(set)
    aim: LookAt | None = None
    for record in records:
        if not (isinstance(record, EventTaken) and isinstance(record.event, Ended)):
            continue
        result, goal = record.event.result, goals.get(record.event.request)
        if goal is not None:
            aim = goal if isinstance(goal, LookAt) and isinstance(result, Succeeded) else None
        elif isinstance(result, Saw) and aim is not None:
            seen[aim.place].add(aim.view)
    return frozenset(
        place for place, looks in seen.items() if place == FLOOR or len(looks) >= views(place)
    )


def false_searches(texts: Iterable[str], seen: frozenset[str]) -> Iterator[str]:
    """Places at which the robot says that it did not find a thing, though it did not look there.

    Args:
        texts: what it says, with names instead of words.
        seen: the places that it saw wholly.
    """
    for text in texts:
        for match in NOT_FOUND.finditer(text):
            for place in re.findall(r"(?:at|the) (\w+)", match["places"]):
                if place not in seen:
                    yield f"said {match[0]!r}, but did not see all of {place}"


def ticked_after_stop(records: Iterable[Record]) -> bool:
    """Whether the tree went on although somebody said stop."""
    stopped = False
    for record in records:
        if isinstance(record, EventTaken) and isinstance(record.event, StopRequested):
            stopped = True
        elif isinstance(record, Tick) and stopped:
            return True
    return False
