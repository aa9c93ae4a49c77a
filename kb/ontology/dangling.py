"""Dangling links: names that a file uses and that no file declares."""

from collections.abc import Iterator
from dataclasses import dataclass

from rapidfuzz import process
from rdflib import OWL, RDF, RDFS, BNode, URIRef
from rdflib.term import Identifier

from executive.text import printable
from kb.ontology.graph import STANDARDS, Graph
from kb.ontology.owl import ending

LEAST_LIKENESS = 75.0
"""Minimum likeness (0 to 100, rapidfuzz) of a name and its misspelling."""
MOST_COMPARED = 100
"""The right spelling is searched for only so many dangling links, as that takes time."""

_LINKS = frozenset(
    (RDF.type, RDF.first, RDFS.subClassOf, RDFS.subPropertyOf, RDFS.domain, RDFS.range)
    + (OWL.equivalentClass, OWL.disjointWith, OWL.complementOf, OWL.equivalentProperty)
    + (OWL.onProperty, OWL.onClass, OWL.hasValue, OWL.someValuesFrom, OWL.allValuesFrom)
    + (OWL.inverseOf, OWL.sameAs, OWL.differentFrom, OWL.annotatedSource, OWL.annotatedProperty)
    + (OWL.sourceIndividual, OWL.targetIndividual, OWL.assertionProperty)
)
"""Properties of OWL itself whose values are entities."""
_LISTS = frozenset(
    (OWL.intersectionOf, OWL.unionOf, OWL.oneOf, OWL.disjointUnionOf, OWL.hasKey)
    + (OWL.propertyChainAxiom, OWL.members, OWL.distinctMembers, OWL.onProperties)
)
"""Properties of OWL itself whose values are lists of entities."""
_FILLERS = frozenset((OWL.hasValue, OWL.someValuesFrom, OWL.allValuesFrom, OWL.onClass))
_INSIDE_LISTS = frozenset((RDF.first, RDF.rest))


@dataclass(frozen=True, slots=True)
class Link:
    """A dangling link: `subject` has `relation` to an entity that no file declares."""

    subject: Identifier
    of: str
    relation: str
    to: str
    nearest: str | None

    def __str__(self) -> str:
        """The fault, and what would be right."""
        right = f"write {self.nearest}, or declare it" if self.nearest else "declare it"
        return f"{self.of} {self.relation} {self.to}, which no file declares: {right}"


def broken_lists(graph: Graph) -> Iterator[str]:
    """Lists with a part that has no member or no successor, and lists that are circular."""
    walked = set[Identifier]()
    for subject, relation, items in graph.triples():
        walks = relation in _LISTS and isinstance(items, BNode)
        if walks and (fault := _list_fault(graph, items, walked)):
            right = "give each part rdf:first and rdf:rest, the last one rdf:nil"
            yield f"{_title(graph, subject)} {ending(relation)} a list {fault}: {right}"


def _list_fault(graph: Graph, part: Identifier, walked: set[Identifier]) -> str | None:
    """What is wrong with a list; None if nothing is, or if it was checked before."""
    here = set[Identifier]()
    while part != RDF.nil and part not in walked:
        here.add(part)
        walked.add(part)
        rest = graph.objects(part, RDF.rest)
        if not graph.objects(part, RDF.first):
            return "that has a part without rdf:first"
        if not rest:
            return "that has a part without rdf:rest"
        part = rest[0]
    return "that comes back to itself" if part in here else None


def dangling(graph: Graph, *, strict: bool) -> Iterator[Link]:
    """Every dangling link.

    Args:
        graph: the triples of the loaded files.
        strict: whether this includes names in namespaces in which nothing is declared.
    """
    declared = [
        one for one in graph.subjects() if isinstance(one, URIRef) and graph.is_declared(one)
    ]
    spaces = {_space(one) for one in declared}
    by_name = {ending(one): one for one in reversed(declared)}
    known = list(by_name)
    around = {of: (s, p) for s, p, of in graph.triples() if isinstance(of, BNode)}
    compared = 0
    for subject, relation, of in graph.triples():
        for end in _missing(graph, spaces, strict, subject, relation, of):
            nearest = None
            if (compared := compared + 1) <= MOST_COMPARED:
                nearest = process.extractOne(ending(end), known, score_cutoff=LEAST_LIKENESS)
            owner, by = _owner(graph, around, subject, relation)
            how = "uses" if end is relation else ending(by)
            to, right = ending(end), nearest and nearest[0]
            if to == right:  # it is the rest of the IRI that is amiss
                to, right = printable(end), printable(by_name[right])
            yield Link(owner, _title(graph, owner), how, to, right)


def _missing(
    graph: Graph,
    spaces: set[str],
    strict: bool,
    subject: Identifier,
    relation: Identifier,
    of: Identifier,
) -> Iterator[Identifier]:
    """The relation, its value, or both, if they should be declared by a file but are not."""
    if _is_missing(graph, relation) and _space(relation) in spaces:
        yield relation
    if relation == OWL.annotatedTarget:
        links = any(_is_link(graph, by) for by in graph.objects(subject, OWL.annotatedProperty))
    elif relation in _LISTS:
        links = not graph.objects(of, RDF.first)
    else:
        links = _is_link(graph, relation)
    if links and _is_missing(graph, of) and (strict or _space(of) in spaces):
        yield of


def _is_link(graph: Graph, relation: Identifier) -> bool:
    """Whether the values of this relation are entities."""
    return relation in _LINKS or OWL.ObjectProperty in graph.objects(relation, RDF.type)


def _is_missing(graph: Graph, entity: Identifier) -> bool:
    return (
        isinstance(entity, URIRef)
        and not entity.startswith(STANDARDS)
        and not graph.is_declared(entity)
    )


def _owner(
    graph: Graph,
    around: dict[BNode, tuple[Identifier, Identifier]],
    subject: Identifier,
    relation: Identifier,
) -> tuple[Identifier, Identifier]:
    """The named owner of a blank node, and the relation to show in the message."""
    if relation in _FILLERS:
        relation = next(iter(graph.objects(subject, OWL.onProperty)), relation)
    seen = set[Identifier]()
    while isinstance(subject, BNode) and subject in around and subject not in seen:
        seen.add(subject)
        subject, outer = around[subject]
        relation = outer if relation in _INSIDE_LISTS else relation
    return subject, relation


def _title(graph: Graph, owner: Identifier) -> str:
    if not isinstance(owner, BNode):
        return ending(owner)
    return next((ending(kind) for kind in graph.objects(owner, RDF.type)), "something nameless")


def _space(iri: str) -> str:
    """The namespace of an IRI: all but its last part."""
    return iri[: max(iri.rfind("#"), iri.rfind("/")) + 1]
