"""Choices of a place that an experimenter may hold, and then release or replace.

The person is not told; the log has what the experimenter did. Like all actions of the robot, a
held choice is cancelled by a stop, or by what the person says meanwhile.
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
"""A choice that is held for longer (mission time, s) is released: nobody seems to be there."""


class HoldChoice(Action):
    """Waits while a choice is held; succeeds when it is released or replaced.

    The experimenter can replace it only by a place of this home that is possible here. Reads and
    writes steering.
    """

    activity = Activity.THINKING

    def __init__(self, name: str, context: MissionContext) -> None:
        """Wait for at most `HELD_S`."""
        super().__init__(name, context, HELD_S)
        self.steering = context.situation.steering

    @abstractmethod
    def choice(self) -> Choice:
        """The choice of the robot."""

    @abstractmethod
    def adopt(self, place: str) -> None:
        """Take this place instead."""

    def is_free(self) -> bool:
        """Whether the robot had more than one possibility."""
        return True

    @property
    def is_sent_elsewhere(self) -> bool:
        """Whether the experimenter has named another place than the robot."""
        choice, place = self.steering.choice, self.steering.instead
        return choice is not None and place not in ("", choice.place)

    def initialise(self) -> None:
        """Wait only if choices are held, and there is another option."""
        self.feedback_message = ""
        if self.steering.holds and self.is_free():
            super().initialise()

    def start(self) -> int:
        """Show the choice to the experimenter."""
        self.steering.wait(self.choice())
        return self.context.standby.start()

    def update(self) -> Status:
        """Succeed when the choice is released or replaced."""
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
        """Never called: no result ends a choice, only the experimenter does."""
        return self.out_of_time()

    def out_of_time(self) -> Status:
        """Succeed with the robot's choice."""
        return self.succeed(f"nobody has let it go for {HELD_S:g} s")

    def cancel(self, request: int) -> None:
        """Show no choice any more."""
        self.context.standby.cancel(request)
        self.steering.wait(None)

    def doing(self) -> str:
        """It seems to think: the person is not told that the choice is held."""
        return "think about where to go"


class HoldWhereToLook(HoldChoice):
    """Holds where to look next; it may be replaced by any place of the home.

    Reads and writes search.candidate and search.candidates.
    """

    def choice(self) -> Choice:
        """The current candidate."""
        return Choice(For.LOOK, self.situation.search.place)

    def adopt(self, place: str) -> None:
        """Look there first."""
        self.situation.search.look_first(Candidate(place, EXPERIMENTER))


class HoldGoal(HoldChoice):
    """Holds where a thing goes; it may be replaced only by another goal that the person named.

    Reads and writes request.goal.
    """

    def is_free(self) -> bool:
        """Whether more than one goal is left."""
        return len(self._left()) > 1

    def choice(self) -> Choice:
        """The goal, among those that were not tried in vain."""
        return Choice(For.PUT, self.situation.request.goal, self._left())

    def adopt(self, place: str) -> None:
        """Take the thing there."""
        self.situation.request.goal = place

    def _left(self) -> tuple[str, ...]:
        tried = self.situation.hand.unplaced
        return tuple(goal for goal in self.situation.request.goals if goal not in tried)


class HoldSurface(HoldChoice):
    """Holds where the robot gets rid of a thing; it may be replaced by any furniture.

    Reads and writes hand.surface.
    """

    def choice(self) -> Choice:
        """The chosen furniture."""
        return Choice(For.PUT, self.situation.hand.surface)

    def adopt(self, place: str) -> None:
        """Use this surface."""
        self.situation.hand.surface = place


def each_untried(places: Sequence[str], taken: Callable[[], str]) -> Iterator[str]:
    """Each place that was not tried yet.

    After each, `taken` returns the place that was tried in fact: an experimenter may replace it.
    """
    tried: set[str] = set()
    while left := [place for place in places if place not in tried]:
        yield left[0]
        tried.add(taken())
