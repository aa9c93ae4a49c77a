"""The language model, and the parts that write its prompts and read its replies."""

from dataclasses import dataclass
from typing import Protocol

from executive.types.commands import CommandKind
from executive.types.knowledge import Candidate, Verdict
from executive.types.llm import ChatRequest, RankRequest
from executive.types.results import Scored


class LanguageModel(Protocol):
    """A model that writes text, and may be able to score options."""

    @property
    def name(self) -> str:
        """Name for the logs."""
        ...

    @property
    def context_tokens(self) -> int:
        """Size of its context window (tokens)."""
        ...

    @property
    def can_rank(self) -> bool:
        """Whether `rank` is available (it needs the model's token probabilities)."""
        ...

    def chat(self, request: ChatRequest) -> int:
        """Start to write a reply; ends Replied, or Failed."""
        ...

    def rank(self, request: RankRequest) -> int:
        """Start to score the options; ends Scored, or Failed."""
        ...

    def prepare(self, request: ChatRequest | RankRequest) -> None:
        """Compute in advance, while the model is idle, what later requests share with this one.

        This is not a request and has no result. The next request uses what is ready by then.
        """
        ...

    def cancel(self, request: int) -> None:
        """Stop generating within one token; the reply is not delivered."""
        ...

    def count_tokens(self, text: str) -> int:
        """Length of a text in tokens, by the model's own tokenizer."""
        ...

    def close(self) -> None:
        """Free the model and end its thread."""
        ...


class PlaceLister(Protocol):
    """Writes prompts that ask a language model for places, and accepts only places that exist.

    This is the paper's prompting, output parser, memory and consistency verification. `among` is
    the default locations if the ontology has several; if it is empty, every place is allowed.
    """

    def inquiry(self, name: str, among: tuple[str, ...]) -> ChatRequest:
        """Prompt `general_pos`, or `multiple_pos` if `among` is given: where is the thing?"""
        ...

    def furniture(self, name: str, room: str, among: tuple[str, ...]) -> ChatRequest:
        """Prompt `furniture`: which furniture of this room?"""
        ...

    def again(self, name: str, among: tuple[str, ...]) -> ChatRequest:
        """Prompt `again`: the reply named no existing place; choose from the list."""
        ...

    def summarize(self, name: str, reply: str) -> ChatRequest:
        """Prompt `summarize`: the reply was not in the output format; summarise it."""
        ...

    def remember(self, request: ChatRequest, reply: str) -> None:
        """Keep the exchange for later prompts, if the system has a memory."""
        ...

    def read(self, reply: str) -> tuple[str, ...] | None:
        """Parse the names in a reply; None if it is not in the output format."""
        ...

    def verify(self, names: tuple[str, ...], among: tuple[str, ...]) -> Verdict:
        """Look the names up in the ontology (the paper's existence check)."""
        ...


class PlaceRanker(Protocol):
    """Has a language model score the known places, so that it cannot invent any."""

    def ranking(self, name: str, among: tuple[str, ...]) -> RankRequest:
        """The request to score the places in `among`; all places if it is empty."""
        ...

    def ranked(self, scored: Scored) -> tuple[Candidate, ...]:
        """The places with probabilities (sum 1), the likeliest first."""
        ...


class CommandReader(Protocol):
    """Has a language model read commands that the grammar cannot parse."""

    def ranking(self, words: str) -> RankRequest:
        """The request to score which kind of command the words are."""
        ...

    def ranked(self, scored: Scored) -> CommandKind:
        """The likeliest kind of command."""
        ...

    def inquiry(self, words: str) -> ChatRequest:
        """Prompt `command`: what do the words ask for?"""
        ...

    def read(self, reply: str) -> str:
        """The command in the reply, as a plain sentence for the grammar.

        Empty if the reply is not in the format, or names an unknown thing or place.
        """
        ...


@dataclass(frozen=True, slots=True)
class Advice:
    """The parts that ask the language model, and accept from its replies only what exists."""

    lister: PlaceLister
    ranker: PlaceRanker
    reader: CommandReader
