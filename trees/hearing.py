"""The sources of one belief about where the thing may be: memory, ontology, model, person, others.

The trust in each is estimated. Only that in a list of a language model was measured: in the paper,
the lists had the right place in two thirds of the missions without default locations, and in nine
tenths with them.
"""

from functools import partial
from math import fsum

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from executive.belief import MISSED, Belief, Statement, believe, in_order
from executive.interfaces.knowledge import PlaceSource
from executive.types.knowledge import Source
from executive.types.results import Result, Scored
from trees.context import MissionContext
from trees.location import generate_places
from trees.model import RankPlaces
from trees.nodes import Check, Optionally, Step, sequence
from trees.recall import Memory, is_here

MEMORY_TRUST = 0.9
SOURCE_TRUST = 0.9
"""The trust in a source that a user has added."""
ONTOLOGY_TRUST = 0.95
"""How likely a thing is at one of its default locations."""
PERSON_TRUST = 0.95
LIST_TRUST = 0.75
"""How likely a thing is at one of the places of a list that a language model wrote."""
DENIED = 0.001
"""The factor for a place where the thing is not, as the person says: all others come first."""
CLEAR = 0.5
"""If a place is at least this likely, the robot looks there before it asks the model."""


def what_is_known(context: MissionContext) -> Behaviour:
    """Hear all sources that answer at once; writes search.whereabouts."""
    return sequence(
        "what is known",
        BeginSearch("begin", context),
        HearMemory("memory", context),
        *(Hear(source.name, context, source) for source in context.sources),
        HearOntology("ontology", context),
    )


def consult(context: MissionContext) -> Behaviour:
    """Ask the language model, once a search, if nobody else knows enough.

    It always succeeds: the search goes on, whether the model helps or not.
    """
    asked = (
        (RankAll("llm ranks places", context),)
        if context.parameters.elicit == "rank"
        else (generate_places(context), HearList("take in the list", context))
    )
    search = context.situation.search
    return sequence(
        "think",
        Optionally(
            "if it helps",
            context.situation,
            sequence(
                "consult",
                Check("not asked yet", context, lambda: not search.whereabouts.consulted),
                Check("it is not clear", context, lambda: not is_clear(context)),
                Consulted("ask the model", context),
                *asked,
            ),
        ),
        HasThought("thought", context),
    )


def wants_advice(context: MissionContext) -> bool:
    """Whether it is time to ask the language model."""
    return not context.situation.search.whereabouts.consulted and not is_clear(context)


def believed(context: MissionContext) -> Belief:
    """The belief about where the thing may be, from all that was said and seen so far."""
    search, home = context.situation.search, context.knowledge.places()
    looks, named = search.looks, search.whereabouts.named
    denied = context.facts.places_denied(context.situation.request.thing)
    left = dict.fromkeys(denied, DENIED)
    left |= {
        place: 1 - looks.share_seen(place) * (1 - MISSED)
        for place in looks.visited
        if place not in named
    }
    return believe(search.whereabouts.statements, (place.name for place in home), left)


def is_clear(context: MissionContext) -> bool:
    """Whether one place where the robot may still look is likely enough to go there first."""
    search = context.situation.search
    return any(
        likely.probability >= CLEAR and search.whereabouts.may_look_at(likely.place, search.looks)
        for likely in believed(context).places
    )


class BeginSearch(Step):
    """Forgets what was said in an earlier search.

    Writes search.whereabouts, search.default_locations and search.looks.
    """

    def update(self) -> Status:
        """Forget the statements; where the robot has looked stays known."""
        self.situation.search.whereabouts.begin()
        self.situation.search.default_locations = ()
        self.situation.search.looks.missed = ""
        return Status.SUCCESS


class Hear(Step):
    """Takes in the places of this home that a source names; always succeeds.

    Reads request.object; writes search.whereabouts.
    """

    trust = SOURCE_TRUST

    def __init__(self, name: str, context: MissionContext, source: PlaceSource) -> None:
        """`source` is the one to ask."""
        super().__init__(name, context)
        self.knows = source
        self.source = source.name

    def update(self) -> Status:
        """Ask the source, and add its statement."""
        assert self.situation.request.object
        named = self.knows.places_of(self.situation.request.object)
        places = tuple(p for p in dict.fromkeys(named) if is_here(self.context, p))
        if not places:
            return self.succeed("knows no place")
        self.situation.search.whereabouts.hear(
            Statement(self.knows.name, in_order(places), self.trust)
        )
        self.heard(places)
        return self.succeed(", ".join(places))

    def heard(self, places: tuple[str, ...]) -> None:
        """Do what else follows from the places that were named; here nothing."""


class HearMemory(Hear):
    """Takes in what the robot remembers; its memory leaves out places where it looked in vain.

    If the robot has learned from earlier sightings, it knows how far to trust its memory, and where
    people may have taken the thing since.
    """

    trust = MEMORY_TRUST

    def __init__(self, name: str, context: MissionContext) -> None:
        """Ask the memory of this context."""
        super().__init__(name, context, Memory(context.facts))

    def update(self) -> Status:
        """Add what was learned; if nothing is learned here, what is remembered.

        Places that this home does not have (any more) are left out.
        """
        name, experience = self.situation.request.object, self.context.experience
        assert name
        if experience is None:
            return super().update()
        heard = []
        for said in experience.recalled(name):
            here = said.of(partial(is_here, self.context))
            if not here.trust:
                continue
            self.situation.search.whereabouts.hear(here)
            likeliest, _ = max(here.weights, key=lambda pair: pair[1])
            heard.append(f"{here.source} {here.trust:.2f}: {likeliest}")
            if said.source == self.source and likeliest in self.knows.places_of(name):
                self.heard((likeliest,))
        return self.succeed(", ".join(heard) or "knows no place")

    def heard(self, places: tuple[str, ...]) -> None:
        """Count these places as worth a look: there is news of them since the last look."""
        self.situation.search.whereabouts.named.update(places)


class HearOntology(Step):
    """Takes in the default locations of the thing; always succeeds.

    Reads request.object; writes search.whereabouts and search.default_locations.
    """

    source = Source.ONTOLOGY

    def update(self) -> Status:
        """Add the ontology's statement.

        It is trusted as far as this home has the places that it names. If it names several, the
        language model may say which of them is likeliest, and may name no others.
        """
        name, knowledge = self.situation.request.object, self.context.knowledge
        assert name
        likely = knowledge.likely_places(name)
        if not likely:
            return self.succeed("knows no place")
        trust = ONTOLOGY_TRUST * min(1.0, fsum(likely.values()))
        said = Statement(Source.ONTOLOGY, tuple(likely.items()), trust, orders=False)
        self.situation.search.whereabouts.hear(said)
        if len(usual := knowledge.usual_places(name)) > 1:
            self.situation.search.default_locations = usual
        return self.succeed(", ".join(likely))


class Consulted(Step):
    """Notes that the language model is asked. Writes search.whereabouts."""

    def update(self) -> Status:
        """Note it, so that the model is asked only once a search."""
        self.situation.search.whereabouts.consulted = True
        self.situation.search.whereabouts.thinks = True
        return Status.SUCCESS


class HasThought(Step):
    """Notes that no answer of the language model is to come any more. Writes search.whereabouts."""

    def update(self) -> Status:
        """Note it, whether the model has helped or not."""
        self.situation.search.whereabouts.thinks = False
        return Status.SUCCESS


class RankAll(RankPlaces):
    """Has every place of the home scored, and takes all scores in.

    Reads request.object; writes search.whereabouts.
    """

    @property
    def among(self) -> tuple[str, ...]:
        """All places may be scored."""
        return ()

    def ended(self, result: Result) -> Status:
        """Add the model's statement: how likely each place is."""
        if not isinstance(result, Scored):
            return self.failed(result)
        ranked = self.advice.ranker.ranked(result)
        weights = tuple((c.place, c.probability or 0.0) for c in ranked)
        self.situation.search.whereabouts.hear(Statement(Source.LLM, weights, trust=1.0))
        return self.succeed(", ".join(map(str, ranked[: self.context.parameters.top_k])))


class HearList(Step):
    """Takes in the list that the language model wrote, as far as its places exist.

    Reads search.candidates; writes search.whereabouts.
    """

    source = Source.LLM

    def update(self) -> Status:
        """Add the model's statement; the first place of the list is the likeliest."""
        places = [candidate.place for candidate in self.situation.search.candidates]
        said = Statement(Source.LLM, in_order(places, factor=0.8), LIST_TRUST)
        self.situation.search.whereabouts.hear(said)
        return self.succeed(", ".join(places))
