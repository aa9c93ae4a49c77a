"""Sources that know places without a look: the robot's memory, and those that a user adds."""

from dataclasses import dataclass

from py_trees.common import Status

from executive.interfaces.knowledge import Facts, PlaceSource
from executive.replies import SAYS
from executive.situation import candidates_from
from executive.types.home import DELIVERY
from executive.types.knowledge import Candidate, Source
from trees.context import MissionContext
from trees.nodes import Step


class Recall(Step):
    """Succeeds if a source names a place of this home where the robot has not looked yet.

    Reads request.object and search.looks; writes search.candidates.
    """

    def __init__(self, name: str, context: MissionContext, source: PlaceSource) -> None:
        """`source` is the one to ask."""
        super().__init__(name, context)
        self.knows = source
        self.source = source.name

    def update(self) -> Status:
        """Ask the source for places."""
        assert self.situation.request.object
        places = dict.fromkeys(self.knows.places_of(self.situation.request.object))
        here = (place for place in places if is_here(self.context, place))
        new = self.worth_a_visit(candidates_from(here, self.knows.name))
        if not new:
            return self.fail(self.unknown(self.context.say.the(self.situation.request.object)))
        self.situation.search.candidates = new
        return self.succeed(", ".join(candidate.place for candidate in new))

    def worth_a_visit(self, candidates: tuple[Candidate, ...]) -> tuple[Candidate, ...]:
        """The candidates where the robot has not looked yet."""
        return self.situation.search.not_visited(candidates)

    def unknown(self, thing: str) -> str:
        """A clause that says that the source does not help."""
        return f"the {self.knows.name} names no place to look for {thing}"


def is_here(context: MissionContext, place: str) -> bool:
    """Whether this home has the place; each has the delivery table, which no home file lists."""
    return place == DELIVERY or context.knowledge.has_place(place)


@dataclass(frozen=True, slots=True)
class Memory:
    """Implements `PlaceSource`: what the robot itself has seen, heard and done."""

    facts: Facts
    name = Source.MEMORY
    says = SAYS[Source.MEMORY]

    def places_of(self, name: str) -> tuple[str, ...]:
        """Where the object may be; see `Facts.places_of`."""
        return self.facts.places_of(name)


class MemoryKnowsPlaces(Recall):
    """Succeeds if the thing was seen in this home, or said to be there."""

    def __init__(self, name: str, context: MissionContext) -> None:
        """The source is the robot's own memory."""
        super().__init__(name, context, Memory(context.facts))

    def worth_a_visit(self, candidates: tuple[Candidate, ...]) -> tuple[Candidate, ...]:
        """All candidates: the memory itself forgets where the robot has looked in vain."""
        return candidates

    def unknown(self, thing: str) -> str:
        """The robot has not seen the thing."""
        return f"I have not seen {thing}"
