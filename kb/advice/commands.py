"""Having the language model read what the grammar of commands cannot.

It may only choose: one of the kinds of command, and of the objects that exist. What comes of it is
put to the person before anything is done.
"""

from collections.abc import Sequence
from typing import Any

from pydantic import BaseModel, ConfigDict, ValidationError, field_validator

from executive.types import SEARCHING, ChatRequest, CommandKind, RankRequest, Scored
from kb.advice.prompts import Understanding
from kb.advice.verification import last_first


class Asked(BaseModel):
    """The output format: what to do, and with what."""

    model_config = ConfigDict(frozen=True)

    kind: CommandKind
    object: str

    @field_validator("kind", mode="before")
    @classmethod
    def _in_any_case(cls, kind: Any) -> Any:
        return kind.strip().lower() if isinstance(kind, str) else kind


def schema(objects: Sequence[str]) -> dict[str, Any]:
    """JSON schema of a reply that can name only these objects."""
    return {
        "type": "object",
        "properties": {
            "kind": {"type": "string", "enum": [str(kind) for kind in SEARCHING]},
            "object": {"type": "string", "enum": list(objects)},
        },
        "required": ["kind", "object"],
    }


def read(reply: str) -> Asked | None:
    """What the reply says last, or None if nothing in it has the output format. Never raises."""
    for value in last_first(reply):
        try:
            asked = Asked.model_validate(value)
        except ValidationError:
            continue
        if asked.kind in SEARCHING:
            return asked
    return None


def rank_request(words: str, texts: Understanding) -> RankRequest:
    """Ask how likely each kind of command is."""
    return RankRequest(
        label="command",
        messages=texts.chat(words),
        neutral=texts.chat(texts.neutral),
        options=tuple(texts.answers[kind] for kind in SEARCHING),
        places=SEARCHING,
    )


def chat_request(words: str, objects: Sequence[str], texts: Understanding) -> ChatRequest:
    """Ask what to do with what, as JSON."""
    held = schema(objects)
    return ChatRequest("command", texts.inquiry(words, objects, held), held)


def likeliest(scored: Scored) -> CommandKind:
    """The kind with the highest score; the first of equals."""
    best = max(range(len(scored.scores)), key=scored.scores.__getitem__)
    return CommandKind(scored.request.places[best])
