"""Choices of a place that an experimenter may hold: they let them go, or choose another place.

Nobody is told; what is done by it stands in the log. A choice that waits is called off like all
that the robot does: by a stop, or by what the person says meanwhile.
"""

from abc import abstractmethod
from collections.abc import Callable, Iterator, Sequence

from py_trees.common import Status

from executive.records import Activity
from executive.situation import Choice, For
from executive.types.knowledge import Candidate
from executive.types.results import Result
from trees.context import MissionContext
from trees.driving import EXPERIMENTER
from trees.nodes import Action
from trees.recall import is_here

HELD_S = 600.0
"""A choice that waits for longer (mission time, s) is let go: nobody seems to be there."""


class HoldChoice(Action):
    """Waits while what was chosen is held; succeeds unless something else is to be done by then.

    Only a place that this home has, and that would do, can take its place. Reads and writes
    steering.
    """

    activity = Activity.THINKING

    def __init__(self, name: str, context: MissionContext) -> None:
        """Wait no longer than somebody may be away."""
        super().__init__(name, context, HELD_S)
        self.steering = context.situation.steering

    @abstractmethod
    def choice(self) -> Choice:
        """What was chosen."""

    @abstractmethod
    def adopt(self, place: str) -> None:
        """Choose this place instead."""

    def is_free(self) -> bool:
        """Whether anything else could have been chosen."""
        return True

    @property
    def is_sent_elsewhere(self) -> bool:
        """Whether the experimenter has named another place than the one that was chosen."""
        choice, place = self.steering.choice, self.steering.instead
        return choice is not None and place not in ("", choice.place)

    def initialise(self) -> None:
        """Wait only if choices are held."""
        self.feedback_message = ""
        if self.steering.holds and self.is_free():
            super().initialise()

    def start(self) -> int:
        """Show what was chosen."""
        self.steering.wait(self.choice())
        return self.context.standby.start()

    def update(self) -> Status:
        """Go on when it is let go, or replaced."""
        if not self.is_under_way:
            return Status.SUCCESS
        choice, place = self.steering.choice, self.steering.instead
        assert choice
        if place and (place in choice.among or (not choice.among and is_here(self.context, place))):
            if place != choice.place:
                self.adopt(place)
            return self.succeed(f"{place}, as the {EXPERIMENTER} says")
        self.steering.instead = ""
        return super().update() if self.steering.holds else self.succeed(choice.place)

    def ended(self, result: Result) -> Status:
        """Nothing ends it but what the experimenter does."""
        return self.out_of_time()

    def out_of_time(self) -> Status:
        """Go on as it was chosen."""
        return self.succeed(f"nobody has let it go for {HELD_S:g} s")

    def cancel(self, request: int) -> None:
        """Nothing waits any more."""
        self.context.standby.cancel(request)
        self.steering.wait(None)

    def doing(self) -> str:
        """Nobody is told that it is held."""
        return "think about where to go"


class HoldWhereToLook(HoldChoice):
    """Where the robot is to look next may be anywhere.

    Reads and writes search.candidate and search.candidates.
    """

    def choice(self) -> Choice:
        """The candidate at hand."""
        assert self.situation.search.candidate
        return Choice(For.LOOK, self.situation.search.candidate.place)

    def adopt(self, place: str) -> None:
        """Look there first."""
        self.situation.search.look_first(Candidate(place, EXPERIMENTER))


class HoldGoal(HoldChoice):
    """Where a thing is to go has to be where the person said: of a room, any furniture will do.

    Reads and writes request.goal.
    """

    def is_free(self) -> bool:
        """One place is no choice."""
        return len(self._left()) > 1

    def choice(self) -> Choice:
        """Among those of them that were not tried in vain."""
        return Choice(For.PUT, self.situation.request.goal, self._left())

    def adopt(self, place: str) -> None:
        """Take it there."""
        self.situation.request.goal = place

    def _left(self) -> tuple[str, ...]:
        tried = self.situation.hand.unplaced
        return tuple(goal for goal in self.situation.request.goals if goal not in tried)


class HoldSurface(HoldChoice):
    """Where the robot gets rid of a thing may be any furniture, if it was its own choice.

    Reads and writes hand.surface.
    """

    def choice(self) -> Choice:
        """The surface at hand."""
        return Choice(For.PUT, self.situation.hand.surface)

    def adopt(self, place: str) -> None:
        """Put it there."""
        self.situation.hand.surface = place


def each_untried(places: Sequence[str], taken: Callable[[], str]) -> Iterator[str]:
    """One place after the other; which one was taken in its place, may be known afterwards."""
    tried: set[str] = set()
    while left := [place for place in places if place not in tried]:
        yield left[0]
        tried.add(taken())
