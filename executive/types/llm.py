"""Requests to a language model, and what a call costs."""

from dataclasses import dataclass, field
from typing import Any


@dataclass(frozen=True, slots=True)
class Message:
    """One message of a chat; `role` is `system`, `user` or `assistant`."""

    role: str
    content: str


@dataclass(frozen=True, slots=True)
class ChatRequest:
    """Ask the language model for a text.

    Attributes:
        label: name of the prompt (the paper's labels).
        schema: JSON schema for the reply, for models that can follow one.
    """

    label: str
    messages: tuple[Message, ...]
    schema: dict[str, Any] | None = None


@dataclass(frozen=True, slots=True)
class Precedent:
    """A thing whose places are known: the question about it, and the right answers.

    `kind` is the parent class in the ontology; empty if there is none.
    """

    messages: tuple[Message, ...]
    places: tuple[str, ...]
    kind: str = ""


@dataclass(frozen=True, slots=True)
class RankRequest:
    """Ask the language model how likely each of `options` is as its next words.

    The score is log P(option | messages) - log P(option | neutral), so that an option does not win
    only because it is a common phrase.

    Attributes:
        label: name of the prompt.
        messages: the chat that asks about the thing.
        neutral: the same chat without the thing; if empty, its term is 0.
        options: texts to score.
        places: the places that the options stand for, in the same order.
        precedents: questions with known answers, for models that can tell which are similar.
        kind: parent class of the thing; precedents of the same kind count as slightly more similar.
        place_kinds: class and room of each place, in the same order; empty if not known.
    """

    label: str
    messages: tuple[Message, ...]
    neutral: tuple[Message, ...]
    options: tuple[str, ...]
    places: tuple[str, ...]
    precedents: tuple[Precedent, ...] = ()
    kind: str = ""
    place_kinds: tuple[tuple[str, str], ...] = ()


@dataclass(frozen=True, slots=True)
class Usage:
    """What one call cost, in tokens and in seconds.

    Of the input tokens, `evaluated_tokens` were computed, and the others were cached.
    `prepared_tokens` and `prepared_s` count the preparation between the previous call and this one;
    they are not part of the other figures.
    """

    model: str = ""
    input_tokens: int = 0
    evaluated_tokens: int = 0
    output_tokens: int = 0
    first_token_s: float = 0.0
    total_s: float = 0.0
    prepared_tokens: int = 0
    prepared_s: float = 0.0
    parameters: dict[str, float | int | str] = field(default_factory=dict)
