"""Knowledge sources of others: their validation, and their answers in recordings and replays."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import TypeVar

from pydantic import TypeAdapter, ValidationError

from executive.belief import ANYWHERE, PLAN, Statement
from executive.errors import InputError
from executive.guards import in_words
from executive.interfaces.knowledge import PlaceSource
from executive.records import Recalled, SourceAnswer
from executive.text import printable
from executive.types.knowledge import Source

T = TypeVar("T")

TAKEN = frozenset({*Source, ANYWHERE, PLAN, "person", "eyes"})
"""Names that logs and outcomes already use."""
RIGHT = "a source has a name, a clause that says who says so, and places_of (docs/knowledge.md)"

# --- given ---


def checked(sources: object) -> tuple[PlaceSource, ...]:
    """Validate the sources that a session is given.

    Raises:
        InputError: if it is not a list of sources, or a name is taken or occurs twice.
    """
    if isinstance(sources, str | bytes | Mapping) or not isinstance(sources, Iterable):
        what = f"one {type(sources).__name__} is no list"
        raise InputError("sources", what, "give a list, of one source too: sources=[source]")
    given = tuple(sources)
    names: set[str] = set()
    for number, source in enumerate(given):
        where = f"sources[{number}]"
        name = _name_of(where, source)
        if name in names:
            what = f"another one is called {name!r}, too"
            raise InputError(where, what, "give each a name of its own")
        names.add(name)
    return given


def _name_of(where: str, source: object) -> str:
    """Validate one source; return its name."""
    if isinstance(source, type):
        what = f"is the class {source.__name__}, and no source"
        raise InputError(where, what, f"call it: {source.__name__}(...)")
    name, says, asked = (_attribute(where, source, a) for a in ("name", "says", "places_of"))
    if not (isinstance(name, str) and name.isidentifier()):
        right = "use a word of letters, digits and _, such as calendar"
        raise InputError(where, f"its name {name!r} is no word", right)
    if name in TAKEN:
        what = f"its name {name!r} is taken: logs and outcomes would not tell the two apart"
        raise InputError(where, what, f"use another one than {', '.join(sorted(TAKEN))}")
    if not (isinstance(says, str) and says.strip()):
        right = 'write who says so, such as "your calendar says so"'
        raise InputError(where, f"its says {says!r} is no clause", right)
    if not callable(asked):
        raise InputError(where, "its places_of cannot be called", RIGHT)
    return str(name)


def _attribute(where: str, source: object, name: str) -> object:
    try:
        return getattr(source, name)
    except AttributeError:
        raise InputError(where, f"{type(source).__name__} has no {name}", RIGHT) from None
    except Exception as error:
        raise InputError(where, f"its {name} cannot be read: {in_words(error)}", RIGHT) from None


# --- recorded ---


@dataclass(frozen=True, slots=True)
class Written:
    """A source in `sources.json`.

    Only earlier recordings have `places`, the answer about each thing. Later ones have a record for
    each answer.
    """

    name: str
    says: str
    places: Mapping[str, tuple[str, ...]] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class RecordedSource:
    """Implements `PlaceSource` with the answers of a recorded mission, in order.

    The last answer about a thing is repeated.
    """

    name: str
    says: str
    answers: Mapping[str, list[tuple[str, ...]]]

    def places_of(self, name: str) -> tuple[str, ...]:
        """The next recorded answer about a thing."""
        return _next(self.answers, name)


class RecordedExperience:
    """Implements `Experience` with the answers of a recorded mission, in order.

    The last answer about a thing is repeated.
    """

    def __init__(self, answers: Iterable[Recalled]) -> None:
        """Use these answers."""
        self._told: dict[str, list[tuple[Statement, ...]]] = {}
        for answer in answers:
            self._told.setdefault(answer.thing, []).append(statements_of(answer))

    def learn(self) -> None:
        """Do nothing."""

    def recalled(self, name: str) -> tuple[Statement, ...]:
        """The next recorded answer about a thing."""
        return _next(self._told, name)


def _next(answers: Mapping[str, list[tuple[T, ...]]], thing: str) -> tuple[T, ...]:
    """The next answer about a thing; the last one is repeated. Empty if there is none."""
    left = answers.get(thing, [()])
    return left.pop(0) if len(left) > 1 else left[0]


def statements_of(answer: Recalled) -> tuple[Statement, ...]:
    """The statements in a record."""
    each = tuple(zip(answer.says, answer.places, answer.weights, strict=False))
    return tuple(
        Statement(source, tuple((p, w) for who, p, w in each if who == source), trust)
        for source, trust in zip(answer.sources, answer.trusts, strict=False)
    )


_FILE = TypeAdapter(tuple[Written, ...])


def written(sources: Iterable[PlaceSource]) -> bytes:
    """Names and clauses of the sources, as JSON for a recording; no source is asked anything."""
    named = tuple(Written(printable(source.name), printable(source.says)) for source in sources)
    return _FILE.dump_json(named, exclude_defaults=True)


def read(
    file: str, text: bytes, answers: Iterable[SourceAnswer] = ()
) -> tuple[RecordedSource, ...]:
    """Read the sources of a recording, with their recorded answers.

    Raises:
        InputError: if `text` is malformed; `file` names it in the message.
    """
    try:
        sources = _FILE.validate_json(text)
    except ValidationError as error:
        fault = error.errors()[0]
        what = f"its sources.json does not say what is where: {fault['msg']}"
        raise InputError(file, what) from error
    given = tuple(answers)
    return tuple(_recorded(source, given) for source in sources)


def _recorded(source: Written, answers: Iterable[SourceAnswer]) -> RecordedSource:
    told = {thing: [places] for thing, places in source.places.items()}
    for answer in answers:
        if answer.source == source.name:
            told.setdefault(answer.thing, []).append(answer.places)
    return RecordedSource(source.name, source.says, told)
