"""Parses a language model's reply, and checks its names against the ontology.

The paper's output parser and existence check. Pure functions.
"""

import json
import re
from collections.abc import Iterator, Sequence
from operator import itemgetter
from typing import Any

from pydantic import BaseModel, ConfigDict, Field

from executive.text import writable
from executive.types.home import Place
from executive.types.knowledge import Verdict
from kb.advice.lenient import Bare, values
from kb.ontology.names import PlaceNames, unique

MOST_CHARACTERS = 10_000
"""Only so many characters at the end of a reply are parsed; more could take seconds."""
_OBJECT = re.compile(r"\{(?=\s*[\"}])")
_BULLET = re.compile(r"^(?:\d{1,2}[.):]|[-*•–])\s+")
_LISTED = re.compile(r"(?:\d{1,2}[.):]|[-*•–])\s+(\S.*)")
"""A line of a list without brackets."""
_MARKUP = "*_`\"',; "
_BETWEEN = re.compile(r"[,;\n]")
NAME_KEYS = ("name", "place", "furniture", "location", "room")
"""Keys of the name, if a model gives more than the name of a place."""


class Reply(BaseModel):
    """The output format: a list of places."""

    model_config = ConfigDict(strict=True)

    places: list[str] = Field(description="names of furniture or rooms, likeliest first")


def schema(places: Sequence[str], most: int) -> dict[str, Any]:
    """JSON schema of a reply with one to `most` of these places, and no others.

    For models that support a schema; the reply is verified in any case.
    """
    held = Reply.model_json_schema()
    held["properties"]["places"] |= {
        "items": {"type": "string", "enum": list(places)},
        "minItems": 1,
        "maxItems": most,
    }
    return held


def read(reply: str) -> tuple[str, ...] | None:
    """The names in a reply; None if nothing in it resembles the output format. Never raises.

    The last answer counts: a model that reasons in its reply, or corrects itself, ends with its
    result. An object with `places` takes precedence over a bare list or an object with one place.
    Each place is a string, or an object with the string as its name. Without any brackets, a reply
    that is only a numbered or bulleted list is accepted.
    """
    loose = None
    for value in last_first(reply):
        names = _places(value)
        if names is not None and not _is_placeholder(names):
            return _without_bullets(names)
        loose = loose or _loose_names(value)
    loose = loose or _lines(reply)
    return _without_bullets(loose) if loose else None


def _lines(reply: str) -> list[str] | None:
    """The names in a reply that consists only of list items, one on each line."""
    lines = (line.strip() for line in reply[-MOST_CHARACTERS:].split("\n"))
    found = [_LISTED.fullmatch(line) for line in lines if line and not line.startswith("```")]
    names = [line[1].strip(_MARKUP) for line in found if line]
    return names if len(names) == len(found) and all(names) else None


def _is_placeholder(names: list[str]) -> bool:
    """Whether it only shows the format of an answer, as in `["...", "..."]`."""
    return bool(names) and not any(map(str.isalnum, "".join(names)))


def _without_bullets(names: list[str]) -> tuple[str, ...]:
    """The names without list numbers and bullets."""
    return tuple(_BULLET.sub("", writable(name).strip()) for name in names)


def _places(value: object) -> list[str] | None:
    """The names under `places`; None if there are none, or if anything else is among them."""
    if not isinstance(value, dict):
        return None
    for key, named in value.items():
        if key.strip().lower() == "places":
            return _listed(named)
    return None


def _listed(named: object) -> list[str] | None:
    """The names in what is given as places; None if there are none.

    It is a list, a text with commas, one name in an object, names by numbers ("1": "desk"), or
    probabilities by names.
    """
    if isinstance(named, list):
        return _names(named)
    if isinstance(named, str):
        return [part for part in _BETWEEN.split(named) if part.strip()]
    if not isinstance(named, dict) or _name(named):
        return _name(named)
    if all(key.strip().isdecimal() for key in named):
        return _names(list(named.values()))
    return None if any(map(_is_no_probability, named.values())) else list(named)


def _is_no_probability(value: object) -> bool:
    """Whether the value is neither a number nor null."""
    return value is not None and not isinstance(value, int | float)


def _loose_names(value: object) -> list[str] | None:
    """The names in a bare list, or the name of an object; a list of bare words is prose."""
    if not isinstance(value, list):
        return _name(value)
    return None if any(isinstance(part, Bare) for part in value) else _names(value)


def _names(parts: list[object]) -> list[str] | None:
    """One name for each part; None if a part has no name, or if all are null.

    Null is ignored; `lenient` also gives it for numbers.
    """
    named = [_rated(part) or _name(part) for part in parts if part is not None]
    if parts and not named:
        return None
    names = [name for some in named if some for name in some]
    return names if len(names) == len(named) else None


def _rated(part: object) -> list[str] | None:
    """The name in a pair of name and probability; None if it is no such pair."""
    if isinstance(part, dict) and not any(key.strip().lower() in NAME_KEYS for key in part):
        part = [value for pair in part.items() for value in pair]
    if not isinstance(part, list) or len(part) != 2 or _is_no_probability(part[1]):
        return None
    return _name(part[0])


def _name(part: object) -> list[str] | None:
    """The name in this part, as a list; None if there is none."""
    if isinstance(part, dict):
        lower = {key.strip().lower(): value for key, value in part.items()}
        part = next((lower[key] for key in NAME_KEYS if key in lower), None)
    return [part] if isinstance(part, str) else None


def allowed(places: Sequence[Place], among: Sequence[str]) -> tuple[Place, ...]:
    """The places that may be named: those in `among`, or all if it is empty."""
    return tuple(place for place in places if not among or place.name in among)


def verify(names: Sequence[str], known: PlaceNames, among: Sequence[str] = ()) -> Verdict:
    """Sort the names into furniture, rooms, and names that are unknown here.

    All words of a name must match one piece of furniture or one room; variants as people write
    them are accepted ("the kitchen cabinet"). With `among`, other furniture is dropped, and so are
    rooms that contain none of it.
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


def last_first(reply: str) -> list[object]:
    """The objects and lists at the end of a reply, last first, outer ones before inner ones.

    Strict JSON is found whatever precedes it; everything else is parsed by `lenient`. If nothing
    is found, quotes may be escaped, as in a web page or in JSON within JSON. Never raises, and
    takes bounded time.
    """
    text = reply[-MOST_CHARACTERS:]
    plain = text.replace("&quot;", '"').replace('\\"', '"')
    found = [*_strictly(text), *values(text)] or [*_strictly(plain), *values(plain)]
    return [value for _, value in sorted(found, key=itemgetter(0), reverse=True)]


def _strictly(text: str) -> Iterator[tuple[int, object]]:
    """The strict JSON value at each opening brace, with its end position."""
    decoder = json.JSONDecoder()
    for begins in _OBJECT.finditer(text):
        try:
            value, end = decoder.raw_decode(text, begins.start())
        except ValueError:
            continue
        except RecursionError:
            return
        yield end, value
