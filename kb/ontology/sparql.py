"""Answers SPARQL 1.1 queries with owlready2's own engine.

The engine works on an SQLite database in memory that contains only the triples. It has neither
`SERVICE` nor `LOAD`, and it gets only SELECT queries here: it cannot write.
"""

import time
from collections.abc import Callable, Iterable, Iterator
from contextlib import suppress
from typing import Any

import owlready2
from owlready2.base import _universal_datatype_2_abbrev
from owlready2.driver import FLOAT_DATATYPES, INT_DATATYPES
from rdflib import BNode, Literal, URIRef
from rdflib.term import Identifier

from executive.errors import InputError
from executive.text import printable, writable
from kb.ontology.graph import Graph
from kb.ontology.owl import Triple
from kb.ontology.table import Table

RIGHT = "write for example: SELECT ?x WHERE { ?x rdfs:subClassOf household:Fruit }"
LONGEST_S = 20.0
"""Time limit of a query (s)."""
LONGEST_QUERY = 10_000
MOST_NUMBER = 2.0**62
"""Half of the limit of SQLite's integers."""
_BOOLEAN = _universal_datatype_2_abbrev[bool]
_STEPS = 100_000
"""Instructions of SQLite's virtual machine between two checks of the time limit."""


def select(graph: Graph, query: str, prefixes: dict[str, str]) -> Table:
    """Answer a SELECT query; `prefixes` need not be declared in it.

    Raises:
        InputError: if it is not a SELECT that the engine can parse, or takes too long.
    """
    if len(query) > LONGEST_QUERY:
        raise InputError("query", f"is longer than {LONGEST_QUERY} characters", RIGHT)
    declared = " ".join(f"PREFIX {name}: <{iri}>" for name, iri in prefixes.items())
    world = _world(graph.triples())
    began = time.monotonic()

    def late() -> bool:
        return time.monotonic() - began > LONGEST_S

    try:
        prepared = world.prepare_sparql(f"{declared} {query}")
        if not isinstance(prepared, owlready2.sparql.main.PreparedSelectQuery):
            raise InputError("query", "is no SELECT", RIGHT)
        world.graph.db.set_progress_handler(late, _STEPS)
        name_of = _namer(world, graph)
        rows = tuple(tuple(map(name_of, row)) for row in _rows(prepared))
    except InputError:
        raise
    except Exception as error:  # the engine may raise anything
        if late():
            right = "ask for less, or add a LIMIT"
            raise InputError("query", f"takes longer than {LONGEST_S:.0f} s", right) from None
        what = printable(error.args[0] if error.args else type(error).__name__)
        raise InputError("query", f"cannot be read: {what}", RIGHT) from None
    return Table(tuple(name.removeprefix("?") for name in prepared.column_names), rows)


def _world(triples: Iterable[Triple]) -> Any:
    """The triples in a database of owlready2, without creating Python classes for them."""
    world = owlready2.World()
    put_links, put_values, *_, finish = world.get_ontology(
        "http://robot-executive.org/all.owl#"
    ).graph.import_triples_from_queue(None, "", False)
    links, values = [], []
    for subject, relation, of in triples:
        if isinstance(of, Literal):
            values.append((_key(subject), str(relation), *_value(of)))
        else:
            links.append((_key(subject), str(relation), _key(of)))
    put_links(links)
    put_values(values)
    finish()
    return world


def _key(entity: Identifier) -> str:
    return f"_:{entity}" if isinstance(entity, BNode) else writable(entity)


def _value(literal: Literal) -> tuple[str | int | float, str]:
    """A literal as the engine stores it (a number if SQLite can store it), and its datatype."""
    text = writable(literal)
    if literal.language:
        return text, f"@{literal.language}"
    for types, number in ((INT_DATATYPES, int), (FLOAT_DATATYPES, float)):
        if str(literal.datatype) in types:
            with suppress(ValueError):
                if abs(value := number(text)) < MOST_NUMBER:
                    return value, str(literal.datatype)
    return text, str(literal.datatype or "")


def _rows(prepared: Any) -> Iterator[Iterator[tuple[Any, Any]]]:
    """Each row as values with their datatypes; "o" marks an entity, stored as a number."""
    for raw in prepared.execute_raw():
        cells = iter(zip(prepared.column_types, raw, strict=False))
        yield ((cell, "o" if kind == "objs" else next(cells)[1]) for kind, cell in cells)


def _namer(world: Any, graph: Graph) -> Callable[[tuple[Any, Any]], str | int | float | bool]:
    def name_of(cell: tuple[Any, Any]) -> str | int | float | bool:
        value, kind = cell
        if value is None:
            return "None"
        if kind == "o":
            iri = world._unabbreviate(value) if value > 0 else "nameless"
            entity = URIRef(iri)
            return graph.label(entity) if graph.is_declared(entity) else iri
        if kind == _BOOLEAN:
            return value in ("true", "1", 1)
        return value if isinstance(value, int | float) else str(value)

    return name_of
