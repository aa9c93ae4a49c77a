"""Knowledge sources as a recording keeps them, so that a replay is told what the mission was."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from pydantic import TypeAdapter, ValidationError

from executive.errors import InputError
from executive.interfaces import PlaceSource


@dataclass(frozen=True, slots=True)
class WrittenSource:
    """Implements `PlaceSource`: each thing, and the places that another source named for it."""

    name: str
    says: str
    places: Mapping[str, tuple[str, ...]]

    def places_of(self, name: str) -> tuple[str, ...]:
        """What was written down."""
        return self.places.get(name, ())


_FILE = TypeAdapter(tuple[WrittenSource, ...])


def written(sources: Iterable[PlaceSource], things: Iterable[str]) -> bytes:
    """What the sources know of these things now, as JSON."""
    names = tuple(things)

    def known(source: PlaceSource) -> WrittenSource:
        places = {name: source.places_of(name) for name in names}
        return WrittenSource(source.name, source.says, places)

    return _FILE.dump_json(tuple(map(known, sources)))


def read(file: str, text: bytes) -> tuple[WrittenSource, ...]:
    """What was written.

    Raises:
        InputError: if it is something else; `file` says what was read.
    """
    try:
        return _FILE.validate_json(text)
    except ValidationError as error:
        fault = error.errors()[0]
        what = f"its sources.json does not say what is where: {fault['msg']}"
        raise InputError(file, what) from error
