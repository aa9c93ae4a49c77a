"""The language model, and who puts questions to it."""

from dataclasses import dataclass
from typing import Protocol

from executive.types.commands import CommandKind
from executive.types.knowledge import Candidate, Verdict
from executive.types.llm import ChatRequest, RankRequest
from executive.types.results import Scored


class LanguageModel(Protocol):
    """A model that writes, and may be able to score."""

    @property
    def name(self) -> str:
        """What to call it in logs."""
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
        """Write a reply; ends Replied, or Failed."""
        ...

    def rank(self, request: RankRequest) -> int:
        """Score the options; ends Scored, or Failed."""
        ...

    def prepare(self, request: ChatRequest | RankRequest) -> None:
        """Work out, while nothing is asked, what others share with this request.

        It is no request itself: nothing ends, and the next one takes over what is ready.
        """
        ...

    def cancel(self, request: int) -> None:
        """Stop generating within one token; the reply is not delivered."""
        ...

    def count_tokens(self, text: str) -> int:
        """How many tokens the text takes, by the model's own tokenizer."""
        ...

    def close(self) -> None:
        """Free the model and end its thread."""
        ...


class PlaceLister(Protocol):
    """Has a language model list places, and lets only real places through.

    The paper's prompting, output parser, memory and consistency verification. `among` holds the
    default locations if the ontology has several, else it is empty: every place is allowed.
    """

    def inquiry(self, name: str, among: tuple[str, ...]) -> ChatRequest:
        """`general_pos`, or `multiple_pos` when `among` is given."""
        ...

    def furniture(self, name: str, room: str, among: tuple[str, ...]) -> ChatRequest:
        """`furniture`: which furniture of this room?"""
        ...

    def again(self, name: str, among: tuple[str, ...]) -> ChatRequest:
        """`again`: the reply named no real place; choose from the list."""
        ...

    def summarize(self, name: str, reply: str) -> ChatRequest:
        """`summarize`: the reply was not in the output format."""
        ...

    def remember(self, request: ChatRequest, reply: str) -> None:
        """Keep the exchange for the next prompts (if this system has a memory)."""
        ...

    def read(self, reply: str) -> tuple[str, ...] | None:
        """The names in a reply, or None if it is not in the output format."""
        ...

    def verify(self, names: tuple[str, ...], among: tuple[str, ...]) -> Verdict:
        """Hold names against the ontology (the existence check)."""
        ...


class PlaceRanker(Protocol):
    """Has a language model score the known places: it cannot invent any."""

    def ranking(self, name: str, among: tuple[str, ...]) -> RankRequest:
        """Score every place that is allowed; all are, if `among` is empty."""
        ...

    def ranked(self, scored: Scored) -> tuple[Candidate, ...]:
        """Places with probabilities (they sum to 1), likeliest first."""
        ...


class CommandReader(Protocol):
    """Has a language model read what the grammar of commands cannot."""

    def ranking(self, words: str) -> RankRequest:
        """Score what the words may ask the robot to do."""
        ...

    def ranked(self, scored: Scored) -> CommandKind:
        """The likeliest of these kinds of command."""
        ...

    def inquiry(self, words: str) -> ChatRequest:
        """`command`: what do the words ask for?"""
        ...

    def read(self, reply: str) -> str:
        """What the reply asks for, as a plain sentence for the grammar.

        It is empty if the reply has not the format, or names a thing or a place that is not there.
        """
        ...


@dataclass(frozen=True, slots=True)
class Advice:
    """Who puts questions to the language model, and takes from its answers only what exists."""

    lister: PlaceLister
    ranker: PlaceRanker
    reader: CommandReader
