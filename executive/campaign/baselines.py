"""Baselines of the executive: orders of places without a language model."""

import random
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import cache
from itertools import chain

from executive.app.parts import Parts
from executive.campaign.routes import routes_of
from executive.config import KnowledgeSystem
from executive.events import Inbox
from executive.types.llm import ChatRequest, RankRequest, Usage
from executive.types.results import Failed, Scored
from kb.advice.advisor import advise
from kb.advice.ranker import Ranker
from kb.ontology.ontology import Ontology

Order = Callable[[str, Sequence[str]], Sequence[str]]
"""(name of an object, allowed places) -> the places in the order to visit them."""


class Indifferent:
    """Stands in for a language model: scores all options alike, so that their order stays."""

    name = "none"
    context_tokens = 4096
    can_rank = True

    def __init__(self, inbox: Inbox) -> None:
        """End requests in this inbox at once."""
        self._inbox = inbox

    def chat(self, request: ChatRequest) -> int:
        """End the request as Failed: it cannot write."""
        number = self._inbox.open()
        self._inbox.end(number, Failed("there is no language model"))
        return number

    def rank(self, request: RankRequest) -> int:
        """Score all options alike."""
        number = self._inbox.open()
        self._inbox.end(number, Scored(request, (0.0,) * len(request.options), Usage()))
        return number

    def prepare(self, request: ChatRequest | RankRequest) -> None:
        """Do nothing."""

    def cancel(self, request: int) -> None:
        """Drop the request."""
        self._inbox.drop(request)

    def count_tokens(self, text: str) -> int:
        """The number of words."""
        return len(text.split())

    def close(self) -> None:
        """Do nothing."""


class Ordered(Ranker):
    """A ranker that names the places in a given order, for `Indifferent`."""

    def __init__(self, parts: Parts, order: Order) -> None:
        """Use this order."""
        super().__init__(parts.knowledge)
        self._order = order

    def ranking(self, name: str, among: tuple[str, ...]) -> RankRequest:
        """The request with the allowed places in this order."""
        request = super().ranking(name, among)
        words = dict(zip(request.places, request.options, strict=True))
        places = tuple(self._order(name, request.places))
        options = tuple(words[place] for place in places)
        return replace(request, places=places, options=options, place_kinds=())


def nearest(parts: Parts) -> Order:
    """Always go next to the nearest place, by the shortest path in the map."""
    routes = routes_of(parts.home)

    def order(name: str, places: Sequence[str]) -> list[str]:
        here, left, tour = parts.home.robot_start[:2], list(places), list[str]()
        while left:
            tour.append(routes.nearest(here, left))
            left.remove(tour[-1])
            here = routes.stand(tour[-1])
        return tour

    return order


def by_chance(parts: Parts) -> Order:
    """A random order; the same for the same seed and object."""

    def order(name: str, places: Sequence[str]) -> list[str]:
        chance = random.Random(f"{parts.settings.seed} {name}")
        return chance.sample(list(places), len(places))

    return order


@cache
def the_survey() -> Ontology:
    """The ontology with the survey's default locations, also for missions without them."""
    return Ontology(defaults=True)


def popular(parts: Parts | None = None) -> Order:
    """First the places where most other things are, by the survey; ties in the home's order.

    The record with the default locations of the requested object is left out, and so are all
    objects that share it. The survey is used with and without default locations.
    """
    survey = the_survey()
    recorded = survey.recorded_locations()

    def order(name: str, places: Sequence[str]) -> list[str]:
        kinds = survey.classes_of(name) if name in survey.objects() else ()
        own = next((n for n in (name, *kinds) if n in recorded), None)
        others = (where for other, where in recorded.items() if other != own)
        counts = Counter(chain.from_iterable(others))
        return sorted(places, key=lambda place: -counts[place])

    return order


def true_first(parts: Parts) -> Order:
    """First the place where the thing is, by the ground truth, which no robot has."""

    def order(name: str, places: Sequence[str]) -> list[str]:
        truth = parts.home.placement.get(name)
        return sorted(places, key=lambda place: place != truth)

    return order


def ordered(parts: Parts, rule: Callable[[Parts], Order]) -> Parts:
    """The parts with advice that follows a rule instead of a language model.

    The settings have to ask for a ranking. The system okb has no advice, and is unchanged.
    """
    if parts.settings.knowledge == KnowledgeSystem.OKB:
        return parts
    model = Indifferent(parts.inbox)
    usual = advise(parts.knowledge, model, remembers=False)
    advice = replace(usual, ranker=Ordered(parts, rule(parts)))
    return replace(parts, model=model, advice=advice)
