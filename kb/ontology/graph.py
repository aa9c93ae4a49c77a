"""The triples of the files as a graph of classes and individuals; nothing in it is executed."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

from rdflib import OWL, RDF, RDFS, SKOS, BNode, Literal, URIRef
from rdflib.term import Identifier

from executive.errors import InputError
from executive.language.phrases import words_of
from executive.text import printable
from kb.ontology.names import unique
from kb.ontology.owl import Triple, ending

STANDARDS = "http://www.w3.org/"
"""The namespaces of RDF, RDFS, OWL and XML Schema, whose names need no declaration."""
LONGEST_NAME = 100
MOST_STEPS = 500_000
"""Limit for the sum of superclasses over all classes; ten thousand things have about 60,000."""


@dataclass(frozen=True, slots=True)
class Called:
    """Name and synonyms of an entity, and why some of its names are not used."""

    name: str
    synonyms: tuple[str, ...]
    refused: tuple[str, ...]


class Graph:
    """The triples of all files, in order."""

    def __init__(self, triples: Iterable[Triple]) -> None:
        """Index the triples."""
        self._about: dict[Identifier, dict[Identifier, dict[Identifier, None]]] = {}
        for subject, relation, value in triples:
            self._about.setdefault(subject, {}).setdefault(relation, {})[value] = None
        self._above: dict[Identifier, list[Identifier]] = {}
        self._below: dict[Identifier, list[Identifier]] = {}
        for kind in list(self._about):
            if isinstance(kind, URIRef):
                self._above[kind] = [k for k in self._named(kind) if k != kind]
                for above in self._above[kind]:
                    self._below.setdefault(above, []).append(kind)
        self._of: dict[Identifier, list[Identifier]] = {}
        for entity in self._about:
            for kind in self.types(entity):
                self._of.setdefault(kind, []).append(entity)
        self._called: dict[Identifier, Called] = {}

    # --- what is said ---

    def triples(self) -> Iterator[Triple]:
        """All triples, subject by subject."""
        for subject, said in self._about.items():
            for relation, values in said.items():
                for value in values:
                    yield subject, relation, value

    def objects(self, subject: Identifier, relation: Identifier) -> Sequence[Identifier]:
        """The values of a relation of a subject."""
        return tuple(self._about.get(subject, {}).get(relation, ()))

    def is_declared(self, entity: Identifier) -> bool:
        """Whether a file gives its type or a superclass."""
        said = self._about.get(entity, {})
        return RDF.type in said or RDFS.subClassOf in said

    def subjects(self) -> Iterator[Identifier]:
        """All subjects of triples."""
        return iter(self._about)

    def members(self, items: Identifier) -> list[Identifier]:
        """The members of an RDF list."""
        found, seen = list[Identifier](), set[Identifier]()
        while items not in seen and items in self._about:
            seen.add(items)
            found.extend(self.objects(items, RDF.first))
            items = next(iter(self.objects(items, RDF.rest)), RDF.nil)
        return found

    def put(self, individual: Identifier, relation: Identifier, value: Identifier) -> None:
        """Set the only value of a relation of an individual."""
        said = self._about.setdefault(individual, {})
        if relation == RDF.type:
            for kind in said.get(relation, ()):
                if individual in self._of.get(kind, ()):
                    self._of[kind].remove(individual)
            self._of.setdefault(value, []).append(individual)
        said[relation] = {value: None}

    def put_class(self, kind: Identifier, above: Identifier, name: str) -> None:
        """Add a class with its superclass and its label."""
        said = {RDF.type: OWL.Class, RDFS.subClassOf: above, RDFS.label: Literal(name)}
        self._about[kind] = {relation: {value: None} for relation, value in said.items()}
        self._above[kind] = [above]
        self._below.setdefault(above, []).append(kind)

    # --- classes and individuals ---

    def is_class(self, entity: Identifier) -> bool:
        """Whether a file declares it as a class, or gives it a superclass."""
        said = self._about.get(entity, {})
        kinds = said.get(RDF.type, {})
        is_one = OWL.Class in kinds or RDFS.Class in kinds or RDFS.subClassOf in said
        return is_one and isinstance(entity, URIRef)

    def individuals(self) -> Iterator[Identifier]:
        """All named instances of classes."""
        for entity in self._about:
            if isinstance(entity, URIRef) and not self.is_class(entity):
                named = OWL.NamedIndividual in self.objects(entity, RDF.type)
                if named or self.types(entity):
                    yield entity

    def types(self, entity: Identifier) -> list[Identifier]:
        """The classes of an individual, without those of the standards (`owl:NamedIndividual`)."""
        return [t for t in self.objects(entity, RDF.type) if not t.startswith(STANDARDS)]

    def parts(self, kind: Identifier) -> list[Identifier]:
        """All direct superclasses and restrictions of a class, with the operands of intersections.

        An anonymous equivalent class counts as well. A named one does not: the two classes would
        be below each other.
        """
        same = [k for k in self.objects(kind, OWL.equivalentClass) if isinstance(k, BNode)]
        queue = [*self.objects(kind, RDFS.subClassOf), *same, *self._operands(kind)]
        found = dict[Identifier, None]()
        for part in queue:
            if part not in found:
                found[part] = None
                queue.extend(self._operands(part) if isinstance(part, BNode) else ())
        return list(found)

    def upwards(self, kind: Identifier) -> Iterator[Identifier]:
        """The class and its superclasses, nearest first, without owl:Thing."""
        level, seen = [kind], set[Identifier]()
        while level:
            new = [c for c in dict.fromkeys(level) if c not in seen]
            yield from new
            seen.update(new)
            level = [above for c in new for above in self._above.get(c, ())]

    def downwards(self, kind: Identifier) -> Iterator[Identifier]:
        """The class and its subclasses, each once, depth first, in the order of the files."""
        stack, seen = [kind], set[Identifier]()
        while stack:
            current = stack.pop()
            if current not in seen:
                seen.add(current)
                yield current
                stack.extend(reversed(self._below.get(current, ())))

    def leaves(self, kind: Identifier) -> list[Identifier]:
        """The subclasses (or the class itself) without further subclasses.

        In a cycle, where classes are below each other, these do not count as further ones.
        """
        return [c for c in self.downwards(kind) if self._is_leaf(c)]

    def instances(self, kind: Identifier) -> list[Identifier]:
        """The individuals of the class and its subclasses."""
        found = (one for c in self.downwards(kind) for one in self._of.get(c, ()))
        return list(dict.fromkeys(found))

    def values(self, kind: Identifier, relation: Identifier) -> list[Identifier]:
        """The values of a relation of a class: from `hasValue` restrictions, or stated directly."""
        restricted = [
            value
            for part in self.parts(kind)
            if relation in self.objects(part, OWL.onProperty)
            for value in self.objects(part, OWL.hasValue)
        ]
        return list(dict.fromkeys([*restricted, *self.objects(kind, relation)]))

    def expect_bounded(self, roots: Sequence[Identifier]) -> None:
        """Refuse an ontology that would take too long to traverse.

        Raises:
            InputError: if the sum of superclasses over all classes below the roots is too large.
        """
        steps = 0
        for below in (kind for root in roots for kind in self.downwards(root)):
            for _ in self.upwards(below):
                steps += 1
                if steps > MOST_STEPS:
                    fault = f"has too many classes, one above another, above {ending(below)}"
                    raise InputError("ontology", fault, "load fewer files, or smaller ones")

    # --- names ---

    def called(self, entity: Identifier) -> Called:
        """Name and synonyms of an entity; the name is English if a file has one."""
        if entity not in self._called:
            self._called[entity] = self._find_names(entity)
        return self._called[entity]

    def label(self, entity: Identifier) -> str:
        """Name of an entity: a label, or the last part of its IRI."""
        return self.called(entity).name

    def names(self, entity: Identifier) -> tuple[str, ...]:
        """Name and synonyms of an entity."""
        called = self.called(entity)
        return (called.name, *called.synonyms)

    # --- inside ---

    def _find_names(self, entity: Identifier) -> Called:
        relations = (RDFS.label, SKOS.prefLabel, SKOS.altLabel, SKOS.hiddenLabel)
        given = {relation: self.objects(entity, relation) for relation in relations}
        refused, usable = list[str](), dict[Identifier, list[Identifier]]()
        for relation, labels in given.items():
            for text in labels:
                if why := unusable(one_line(text)):
                    refused.append(f"{ending(entity)}: the name {printable(text)[:40]!r} {why}")
                else:
                    usable.setdefault(relation, []).append(text)
        titles = [*usable.get(RDFS.label, ()), *usable.get(SKOS.prefLabel, ())]
        title = next(filter(_is_english, titles), titles[0] if titles else None)
        name = ending(entity)[:LONGEST_NAME] if title is None else one_line(title)
        others = (one_line(text) for labels in usable.values() for text in labels)
        return Called(name, tuple(n for n in unique(others) if n != name), tuple(refused))

    def _named(self, kind: Identifier) -> list[Identifier]:
        """The direct superclasses that are declared."""
        return [
            part
            for part in self.parts(kind)
            if isinstance(part, URIRef) and part in self._about and not part.startswith(STANDARDS)
        ]

    def _operands(self, kind: Identifier) -> list[Identifier]:
        lists = self.objects(kind, OWL.intersectionOf)
        return [member for items in lists for member in self.members(items)]

    def _is_leaf(self, kind: Identifier) -> bool:
        below = self._below.get(kind)
        return not below or set(below) <= set(self.upwards(kind))


def one_line(text: str) -> str:
    """The text on one line, without layout whitespace."""
    return " ".join(text.split())


def unusable(name: str) -> str | None:
    """Why a name or a property value cannot be used, as a clause; None if it can."""
    if len(name) > LONGEST_NAME:
        return f"is longer than {LONGEST_NAME} characters: give a shorter one"
    if printable(name) != name:
        return "has characters that nobody sees: take them out"
    return None if words_of(name) else "has no word in it: write one"


def _is_english(text: Identifier) -> bool:
    language = text.language if isinstance(text, Literal) else None
    return not language or language.lower().split("-")[0] == "en"
