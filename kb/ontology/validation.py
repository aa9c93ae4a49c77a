"""Checks an ontology; each fault is told with what would be right."""

from collections.abc import Iterable, Iterator, Sequence
from graphlib import CycleError, TopologicalSorter
from itertools import islice

from rdflib import OWL, RDFS, BNode, Literal, URIRef
from rdflib.term import Identifier

from executive.language.naming import heard_as, says_how_many
from executive.language.phrases import Words, words_of
from executive.text import printable
from kb.ontology.dangling import broken_lists, dangling
from kb.ontology.graph import STANDARDS, Graph
from kb.ontology.misuse import misuse
from kb.ontology.owl import ending

ROOTS = ("Object", "Furniture", "Room", "Person")
"""The classes that everything else must be below."""
TAKEN = ("hand", "floor", "person", "delivery")
"""Names that the robot uses itself: its hand, the floor, its user, the delivery table."""
MOST_OF_A_KIND = 20
"""Limit of individually listed faults of one kind."""


def faults(graph: Graph, namespace: str, *, imports_met: bool = True) -> Iterator[str]:
    """A sentence for each fault of the ontology; none if it is valid.

    Args:
        graph: the triples of the loaded files.
        namespace: the IRI prefix of the classes in `ROOTS`.
        imports_met: whether all imports are loaded; if not, names in other namespaces may be
            declared in files that are missing.
    """
    roots = {name: URIRef(namespace + name) for name in ROOTS}
    links = list(dangling(graph, strict=imports_met))
    yield from _limited(dict.fromkeys(map(str, links)), "links to nothing")
    yield from _limited(broken_lists(graph), "broken lists")
    yield from _limited(_cycles(graph), "circles")
    told = {link.subject for link in links}
    yield from _limited(_outsiders(graph, list(roots.values()), told), "in no class")
    things = list(graph.downwards(roots["Object"]))
    yield from _limited(_of_two_sorts(graph, roots), "of two sorts")
    yield from _limited(_impossible(graph), "below Nothing")
    refused = (
        why
        for root in roots.values()
        for kind in _with_individuals(graph, root)
        for why in graph.called(kind).refused
    )
    yield from _limited(refused, "names that are not used")
    yield from _limited(_taken(graph, things), "names that are taken")
    yield from _limited(_ambiguous(graph, roots), "names of two things")
    yield from _limited(_homeless(graph, roots, URIRef(namespace + "isIn")), "without a room")
    yield from _limited(_misplaced(graph, things, roots, namespace), "default locations")
    yield from _limited(_individuals(graph, roots["Object"]), "individuals")
    prepositions = _prepositions(graph, roots["Furniture"], URIRef(namespace + "preposition"))
    yield from _limited(prepositions, "prepositions")
    yield from _limited(misuse(graph, namespace, roots["Object"]), "colours, shapes and uses")


def _limited(told: Iterable[str], of: str) -> Iterator[str]:
    """The first faults of a kind, and the number of the others."""
    every = iter(told)
    yield from islice(every, MOST_OF_A_KIND)
    if more := sum(1 for _ in every):
        yield f"and {more} more of this kind ({of})"


def _with_individuals(graph: Graph, root: Identifier) -> Iterator[Identifier]:
    """The class with its subclasses, and their individuals."""
    yield from graph.downwards(root)
    yield from graph.instances(root)


def _of_two_sorts(graph: Graph, roots: dict[str, URIRef]) -> Iterator[str]:
    """Objects that are a place or a person, too."""
    sorts = {name: set(graph.downwards(root)) for name, root in roots.items()}
    for kind in sorts["Object"]:
        if others := [name for name in ROOTS[1:] if kind in sorts[name]]:
            yield f"{ending(kind)} is below Object and below {others[0]}: take out one subClassOf"


def _impossible(graph: Graph) -> Iterator[str]:
    """Subclasses of owl:Nothing; a reasoner writes this for contradictory classes."""
    for kind in graph.subjects():
        above = {*graph.objects(kind, RDFS.subClassOf), *graph.objects(kind, OWL.equivalentClass)}
        if OWL.Nothing in above:
            yield f"{ending(kind)} is below Nothing, so that there is none: take out what says so"


def _cycles(graph: Graph) -> Iterator[str]:
    above = {
        kind: {k for k in graph.objects(kind, RDFS.subClassOf) if isinstance(k, URIRef)}
        for kind in graph.subjects()
        if isinstance(kind, URIRef)
    }
    while True:
        try:
            TopologicalSorter(above).prepare()
            return
        except CycleError as error:
            circle = error.args[1]
            above[circle[1]].remove(circle[0])
            names = " below ".join(ending(kind) for kind in reversed(circle))
            yield f"{names}: no class is below itself, take out one subClassOf"


def _outsiders(graph: Graph, roots: Sequence[Identifier], told: set[Identifier]) -> Iterator[str]:
    """What is below no root, without those for which another fault explains it."""
    known = {kind for root in roots for kind in graph.downwards(root)}
    for entity in (*filter(graph.is_class, graph.subjects()), *graph.individuals()):
        kinds = [entity] if graph.is_class(entity) else graph.types(entity)
        above = (c for kind in kinds for c in graph.upwards(kind))
        own = entity not in told and not entity.startswith(STANDARDS)
        if own and known.isdisjoint(above):
            right = f"put it below {', '.join(ROOTS[:-1])} or {ROOTS[-1]}"
            yield f"{ending(entity)} is in no class: {right}"


def _taken(graph: Graph, things: Iterable[Identifier]) -> Iterator[str]:
    taken = {words_of(name): name for name in TAKEN}
    for thing in things:
        for name in graph.names(thing):
            if words_of(name) in taken:
                fault = f"{ending(thing)} is called {name!r}, as the robot calls something else"
                yield f"{fault}: rename it"
            elif meaning := heard_as(name):
                yield f"{ending(thing)} is called {name!r}, which {meaning}: rename it"
            elif says_how_many(name):
                yield f"{ending(thing)} is called {name!r}, which says how many: rename it"


def _ambiguous(graph: Graph, roots: dict[str, URIRef]) -> Iterator[str]:
    """Names shared by two classes of one root, by two people, or by a thing and a place."""
    of_places: dict[Words, Identifier] = {}
    for root in ("Furniture", "Room"):
        for place in _with_individuals(graph, roots[root]):
            for name in graph.names(place):
                of_places.setdefault(words_of(name), place)
    for title, root in roots.items():
        owners = dict(of_places) if title == "Object" else {}
        for thing in graph.instances(root) if title == "Person" else graph.downwards(root):
            for name in graph.names(thing):
                other = owners.setdefault(words_of(name), thing)
                if other != thing:
                    shown = printable if ending(other) == ending(thing) else ending
                    yield f"{name!r} names both {shown(other)} and {shown(thing)}: rename one"


def _homeless(graph: Graph, roots: dict[str, URIRef], is_in: Identifier) -> Iterator[str]:
    rooms = set(graph.instances(roots["Room"]))
    for piece in graph.instances(roots["Furniture"]):
        stands_in = graph.objects(piece, is_in)
        if not stands_in:
            yield f"{ending(piece)} is in no room: say with isIn where it stands"
        if len(stands_in) > 1:
            listed = " and in ".join(map(_shown, stands_in))
            yield f"{ending(piece)} is in {listed}: it stands in one room, take out the other isIn"
        for room in stands_in:
            if room not in rooms and (graph.is_declared(room) or not isinstance(room, URIRef)):
                yield f"{ending(piece)} is in {_shown(room)}, which is no room: name a room"


def _misplaced(
    graph: Graph, things: Sequence[Identifier], roots: dict[str, URIRef], namespace: str
) -> Iterator[str]:
    usual, likes = URIRef(namespace + "hasDefaultLocation"), URIRef(namespace + "preferredBy")
    furniture = set(graph.instances(roots["Furniture"]))
    people = set(graph.instances(roots["Person"]))
    for thing in things:
        for place in _of_wrong_kind(graph, graph.values(thing, usual), furniture):
            fault = f"{ending(thing)} has a default location, {place}, that is no furniture"
            yield f"{fault}: name a piece of furniture"
        for person in _of_wrong_kind(graph, graph.values(thing, likes), people):
            yield f"{ending(thing)} is preferred by {person}, which is no Person: name one"


def _of_wrong_kind(
    graph: Graph, values: Iterable[Identifier], right: set[Identifier]
) -> Iterator[str]:
    """Values of the wrong kind; undeclared ones are reported elsewhere."""
    for value in values:
        declared = graph.is_declared(value) or not isinstance(value, URIRef)
        if declared and value not in right:
            yield _shown(value)


def _individuals(graph: Graph, root: Identifier) -> Iterator[str]:
    """Individuals of object classes; only classes can be asked for."""
    for one in graph.instances(root):
        kinds = ", ".join(map(ending, graph.types(one)))
        if isinstance(one, BNode):
            yield f"a nameless individual of {kinds} is not used: only classes are objects"
        elif graph.is_class(one):
            right = "take out the individual (owl:NamedIndividual), the class is enough"
            yield f"{ending(one)} is a class and an individual of {kinds}, too: {right}"
        else:
            right = f"declare it as a class (owl:Class) that is rdfs:subClassOf {kinds}"
            fault = f"{ending(one)} is an individual of {kinds}, and only classes are objects"
            yield f"{fault}: {right}"


def _prepositions(graph: Graph, furniture: Identifier, given: Identifier) -> Iterator[str]:
    for kind in graph.downwards(furniture):
        for word in graph.objects(kind, given):
            if str(word) not in ("in", "on"):
                yield f"{ending(kind)} has the preposition {_shown(word)}: write in or on"


def _shown(value: Identifier) -> str:
    return printable(value)[:40] if isinstance(value, Literal) else ending(value)
