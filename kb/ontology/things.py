"""Objects that a home declares, put below their classes where no file has them."""

from collections.abc import Iterator

from rdflib import URIRef
from rdflib.term import Identifier

from executive.errors import InputError
from executive.language.phrases import words_of
from executive.text import printable
from kb.ontology.graph import Graph
from kb.ontology.owl import ending
from kb.ontology.validation import ROOTS


def put_thing(graph: Graph, name: str, kind: Identifier, iri: URIRef, namespace: str) -> bool:
    """Put an object right below its class; false if a file has it already, by this name.

    Args:
        graph: what is known.
        name: of the object.
        kind: its class, which is below `Object`.
        iri: what the object becomes.
        namespace: of the household's own classes; those without any below are objects.

    Raises:
        InputError: if something else is called so, or its class is an object itself.
    """
    where = f"object {printable(name)}"
    objects = graph.leaves(URIRef(namespace + ROOTS[0]))
    if not words_of(name) or graph.is_declared(iri):
        raise InputError(where, "this is no name of a thing", "give another name")
    for other in _called(graph, name, namespace):
        if other in objects and graph.label(other) == name and kind in graph.upwards(other):
            return False
        what = f"the ontology has a {graph.label(other)} of this name"
        raise InputError(where, what, "give another name")
    above = list(graph.upwards(kind))[1:]
    if above and kind.startswith(namespace) and kind in objects:
        what = f"is a {ending(kind)}, which is an object itself"
        raise InputError(where, what, f"name the class above it, as {ending(above[0])}")
    graph.put_class(iri, kind, name)
    return True


def _called(graph: Graph, name: str, namespace: str) -> Iterator[Identifier]:
    """Every class that has this name, or one that is not kept apart from it."""
    words = "".join(words_of(name))
    for root in ROOTS:
        for kind in graph.downwards(URIRef(namespace + root)):
            if words in ("".join(words_of(called)) for called in graph.names(kind)):
                yield kind
