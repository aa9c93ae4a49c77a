"""Who says where it may be: what each source knows becomes a part of one belief.

How far each is to be believed is estimated, not measured, but for the list of a language model: the
lists of the paper had the right place in two thirds of the missions without default locations, and
in nine tenths with them.
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
"""Of a source of somebody's own."""
ONTOLOGY_TRUST = 0.95
"""That a thing is at one of its default locations."""
PERSON_TRUST = 0.95
LIST_TRUST = 0.75
"""That a thing is at one of the places of a list that a language model wrote."""
DENIED = 0.001
"""What is left of a place where the person says that it is not: all others are looked at first."""
CLEAR = 0.5
"""Where a place is as likely as this, nobody else is asked before it was looked at."""


def what_is_known(context: MissionContext) -> Behaviour:
    """All who answer at once are heard -> `situation.search.whereabouts.statements`."""
    return sequence(
        "what is known",
        BeginSearch("begin", context),
        HearMemory("memory", context),
        *(Hear(source.name, context, source) for source in context.sources),
        HearOntology("ontology", context),
    )


def consult(context: MissionContext) -> Behaviour:
    """The language model is asked, once a search, when nobody else knows enough.

    It always succeeds in the end: whatever comes of it, the search goes on.
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
    """Where the thing may be, by all that was said and seen so far."""
    search, home = context.situation.search, context.knowledge.places()
    looks, named = search.looks, search.whereabouts.named
    denied = context.facts.places_denied(context.situation.request.object or "")
    left = dict.fromkeys(denied, DENIED)
    left |= {
        place: 1 - looks.share_seen(place) * (1 - MISSED)
        for place in looks.visited
        if place not in named
    }
    return believe(search.whereabouts.statements, (place.name for place in home), left)


def is_clear(context: MissionContext) -> bool:
    """Whether one place, still to be looked at, is likely enough to go there first."""
    search = context.situation.search
    return any(
        likely.probability >= CLEAR and search.whereabouts.may_look_at(likely.place, search.looks)
        for likely in believed(context).places
    )


class BeginSearch(Step):
    """Forgets what was said in a search before."""

    def update(self) -> Status:
        """Begin with nothing; where it was looked at stays known."""
        self.situation.search.whereabouts.begin()
        self.situation.search.default_locations = ()
        self.situation.search.looks.missed = ""
        return Status.SUCCESS


class Hear(Step):
    """Takes in the places of this home that a source names; always succeeds."""

    trust = SOURCE_TRUST

    def __init__(self, name: str, context: MissionContext, source: PlaceSource) -> None:
        """Ask this source."""
        super().__init__(name, context)
        self.knows = source
        self.source = source.name

    def update(self) -> Status:
        """Hear it."""
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
        """What else follows from it: nothing."""


class HearMemory(Hear):
    """The robot's own memory, which forgets by itself where the thing was looked for in vain.

    If it has learned from what it saw, it tells how much its memory is worth, and where people may
    have taken the thing since.
    """

    trust = MEMORY_TRUST

    def __init__(self, name: str, context: MissionContext) -> None:
        """Ask the facts."""
        super().__init__(name, context, Memory(context.facts))

    def update(self) -> Status:
        """Hear what was learned; without that, what is remembered.

        Of places that this home has not, or no more, nothing is said: that is left to others.
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
        """It was seen or said there since the last look there."""
        self.situation.search.whereabouts.named.update(places)


class HearOntology(Step):
    """Takes in the default locations of the thing; always succeeds."""

    source = Source.ONTOLOGY

    def update(self) -> Status:
        """Which of several is likeliest, the language model may say; it may write of these only.

        The ontology is believed as far as this home has what it speaks of.
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
    """Notes that the language model is asked."""

    def update(self) -> Status:
        """Once a search is enough."""
        self.situation.search.whereabouts.consulted = True
        self.situation.search.whereabouts.thinks = True
        return Status.SUCCESS


class HasThought(Step):
    """Notes that the language model thinks no more, whatever came of it."""

    def update(self) -> Status:
        """Nothing is to come any more."""
        self.situation.search.whereabouts.thinks = False
        return Status.SUCCESS


class RankAll(RankPlaces):
    """Has every place of the home scored, and takes all of it in."""

    @property
    def among(self) -> tuple[str, ...]:
        """All are allowed."""
        return ()

    def ended(self, result: Result) -> Status:
        """Keep how likely each place is."""
        if not isinstance(result, Scored):
            return self.failed(result)
        ranked = self.advice.ranker.ranked(result)
        weights = tuple((c.place, c.probability or 0.0) for c in ranked)
        self.situation.search.whereabouts.hear(Statement(Source.LLM, weights, trust=1.0))
        return self.succeed(", ".join(map(str, ranked[: self.context.parameters.top_k])))


class HearList(Step):
    """Takes in the list that the language model wrote, as far as its places exist."""

    source = Source.LLM

    def update(self) -> Status:
        """The first of a list is the likeliest."""
        places = [candidate.place for candidate in self.situation.search.candidates]
        said = Statement(Source.LLM, in_order(places, factor=0.8), LIST_TRUST)
        self.situation.search.whereabouts.hear(said)
        return self.succeed(", ".join(places))
