"""Questions to the ontology in SPARQL 1.1, answered by owlready2's own engine."""

from dataclasses import dataclass
from typing import Any

import owlready2
from owlready2.rply import LexingError, ParsingError

from executive.errors import InputError
from kb.owl import label

RIGHT = "write for example: SELECT ?x WHERE { ?x rdfs:subClassOf household:Fruit }"


@dataclass(frozen=True, slots=True)
class Table:
    """An answer: entities are given by what they are called, values as they are."""

    columns: tuple[str, ...]
    rows: tuple[tuple[str | int | float | bool, ...], ...]


def select(world: owlready2.World, query: str, prefixes: dict[str, str]) -> Table:
    """Answer a SELECT; `prefixes` need not be declared in it.

    Raises:
        InputError: if it is no SELECT that the engine understands.
    """
    declared = " ".join(f"PREFIX {name}: <{iri}>" for name, iri in prefixes.items())
    try:
        prepared = world.prepare_sparql(f"{declared} {query}")
        if not isinstance(prepared, owlready2.sparql.main.PreparedSelectQuery):
            raise InputError("query", "is no SELECT", RIGHT)
        rows = tuple(tuple(map(_plain, row)) for row in prepared.execute())
    except (LexingError, ParsingError, ValueError, NotImplementedError) as error:
        raise InputError("query", f"cannot be read: {error.args[0]}", RIGHT) from None
    return Table(tuple(name.removeprefix("?") for name in prepared.column_names), rows)


def _plain(value: Any) -> str | int | float | bool:
    if isinstance(value, str | int | float | bool):
        return value
    return label(value) if hasattr(value, "iri") else str(value)
