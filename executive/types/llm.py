"""What a language model is asked, and what a call cost."""

from dataclasses import dataclass, field
from typing import Any


@dataclass(frozen=True, slots=True)
class Message:
    """One turn of a chat: role is `system`, `user` or `assistant`."""

    role: str
    content: str


@dataclass(frozen=True, slots=True)
class ChatRequest:
    """Ask the language model to write.

    `label` names the prompt (the paper's labels); `schema` is the JSON schema that the reply should
    follow, for models that can be held to one.
    """

    label: str
    messages: tuple[Message, ...]
    schema: dict[str, Any] | None = None


@dataclass(frozen=True, slots=True)
class Precedent:
    """A thing whose places are known: the question about it, and the right answers to that.

    `kind` is the class above it in the ontology; empty if there is none.
    """

    messages: tuple[Message, ...]
    places: tuple[str, ...]
    kind: str = ""


@dataclass(frozen=True, slots=True)
class RankRequest:
    """Ask the language model how likely each of `options` is as its next words.

    What counts is log P(option | messages) - log P(option | neutral): `neutral` is the same chat
    with the thing left open, so that what is merely a common phrase does not win; empty, it counts
    for nothing. `places` are the places that the options stand for, in the same order, and
    `place_kinds` their classes and rooms (empty: not known). A model that can tell which questions
    are alike takes the `precedents` into account; so are, a little, those about things of the same
    `kind`.
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
    """What one call cost: tokens in (of them evaluated, the rest cached), tokens out, seconds.

    What was prepared for it, before it was asked and since the call before, is counted apart.
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
