"""Baselines of the executive: an order of places that no language model chose."""

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
"""An object's name, and the places that are allowed -> the places in the order to visit them."""


class Indifferent:
    """Stands in for a language model: all options are alike to it, and their order stays."""

    name = "none"
    context_tokens = 4096
    can_rank = True

    def __init__(self, inbox: Inbox) -> None:
        """Answer at once."""
        self._inbox = inbox

    def chat(self, request: ChatRequest) -> int:
        """Fail: it cannot write."""
        number = self._inbox.open()
        self._inbox.end(number, Failed("there is no language model"))
        return number

    def rank(self, request: RankRequest) -> int:
        """Score all options alike."""
        number = self._inbox.open()
        self._inbox.end(number, Scored(request, (0.0,) * len(request.options), Usage()))
        return number

    def prepare(self, request: ChatRequest | RankRequest) -> None:
        """Nothing to prepare."""

    def cancel(self, request: int) -> None:
        """Forget the request."""
        self._inbox.drop(request)

    def count_tokens(self, text: str) -> int:
        """How many words the text has."""
        return len(text.split())

    def close(self) -> None:
        """Nothing to free."""


class Ordered(Ranker):
    """Names the places in a given order, for a model to which they are all alike."""

    def __init__(self, parts: Parts, order: Order) -> None:
        """Order the places of the mission's home."""
        super().__init__(parts.knowledge)
        self._order = order

    def ranking(self, name: str, among: tuple[str, ...]) -> RankRequest:
        """The allowed places, in order."""
        request = super().ranking(name, among)
        words = dict(zip(request.places, request.options, strict=True))
        places = tuple(self._order(name, request.places))
        options = tuple(words[place] for place in places)
        return replace(request, places=places, options=options, place_kinds=())


def nearest(parts: Parts) -> Order:
    """Always go to the place that is nearest to where the robot is, by the map."""
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
    """Any order; the same for the same seed and object."""

    def order(name: str, places: Sequence[str]) -> list[str]:
        chance = random.Random(f"{parts.settings.seed} {name}")
        return chance.sample(list(places), len(places))

    return order


@cache
def the_survey() -> Ontology:
    """The ontology with the survey's default locations, whatever a mission's situation."""
    return Ontology(defaults=True)


def popular(parts: Parts | None = None) -> Order:
    """Where other things usually are, by the survey; equals in the home's order.

    The record that the asked object takes its own default locations from is left out, and with it
    all that share it. The survey is used in both situations.
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
    """The place where the thing truly is, then the others: knows the truth, as no robot does."""

    def order(name: str, places: Sequence[str]) -> list[str]:
        truth = parts.home.placement.get(name)
        return sorted(places, key=lambda place: place != truth)

    return order


def ordered(parts: Parts, rule: Callable[[Parts], Order]) -> Parts:
    """The parts with advice that goes by a rule instead of a language model.

    The settings have to ask for a ranking. okb has no advice, and stays as it is.
    """
    if parts.settings.knowledge == KnowledgeSystem.OKB:
        return parts
    model = Indifferent(parts.inbox)
    usual = advise(parts.knowledge, model, remembers=False)
    advice = replace(usual, ranker=Ordered(parts, rule(parts)))
    return replace(parts, model=model, advice=advice)
