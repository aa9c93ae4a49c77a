"""Adds the objects that a home declares, unless a file has them already."""

from collections.abc import Iterator

from rdflib import URIRef
from rdflib.term import Identifier

from executive.errors import InputError
from executive.language.phrases import words_of
from kb.ontology.graph import Graph
from kb.ontology.owl import ending
from kb.ontology.validation import ROOTS


def put_thing(
    graph: Graph, name: str, kind: Identifier, iri: URIRef, namespace: str, where: str
) -> bool:
    """Add an object below its class; False if a file already has it under this name.

    Args:
        graph: the ontology.
        name: name of the object.
        kind: its class, which is below `Object`.
        iri: IRI of the new object.
        namespace: the IRI prefix of our classes; those without subclasses are objects.
        where: the location in error messages.

    Raises:
        InputError: if the name has no word, or something else has it, or if the class is an object
            itself.
    """
    objects = graph.leaves(URIRef(namespace + ROOTS[0]))
    if not words_of(name) or graph.is_declared(iri):
        raise InputError(where, "this is no name of a thing", "give another name")
    for other in _called(graph, name, namespace):
        label = graph.label(other)
        is_one = other in objects and kind in graph.upwards(other)
        is_it = is_one and words_of(label) == words_of(name)
        if is_it and label == name:
            return False
        right = f"call it {label!r} if it is that one" if is_it else "give another name"
        raise InputError(where, f"the ontology has a {label} of this name", right)
    above = list(graph.upwards(kind))[1:]
    if above and kind.startswith(namespace) and kind in objects:
        what = f"is a {ending(kind)}, which is an object itself"
        raise InputError(where, what, f"name the class above it, as {ending(above[0])}")
    graph.put_class(iri, kind, name)
    return True


def _called(graph: Graph, name: str, namespace: str) -> Iterator[Identifier]:
    """Every class with this name, or with one that is the same when joined to one word."""
    words = "".join(words_of(name))
    for root in ROOTS:
        for kind in graph.downwards(URIRef(namespace + root)):
            if words in ("".join(words_of(called)) for called in graph.names(kind)):
                yield kind
