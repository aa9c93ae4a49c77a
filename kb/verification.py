"""Reading a language model's reply, and holding what it names against what exists.

The paper's output parser and existence check. Pure functions.
"""

import json
from collections.abc import Iterator, Sequence
from typing import Any

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from executive.text import writable
from executive.types import Verdict
from kb.names import PlaceNames, unique

MOST_CHARACTERS = 10_000
"""Of a reply, counted from its end: looking through more could take seconds."""


class Reply(BaseModel):
    """The output format: a list of places."""

    model_config = ConfigDict(strict=True)

    places: list[str] = Field(description="names of furniture or rooms, likeliest first")


def schema(places: Sequence[str], most: int) -> dict[str, Any]:
    """JSON schema of a reply that can name only these places, at most so many.

    For a model that can be held to a schema; what it writes is verified all the same.
    """
    held = Reply.model_json_schema()
    held["properties"]["places"] |= {
        "items": {"type": "string", "enum": list(places)},
        "minItems": 1,
        "maxItems": most,
    }
    return held


def read(reply: str) -> tuple[str, ...] | None:
    """The names in a reply, or None if no JSON object in it has the output format.

    Text and code fences around the object do no harm. Never raises.
    """
    for value in json_objects(reply):
        try:
            return tuple(writable(name).strip() for name in Reply.model_validate(value).places)
        except ValidationError:
            continue
    return None


def verify(names: Sequence[str], known: PlaceNames, among: Sequence[str] = ()) -> Verdict:
    """Which of the names are furniture, which are rooms, and which are nothing here.

    A name has to fit one piece of furniture or one room with all its words; it may be written as
    people write it ("the kitchen cabinet"). With `among`, other furniture, and rooms that hold
    none of it, are dropped as well.
    """
    furniture: list[str] = []
    rooms: list[str] = []
    dropped: list[str] = []
    allowed_rooms = known.rooms_of(among) if among else ()
    for name in names:
        found = known.exactly(name)
        if found.furniture and (not among or found.furniture[0] in among):
            furniture.append(found.furniture[0])
        elif found.rooms and (not among or found.rooms[0] in allowed_rooms):
            rooms.append(found.rooms[0])
        else:
            dropped.append(name)
    return Verdict(unique(furniture), unique(rooms), unique(dropped))


def json_objects(text: str) -> Iterator[object]:
    """What can be read as JSON from each opening brace on. Never raises, and never takes long."""
    text = text[-MOST_CHARACTERS:]
    decoder = json.JSONDecoder()
    start = text.find("{")
    while start >= 0:
        try:
            value, _ = decoder.raw_decode(text, start)
            yield value
        except ValueError:
            pass
        except RecursionError:
            return
        start = text.find("{", start + 1)
