"""Choices of a place that an experimenter may hold, then release or replace by another place.

The person is not told; the log shows what was done. A waiting choice is cancelled like any action:
by a stop, or by what the person says meanwhile.
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
"""A choice that waits longer than this is released (mission time, s): nobody seems to be there."""


class HoldChoice(Action):
    """Waits while the choice is held; then goes on with it, or with the experimenter's place.

    The other place must exist in this home, and suit the purpose. Reads and writes steering.
    """

    activity = Activity.THINKING

    def __init__(self, name: str, context: MissionContext) -> None:
        """Wait at most `HELD_S`."""
        super().__init__(name, context, HELD_S)
        self.steering = context.situation.steering

    @abstractmethod
    def choice(self) -> Choice:
        """The choice as it stands."""

    @abstractmethod
    def adopt(self, place: str) -> None:
        """Replace the choice by this place."""

    def is_free(self) -> bool:
        """Whether there was any other option."""
        return True

    @property
    def is_sent_elsewhere(self) -> bool:
        """Whether the experimenter named a place other than the chosen one."""
        choice, place = self.steering.choice, self.steering.instead
        return choice is not None and place not in ("", choice.place)

    def initialise(self) -> None:
        """Wait only if choices are held, and there is another option."""
        self.feedback_message = ""
        if self.steering.holds and self.is_free():
            super().initialise()

    def start(self) -> int:
        """Publish the choice."""
        self.steering.wait(self.choice())
        return self.context.standby.start()

    def update(self) -> Status:
        """Go on if it was released or replaced."""
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
        """Never expected: only the experimenter ends the wait."""
        return self.out_of_time()

    def out_of_time(self) -> Status:
        """Go on with the choice as it is."""
        return self.succeed(f"nobody has let it go for {HELD_S:g} s")

    def cancel(self, request: int) -> None:
        """Withdraw the choice."""
        self.context.standby.cancel(request)
        self.steering.wait(None)

    def doing(self) -> str:
        """Do not mention that the choice is held."""
        return "think about where to go"


class HoldWhereToLook(HoldChoice):
    """Holds the choice where to look next; any place will do.

    Reads and writes search.candidate and search.candidates.
    """

    def choice(self) -> Choice:
        """The current candidate."""
        assert self.situation.search.candidate
        return Choice(For.LOOK, self.situation.search.candidate.place)

    def adopt(self, place: str) -> None:
        """Look there first."""
        self.situation.search.look_first(Candidate(place, EXPERIMENTER))


class HoldGoal(HoldChoice):
    """Holds the choice of the goal; the person named a room, so only its furniture will do.

    Reads and writes request.goal.
    """

    def is_free(self) -> bool:
        """Only if more than one goal is left."""
        return len(self._left()) > 1

    def choice(self) -> Choice:
        """The current goal, among those that were not tried in vain."""
        return Choice(For.PUT, self.situation.request.goal, self._left())

    def adopt(self, place: str) -> None:
        """Use this goal."""
        self.situation.request.goal = place

    def _left(self) -> tuple[str, ...]:
        tried = self.situation.hand.unplaced
        return tuple(goal for goal in self.situation.request.goals if goal not in tried)


class HoldSurface(HoldChoice):
    """Holds the choice where to put something away; any furniture will do, as the robot chose.

    Reads and writes hand.surface.
    """

    def choice(self) -> Choice:
        """The current surface."""
        return Choice(For.PUT, self.situation.hand.surface)

    def adopt(self, place: str) -> None:
        """Use this surface."""
        self.situation.hand.surface = place


def each_untried(places: Sequence[str], taken: Callable[[], str]) -> Iterator[str]:
    """Yields the places not tried yet; after each, `taken` tells which place was used."""
    tried: set[str] = set()
    while left := [place for place in places if place not in tried]:
        yield left[0]
        tried.add(taken())
