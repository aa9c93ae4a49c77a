"""What may be wrong with an ontology, each fault with what would be right."""

from collections.abc import Iterator
from graphlib import CycleError, TopologicalSorter
from typing import Any

import owlready2

from kb.names import unique, words_of
from kb.owl import downwards, label, upwards, values

ROOTS = ("Object", "Furniture", "Room", "Person")
"""The classes below which everything is."""
_ABOVE = "SELECT ?class ?above WHERE { ?class rdfs:subClassOf ?above }"


def faults(world: owlready2.World, namespace: str) -> Iterator[str]:
    """What is wrong with the knowledge, a sentence each; nothing if it is sound.

    Args:
        world: the loaded files.
        namespace: where the classes of `ROOTS` are.
    """
    roots = {name: world[namespace + name] for name in ROOTS}
    yield from _cycles(world)
    yield from _outsiders(world, list(roots.values()))
    for root in roots.values():
        yield from _ambiguous(root)
    for piece in roots["Furniture"].instances():
        if piece.isIn is None:
            yield f"{piece.name} is in no room: say with isIn where it stands"
    usual, preferred = world[namespace + "hasDefaultLocation"], world[namespace + "preferredBy"]
    for thing in downwards(roots["Object"]):
        yield from _misplaced(thing, usual, roots["Furniture"])
        if None in values(thing, preferred):
            yield f"{thing.name} is preferred by someone whom no file declares: declare the Person"


def _cycles(world: owlready2.World) -> Iterator[str]:
    """The loader leaves one link of a cycle out, but the file's triples still have it."""
    above: dict[Any, set[Any]] = {}
    for one, other in world.prepare_sparql(_ABOVE).execute():
        if isinstance(other, owlready2.ThingClass):
            above.setdefault(one, set()).add(other)
    try:
        TopologicalSorter(above).prepare()
    except CycleError as error:
        circle = " below ".join(kind.name for kind in reversed(error.args[1]))
        yield f"{circle}: no class is below itself, take out one subClassOf"


def _outsiders(world: owlready2.World, roots: list[Any]) -> Iterator[str]:
    known = {c for root in roots for c in downwards(root)}
    for entity in (*world.classes(), *world.individuals()):
        above = [c for kind in entity.is_a for c in _classes(kind)]
        if entity not in known and not known.intersection(above):
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


def _misplaced(thing: Any, relation: Any, furniture: Any) -> Iterator[str]:
    for place in values(thing, relation):
        if place is None:
            right = "declare it as furniture, or name another"
            yield f"{thing.name} has a default location that no file declares: {right}"
        elif not isinstance(place, furniture):
            fault = f"{thing.name} has a default location, {place.name}, that is no furniture"
            yield f"{fault}: name a piece of furniture"
