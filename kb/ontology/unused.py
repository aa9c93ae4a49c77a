"""Finds statements of an ontology that the robot does not use."""

from collections import Counter
from collections.abc import Iterator

from rdflib import OWL, RDF, RDFS, BNode, URIRef
from rdflib.term import Identifier

from kb.ontology.graph import Graph
from kb.ontology.owl import OWLREADY, ending
from kb.ontology.properties import PROPERTIES

ROOT = "Object"
"""The class of all objects."""
MOST_EXAMPLES = 3
_FILLERS: dict[Identifier, str] = {
    OWL.someValuesFrom: "some",
    OWL.allValuesFrom: "only",
    OWL.onClass: "so many",
    OWL.cardinality: "so many",
    OWL.minCardinality: "at least",
    OWL.maxCardinality: "at most",
    OWL.hasSelf: "self",
}
_CONSTRUCTS: dict[Identifier, str] = {
    OWL.unionOf: "unions",
    OWL.complementOf: "complements",
    OWL.oneOf: "enumerations",
    OWL.propertyChainAxiom: "chains of properties",
    OWL.hasKey: "keys",
    OWL.disjointWith: "disjoint classes",
    OWL.members: "lists of what is disjoint or different",
    OWL.sameAs: "individuals that are the same",
}


def unused(graph: Graph, namespace: str) -> Iterator[str]:
    """Sentences about what is not used, with what would be; the last one sums up all the rest.

    Args:
        graph: the triples of the loaded files.
        namespace: the IRI prefix of the properties that the robot uses.
    """
    ours = [URIRef(namespace + name) for name in ("hasDefaultLocation", "preferredBy")]
    yield from _restrictions(graph, ours)
    yield from _equivalents(graph)
    for entity in graph.subjects():
        if any(
            str(value).lower() in ("true", "1") for value in graph.objects(entity, OWL.deprecated)
        ):
            yield f"{ending(entity)} is deprecated, and used all the same: take it out of the file"
    yield from _renamed(graph)
    yield from _nameless(graph, namespace)
    yield from _looks(graph, namespace)
    if rest := _rest(graph, ours):
        only = "classes, their names, default locations, rooms, favourites, looks and uses are"
        yield f"not used (only {only}): {rest}"


def _restrictions(graph: Graph, ours: list[URIRef]) -> Iterator[str]:
    """Default locations and preferences that are not `hasValue` restrictions."""
    for kind in graph.subjects():
        for part in graph.parts(kind) if isinstance(kind, URIRef) else ():
            for relation in graph.objects(part, OWL.onProperty):
                if relation in ours and not graph.objects(part, OWL.hasValue):
                    what = f"{ending(kind)} {ending(relation)} {_filler(graph, part)}"
                    yield f"{what} is not used: write owl:hasValue and one individual"


def _filler(graph: Graph, restriction: Identifier) -> str:
    for relation, word in _FILLERS.items():
        for value in graph.objects(restriction, relation):
            return f"{word} {ending(value)}"
    return "without a value"


def _equivalents(graph: Graph) -> Iterator[str]:
    for kind in graph.subjects():
        for same in graph.objects(kind, OWL.equivalentClass):
            named = isinstance(kind, URIRef) and isinstance(same, URIRef)
            if named and same != OWL.Nothing:
                right = "keep one of the two, and give it the other's name as skos:altLabel"
                yield f"{ending(kind)} is equivalent to {ending(same)}, which is not used: {right}"


def _renamed(graph: Graph) -> Iterator[str]:
    used = {p for _, p, _ in graph.triples() if p.startswith(OWLREADY)}
    for relation in sorted(used):
        yield f"{ending(relation)} is an annotation for programs in Python, and not used"


def _nameless(graph: Graph, namespace: str) -> Iterator[str]:
    """Anonymous classes of objects."""
    things = set(graph.downwards(URIRef(namespace + ROOT)))
    for subject in graph.subjects():
        above = graph.objects(subject, RDFS.subClassOf) if isinstance(subject, BNode) else ()
        if kind := next((one for one in above if one in things), None):
            right = "give it a name of its own (rdf:about)"
            yield f"a class below {ending(kind)} has no name, and is not used: {right}"


def _looks(graph: Graph, namespace: str) -> Iterator[str]:
    """Colours, shapes and uses of what is not an object."""
    things = set(graph.downwards(URIRef(namespace + ROOT)))
    for subject in graph.subjects():
        for name in PROPERTIES:
            if subject not in things and graph.objects(subject, URIRef(namespace + name)):
                yield f"{ending(subject)} has a {name}, which is used of classes of objects only"


def _rest(graph: Graph, ours: list[URIRef]) -> str:
    """The numbers of all other constructs."""
    counted, foreign = Counter[str](), Counter[str]()
    for _, relation, of in graph.triples():
        if relation in _CONSTRUCTS:
            counted[_CONSTRUCTS[relation]] += 1
        if relation == OWL.onProperty and of not in ours:
            foreign[ending(of)] += 1
        if relation == RDF.type and of == OWL.DatatypeProperty:
            counted["datatype properties"] += 1
    told = [f"{count} {what}" for what, count in counted.items()]
    if foreign:
        names = ", ".join(name for name, _ in foreign.most_common(MOST_EXAMPLES))
        told.insert(0, f"{foreign.total()} restrictions ({names}{', ...' * (len(foreign) > 3)})")
    return ", ".join(told)
