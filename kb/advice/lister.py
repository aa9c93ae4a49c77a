"""Lets the language model list places: prompts, memory, parser and verification.

The paper's section "Proposed System", without the model itself, and without the order of the
steps, which is a subtree.
"""

from collections.abc import Sequence

from executive.interfaces.llm import LanguageModel
from executive.types.home import Place
from executive.types.knowledge import Verdict
from executive.types.llm import ChatRequest, Message
from kb.advice import verification
from kb.advice.history import DialogueHistory, history_budget
from kb.advice.large_homes import as_many_as_fit, fits, of_all_kinds
from kb.advice.prompts import Prompts
from kb.ontology.names import unique
from kb.ontology.ontology import Ontology

SITUATION = "likely places"
"""The topic of a summary."""


class Lister:
    """Implements `PlaceLister`."""

    def __init__(
        self,
        ontology: Ontology,
        model: LanguageModel,
        *,
        remembers: bool,
        top: int = 5,
        prompts: Prompts | None = None,
    ) -> None:
        """The ontology limits what is asked about; the model only counts tokens here.

        Args:
            ontology: what exists.
            model: its context window and tokenizer limit the memory.
            remembers: whether prompts contain the dialogue so far (OKB+LLM+MEM) or not (OKB+LLM).
            top: maximum number of places to ask for.
            prompts: the prompt texts; None: those in prompts.toml.
        """
        self._ontology = ontology
        self._model = model
        self._remembers = remembers
        self._top = top
        self._prompts = prompts or Prompts.load()
        home = self._prompts.home(ontology.places())
        self._by_rooms = not fits(home, model.context_tokens)
        if self._by_rooms:
            home = self._prompts.rooms(self._choices())
        self._system = Message("system", home)
        self._memory: DialogueHistory | None = None

    def inquiry(self, name: str, among: tuple[str, ...]) -> ChatRequest:
        """Prompt `general_pos`; `multiple_pos` if `among` is given."""
        if among:
            text = self._prompts.inquiry(
                "multiple_pos", object_name=name, position=", ".join(among)
            )
            return self._request("multiple_pos", text, among)
        text = self._prompts.inquiry("general_pos", object_name=name, top=str(self._top))
        return self._request("general_pos", text, self._choices())

    def furniture(self, name: str, room: str, among: tuple[str, ...]) -> ChatRequest:
        """Prompt `furniture`: which furniture in this room?"""
        allowed = verification.allowed(self._ontology.places(), among)
        choice = self._fitting([p for p in allowed if p.room == room])
        text = self._prompts.inquiry(
            "furniture", object_name=name, room_name=room, furniture_list=", ".join(choice)
        )
        return self._request("furniture", text, choice)

    def again(self, name: str, among: tuple[str, ...]) -> ChatRequest:
        """Prompt `again`: the reply named no existing place; choose from the list."""
        choice = self._choices(among)
        text = self._prompts.inquiry("again", object_name=name, furniture_list=", ".join(choice))
        return self._request("again", text, choice)

    def summarize(self, name: str, reply: str) -> ChatRequest:
        """Prompt `summarize`, after the exchange with this reply if the memory does not end so."""
        text = self._prompts.inquiry("summarize", object_name=name, situation=SITUATION)
        if self._history()[-1:] == (Message("assistant", reply),):
            return self._request("summarize", text, self._choices())
        asked = self._prompts.inquiry("general_pos", object_name=name, top=str(self._top))
        exchange = (Message("user", asked), Message("assistant", reply))
        return self._request("summarize", text, self._choices(), exchange)

    def remember(self, request: ChatRequest, reply: str) -> None:
        """Add the exchange to the memory, if there is one."""
        if not self._remembers:
            return
        if self._memory is None:
            system = self._model.count_tokens(self._system.content)
            budget = history_budget(self._model.context_tokens, system)
            self._memory = DialogueHistory(budget, self._model.count_tokens)
        self._memory.add(request.messages[-1].content, reply)

    def read(self, reply: str) -> tuple[str, ...] | None:
        """The names in a reply; None if it is not in the output format."""
        return verification.read(reply)

    def verify(self, names: tuple[str, ...], among: tuple[str, ...]) -> Verdict:
        """Check which names exist in the ontology (the existence check)."""
        return verification.verify(names, self._ontology.place_names, among)

    def _choices(self, among: tuple[str, ...] = ()) -> list[str]:
        """The names to choose from; rooms, if the home is too large to list its furniture."""
        allowed = verification.allowed(self._ontology.places(), among)
        if not self._by_rooms or among:
            return self._fitting(allowed)
        return as_many_as_fit(unique(p.room for p in allowed), self._model.context_tokens)

    def _fitting(self, places: Sequence[Place]) -> list[str]:
        """The names; if there are too many, as many as fit, of all kinds."""
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
