"""Expected durations of tasks (s), estimated without asking or looking."""

from collections.abc import Iterable, Iterator, Sequence
from math import inf

from executive.belief import Belief, Likely, Statement, believe, in_order
from executive.plan import FAR_S, Chance, Plan, Prices, best_plan
from executive.types.commands import HELD, Command, CommandKind
from executive.types.knowledge import Source
from trees.context import MissionContext
from trees.hearing import MEMORY_TRUST, ONTOLOGY_TRUST, PERSON_TRUST
from trees.meant import things_meant
from trees.place_words import best_first, places_in
from trees.ways import Ways

LIKELIEST = 4
"""Only this many likely places of a thing count; their best order is found quickly."""
ALONE = Prices(question_s=inf)
"""The price of a question is infinite, so that nobody is asked."""


class Expected:
    """Expected durations of tasks, by the current beliefs and travel times."""

    def __init__(self, context: MissionContext) -> None:
        """No travel time has been asked for yet."""
        self._context = context
        self._ways = Ways(context)
        self._told: dict[tuple[Command, str], tuple[float, str]] = {}

    def done_after(self, commands: Iterable[Command], start: str) -> Iterator[float]:
        """For each command, when it is done (seconds from now) if all are done in this order."""
        passed = 0.0
        for command in commands:
            seconds, start = self._of(command, start)
            passed += seconds
            yield passed

    def seconds(self, command: Command, start: str) -> float:
        """Duration from this start until the thing (or the robot) is where it is to be (s)."""
        return self._of(command, start)[0]

    def _of(self, command: Command, start: str) -> tuple[float, str]:
        """The duration (s), and where the robot is at its end."""
        if (command, start) not in self._told:
            plan = looking(self._ways, start, self._likely(command, start))
            seen = next(iter(plan.order), start)
            end = self._end(command) or seen
            [carrying] = self._ways.driving(seen, [end])
            seconds = plan.expected.seconds + carrying if plan.order else FAR_S
            self._told[command, start] = min(seconds, FAR_S), end
        return self._told[command, start]

    def _end(self, command: Command) -> str | None:
        """Where the thing or the robot ends up; None if that is where the thing is found."""
        means = command.kind.means
        if not means.at_goal:
            return means.ends_at if means.grasps else None
        named = places_in(self._context, command.goal or command.target)
        return best_first(self._context, named)[0] if named else None

    def _likely(self, command: Command, start: str) -> Sequence[Likely]:
        """Where the thing may be, or the place the robot goes to."""
        context = self._context
        if command.kind == CommandKind.GO:
            return [Likely(self._end(command) or start, 1.0)]
        if is_in_hand(context, command):
            return [Likely(start, 1.0)]
        return whereabouts(context, command).places[:LIKELIEST]


def is_in_hand(context: MissionContext, command: Command) -> bool:
    """Whether a task is about what the robot holds."""
    held = context.situation.hand.in_hand
    return command.target == HELD or held in things_meant(context, command)


def looking(ways: Ways, start: str, likely: Sequence[Likely]) -> Plan:
    """The order of looking with the shortest expected time until the thing is seen."""
    places = [one.place for one in likely]
    return best_plan(
        [Chance(one.place, one.probability) for one in likely],
        ways.seconds(start, places),
        [ways.seconds(place, places) for place in places],
        ALONE,
    )


def seen_soonest(context: MissionContext, likely: Sequence[Likely]) -> tuple[str, ...]:
    """All of these places in the best order; those that cannot be reached come last."""
    order = looking(Ways(context), context.situation.dialogue.at, likely).order
    return tuple(dict.fromkeys((*order, *(one.place for one in likely))))


def whereabouts(context: MissionContext, command: Command) -> Belief:
    """Where one of the things of a task may be, by the words, the memory and the ontology."""
    named = places_in(context, command.source) if command.source else ()
    things = things_meant(context, command)
    remembered = [place for thing in things for place in context.facts.places_of(thing)]
    usual = [
        place
        for thing in things
        for denied in [context.facts.places_denied(thing)]
        for place in context.knowledge.usual_places(thing)
        if place not in denied
    ]
    said = (
        Statement(Source.USER, in_order(named, factor=1.0), PERSON_TRUST),
        Statement(Source.MEMORY, in_order(remembered), MEMORY_TRUST),
        Statement(Source.ONTOLOGY, in_order(usual, factor=1.0), ONTOLOGY_TRUST),
    )
    return believe(said, (place.name for place in context.knowledge.places()))
