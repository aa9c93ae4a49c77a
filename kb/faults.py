"""What may be wrong with an ontology, each fault with what would be right."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from graphlib import CycleError, TopologicalSorter
from typing import Any

import owlready2
from rapidfuzz import process

from kb.names import unique, words_of
from kb.owl import downwards, label, upwards, values

ROOTS = ("Object", "Furniture", "Room", "Person")
"""The classes below which everything is."""
STANDARDS = "http://www.w3.org/"
"""Where the names are that nobody has to declare: RDF, RDFS, OWL, XML Schema."""
LEAST_LIKENESS = 75.0
"""Of 100, as rapidfuzz counts: so alike are a name and a slip of it."""
_ABOVE = "SELECT ?class ?above WHERE { ?class rdfs:subClassOf ?above }"


def faults(world: owlready2.World, namespace: str) -> Iterator[str]:
    """What is wrong with the knowledge, a sentence each; nothing if it is sound.

    Args:
        world: the loaded files.
        namespace: where the classes of `ROOTS` are.
    """
    roots = {name: world[namespace + name] for name in ROOTS}
    dangling = tuple(_dangling(world))
    yield from map(str, dangling)
    yield from _cycles(world)
    yield from _outsiders(world, list(roots.values()), {link.of for link in dangling})
    for root in roots.values():
        yield from _ambiguous(root)
    yield from _homeless(roots["Furniture"], roots["Room"])
    usual = world[namespace + "hasDefaultLocation"]
    for thing in downwards(roots["Object"]):
        yield from _misplaced(thing, usual, roots["Furniture"])


@dataclass(frozen=True, slots=True)
class _Link:
    """A link to nothing: `of` is `relation` `to`, which no file declares."""

    of: str
    relation: str
    to: str
    nearest: str | None

    def __str__(self) -> str:
        right = f"write {self.nearest}, or declare it" if self.nearest else "declare it"
        return f"{self.of} {self.relation} {self.to}, which no file declares: {right}"


def _dangling(world: owlready2.World) -> Iterator[_Link]:
    """The loader passes over what is not declared, but the files' triples still have it."""
    triples = list(world.get_triples(None, None, None))
    declared = {subject for subject, relation, _ in triples if relation == owlready2.rdf_type}
    around = {of: subject for subject, _, of in triples if isinstance(of, int) and of < 0}
    restricts = {s: of for s, relation, of in triples if relation == owlready2.owl_onproperty}
    known = [_ending(world, one) for one in declared if one > 0]
    for subject, relation, of in triples:
        by = restricts[subject] if relation == owlready2.VALUE else relation
        while subject in around:
            subject = around[subject]
        for how, end in (("uses", relation), (_ending(world, by), of)):
            if end not in declared and _is_own(world, end):
                name = _ending(world, end)
                nearest = process.extractOne(name, known, score_cutoff=LEAST_LIKENESS)
                yield _Link(_ending(world, subject), how, name, nearest and nearest[0])


def _is_own(world: owlready2.World, node: int | str) -> bool:
    """Whether it is a name, not a value or a blank, and one that some file has to declare."""
    if isinstance(node, str) or node < 0:
        return False
    return not world._unabbreviate(node).startswith(STANDARDS)


def _ending(world: owlready2.World, entity: int) -> str:
    """What an IRI ends in: its name for people."""
    iri: str = world._unabbreviate(entity)
    return iri.rstrip("#/").replace("#", "/").rpartition("/")[2]


def _cycles(world: owlready2.World) -> Iterator[str]:
    """The loader leaves one link of a cycle out, but the files' triples still have it."""
    above: dict[Any, set[Any]] = {}
    for one, other in world.prepare_sparql(_ABOVE).execute():
        if isinstance(other, owlready2.ThingClass):
            above.setdefault(one, set()).add(other)
    while True:
        try:
            TopologicalSorter(above).prepare()
            return
        except CycleError as error:
            circle = error.args[1]
            above[circle[1]].remove(circle[0])
            names = " below ".join(kind.name for kind in reversed(circle))
            yield f"{names}: no class is below itself, take out one subClassOf"


def _outsiders(world: owlready2.World, roots: Sequence[Any], told: set[str]) -> Iterator[str]:
    """What is below no root, less those of whom a fault was told that explains it."""
    known = {c for root in roots for c in downwards(root)}
    for entity in (*world.classes(), *world.individuals()):
        above = [c for kind in entity.is_a for c in _classes(kind)]
        if entity.name not in told and entity not in known and not known.intersection(above):
            right = f"put it below {', '.join(ROOTS[:-1])} or {ROOTS[-1]}"
            yield f"{entity.name} is in no class: {right}"


def _classes(kind: Any) -> Iterator[Any]:
    return upwards(kind) if isinstance(kind, owlready2.ThingClass) else iter(())


def _ambiguous(root: Any) -> Iterator[str]:
    owners: dict[tuple[str, ...], Any] = {}
    for thing in downwards(root):
        for name in unique((label(thing), *thing.altLabel)):
            other = owners.setdefault(words_of(name), thing)
            if other is not thing:
                yield f"{name!r} names both {other.name} and {thing.name}: rename one"


def _homeless(furniture: Any, room: Any) -> Iterator[str]:
    for piece in furniture.instances():
        if piece.isIn is None:
            yield f"{piece.name} is in no room: say with isIn where it stands"
        elif isinstance(piece.isIn, owlready2.Thing) and not isinstance(piece.isIn, room):
            yield f"{piece.name} is in {piece.isIn.name}, which is no room: name a room"


def _misplaced(thing: Any, relation: Any, furniture: Any) -> Iterator[str]:
    for place in values(thing, relation):
        if place is not None and not isinstance(place, furniture):
            fault = f"{thing.name} has a default location, {place.name}, that is no furniture"
            yield f"{fault}: name a piece of furniture"
