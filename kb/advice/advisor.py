"""The language model as an adviser about places: prompts, memory, parser and verification in one.

The paper's section "Proposed System", less the model itself and less the order of the steps, which
is a subtree.
"""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import cached_property

from executive.interfaces import Facts, LanguageModel
from executive.types import (
    Candidate,
    ChatRequest,
    CommandKind,
    Message,
    Place,
    RankRequest,
    Scored,
    Verdict,
)
from kb.advice import commands, ranking, verification
from kb.advice.history import DialogueHistory, history_budget
from kb.advice.large_homes import Alike, as_many_as_fit, fits, of_all_kinds
from kb.advice.prompts import Prompts
from kb.advice.ranking import Known
from kb.ontology.names import unique
from kb.ontology.ontology import Ontology

SITUATION = "likely places"
"""What a summary is about."""


class PlaceAdvisor:
    """Implements `Advisor`."""

    def __init__(
        self,
        ontology: Ontology,
        model: LanguageModel,
        *,
        remembers: bool,
        top: int = 5,
        prompts: Prompts | None = None,
        facts: Facts | None = None,
    ) -> None:
        """Advise with what the ontology knows; the model only counts tokens here.

        Args:
            ontology: what exists.
            model: whose context window and tokenizer limit the memory.
            remembers: whether prompts hold the dialogue so far (OKB+LLM+MEM) or not (OKB+LLM).
            top: how many places to ask for, at most.
            prompts: the texts; None: those of prompts.toml.
            facts: where things were seen; like default locations they are precedents for others.
        """
        self._ontology = ontology
        self._model = model
        self._remembers = remembers
        self._top = top
        self._prompts = prompts or Prompts.load()
        self._facts = facts
        home = self._prompts.home(ontology.places())
        self._by_rooms = not fits(home, model.context_tokens)
        if self._by_rooms:
            home = self._prompts.rooms(self._choices())
        self._system = Message("system", home)
        self._scored_alike: dict[tuple[str, ...], Alike] = {}
        self._memory: DialogueHistory | None = None

    def inquiry(self, name: str, among: tuple[str, ...]) -> ChatRequest:
        """`general_pos`, or `multiple_pos` when `among` is given."""
        if among:
            text = self._prompts.inquiry(
                "multiple_pos", object_name=name, position=", ".join(among)
            )
            return self._request("multiple_pos", text, among)
        text = self._prompts.inquiry("general_pos", object_name=name, top=str(self._top))
        return self._request("general_pos", text, self._choices())

    def furniture(self, name: str, room: str, among: tuple[str, ...]) -> ChatRequest:
        """`furniture`: which furniture of this room?"""
        choice = self._fitting([p for p in self._allowed(among) if p.room == room])
        text = self._prompts.inquiry(
            "furniture", object_name=name, room_name=room, furniture_list=", ".join(choice)
        )
        return self._request("furniture", text, choice)

    def again(self, name: str, among: tuple[str, ...]) -> ChatRequest:
        """`again`: the reply named no real place; choose from the list."""
        choice = self._choices(among)
        text = self._prompts.inquiry("again", object_name=name, furniture_list=", ".join(choice))
        return self._request("again", text, choice)

    def summarize(self, name: str, reply: str) -> ChatRequest:
        """`summarize`: the reply, which is shown once more if no memory holds it."""
        text = self._prompts.inquiry("summarize", object_name=name, situation=SITUATION)
        if self._history()[-1:] == (Message("assistant", reply),):
            return self._request("summarize", text, self._choices())
        asked = self._prompts.inquiry("general_pos", object_name=name, top=str(self._top))
        exchange = (Message("user", asked), Message("assistant", reply))
        return self._request("summarize", text, self._choices(), exchange)

    def remember(self, request: ChatRequest, reply: str) -> None:
        """Keep the exchange for the next prompts, if this system has a memory."""
        if not self._remembers:
            return
        if self._memory is None:
            system = self._model.count_tokens(self._system.content)
            budget = history_budget(self._model.context_tokens, system)
            self._memory = DialogueHistory(budget, self._model.count_tokens)
        self._memory.add(request.messages[-1].content, reply)

    def read(self, reply: str) -> tuple[str, ...] | None:
        """The names in a reply, or None if it is not in the output format."""
        return verification.read(reply)

    def verify(self, names: tuple[str, ...], among: tuple[str, ...]) -> Verdict:
        """Hold names against the ontology (the existence check)."""
        return verification.verify(names, self._ontology.place_names, among)

    def command_ranking(self, words: str) -> RankRequest:
        """Score what the words may ask the robot to do."""
        return commands.rank_request(words, self._prompts.understanding)

    def command_ranked(self, scored: Scored) -> CommandKind:
        """The likeliest of these kinds of command."""
        return commands.likeliest(scored)

    def command_inquiry(self, words: str) -> ChatRequest:
        """`command`: what do the words ask for?"""
        objects = self._ontology.objects()
        return commands.chat_request(words, objects, self._prompts.understanding)

    def command_read(self, reply: str) -> tuple[CommandKind, str] | None:
        """CommandKind and object of the reply, if it has the format and the object exists."""
        asked = commands.read(reply)
        if asked is None or len(self._ontology.objects_named(asked.object)) != 1:
            return None
        return asked.kind, self._ontology.objects_named(asked.object)[0]

    def ranking(self, name: str, among: tuple[str, ...]) -> RankRequest:
        """Score every allowed place instead of asking for a list."""
        alike = Alike.among(self._allowed(among))
        options = [
            (group[0], ranking.answer(place, self._ontology.preposition(place)))
            for group, place in zip(alike.groups.values(), alike.spoken_of(), strict=True)
        ]
        thing = self._usual.get(name, Known(name))
        others = (
            replace(other, places=unique(map(alike.stands_for, other.places)))
            for other in self._others(name)
        )
        request = ranking.rank_request(thing, options, self._prompts.ranking, others)
        self._scored_alike[request.places] = alike
        return request

    def ranked(self, scored: Scored) -> tuple[Candidate, ...]:
        """Places with probabilities (they sum to 1), likeliest first."""
        alike = self._scored_alike.get(scored.request.places)
        return ranking.ranked(alike.apart(scored) if alike else scored)

    @cached_property
    def _usual(self) -> dict[str, Known]:
        """Every object with its default locations."""
        ontology = self._ontology
        return {
            name: Known(name, (*ontology.classes_of(name), "")[0], ontology.usual_places(name))
            for name in ontology.objects()
        }

    def _others(self, name: str) -> Iterator[Known]:
        """All other objects: where they were seen last, else their default locations."""
        for other in self._usual.values():
            if other.name != name:
                seen = self._facts.places_of(other.name) if self._facts else ()
                yield replace(other, places=seen) if seen else other

    def _allowed(self, among: tuple[str, ...]) -> tuple[Place, ...]:
        return tuple(p for p in self._ontology.places() if not among or p.name in among)

    def _choices(self, among: tuple[str, ...] = ()) -> list[str]:
        """What the model may name; rooms, if the home is too large for its furniture."""
        allowed = self._allowed(among)
        if not self._by_rooms or among:
            return self._fitting(allowed)
        return as_many_as_fit(unique(p.room for p in allowed), self._model.context_tokens)

    def _fitting(self, places: Sequence[Place]) -> list[str]:
        """The names; of too many as many as fit, of all kinds."""
        names = [place.name for place in places]
        fitting = as_many_as_fit(names, self._model.context_tokens)
        if len(fitting) == len(names):
            return names
        return as_many_as_fit(of_all_kinds(places), self._model.context_tokens)

    def _history(self) -> tuple[Message, ...]:
        return self._memory.messages() if self._memory else ()

    def _request(
        self, label: str, text: str, choice: Sequence[str], before: tuple[Message, ...] = ()
    ) -> ChatRequest:
        messages = (self._system, *self._history(), *before, Message("user", text))
        return ChatRequest(label, messages, verification.schema(choice, self._top))
