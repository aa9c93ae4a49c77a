"""Lets the language model rank places: what it has to score, and the resulting order."""

from collections.abc import Iterator
from dataclasses import replace
from functools import cached_property

from executive.interfaces.knowledge import Facts
from executive.types.knowledge import Candidate
from executive.types.llm import RankRequest
from executive.types.results import Scored
from kb.advice import ranking
from kb.advice.large_homes import Alike
from kb.advice.prompts import Prompts
from kb.advice.ranking import Known
from kb.advice.verification import allowed
from kb.ontology.names import unique
from kb.ontology.ontology import Ontology


class Ranker:
    """Implements `PlaceRanker`."""

    def __init__(
        self, ontology: Ontology, *, prompts: Prompts | None = None, facts: Facts | None = None
    ) -> None:
        """Rank the places of the ontology.

        Args:
            ontology: what exists.
            prompts: the prompt texts; None: those in prompts.toml.
            facts: where things were seen; used as precedents, as default locations are.
        """
        self._ontology = ontology
        self._texts = (prompts or Prompts.load()).ranking
        self._facts = facts
        self._scored_alike: dict[tuple[str, ...], Alike] = {}

    def ranking(self, name: str, among: tuple[str, ...]) -> RankRequest:
        """A request to score every allowed place, instead of asking for a list."""
        alike = Alike.among(allowed(self._ontology.places(), among))
        options = [
            (group[0], ranking.answer(place, self._ontology.preposition(place)))
            for group, place in zip(alike.groups.values(), alike.spoken_of(), strict=True)
        ]
        thing = self._usual.get(name, Known(name))
        others = (
            replace(other, places=unique(map(alike.stands_for, other.places)))
            for other in self._others(name)
        )
        request = ranking.rank_request(thing, options, self._texts, others)
        self._scored_alike[request.places] = alike
        return request

    def ranked(self, scored: Scored) -> tuple[Candidate, ...]:
        """Places with probabilities (they sum to 1), likeliest first."""
        alike = self._scored_alike.get(scored.request.places)
        return ranking.ranked(alike.apart(scored) if alike else scored)

    @cached_property
    def _usual(self) -> dict[str, Known]:
        """Every object with the places of this home that match its default locations."""
        ontology = self._ontology
        return {
            name: Known(name, ontology.class_of(name), tuple(ontology.likely_places(name)))
            for name in ontology.objects()
        }

    def _others(self, name: str) -> Iterator[Known]:
        """All other objects, with where they were last seen, else with their default locations."""
        for other in self._usual.values():
            if other.name != name:
                seen = self._facts.places_of(other.name) if self._facts else ()
                yield replace(other, places=seen) if seen else other
