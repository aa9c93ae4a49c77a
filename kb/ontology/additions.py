"""What a home adds to the ontology: furniture and rooms as individuals, things as classes."""

from collections.abc import Callable, Iterable, Iterator
from functools import partial

from rdflib import RDF, Literal, URIRef
from rdflib.term import Identifier

from executive.errors import InputError
from executive.text import printable
from executive.types.home import Place, Thing
from kb.ontology.graph import Graph
from kb.ontology.home_file import home_file
from kb.ontology.owl import ending
from kb.ontology.properties import COLOR, Properties
from kb.ontology.things import put_thing

INDIVIDUALS = "http://robot-executive.org/home.owl#"


class HomeAdditions:
    """Adds the furniture, rooms and things of a home to the graph, and remembers them."""

    def __init__(self, graph: Graph, namespace: str, home: str) -> None:
        """Nothing is added yet.

        Args:
            graph: the triples of the files.
            namespace: the IRI prefix of our classes and properties.
            home: the home file, for error messages.
        """
        self._graph = graph
        self._namespace = namespace
        self._where = f"{printable(home)}: " if home else ""
        self._properties = Properties(graph, namespace)
        self.kinds = {
            root: _by_name(graph.downwards(self._iri(root)))
            for root in ("Furniture", "Room", "Object")
        }
        """For each of these root classes, the classes below it by name."""
        self._places: dict[str, Place] = {}
        self._things: dict[str, tuple[Identifier, str]] = {}

    def add_furniture(self, place: Place) -> None:
        """Add a piece of furniture and its room.

        Raises:
            InputError: if the ontology does not have its class.
        """
        room = self._individual(place.room, place.room_kind, "Room")
        piece = self._individual(place.name, place.kind, "Furniture")
        self._graph.put(piece, self._iri("isIn"), room)
        self._places[place.name] = place

    def add_thing(self, thing: Thing) -> None:
        """Add an object, unless a file declares it already.

        Raises:
            InputError: if the ontology does not have its class, or the name belongs to something
                else.
        """
        kind = self._kind(f"object {thing.name}", thing.kind, "Object")
        own = URIRef(INDIVIDUALS + thing.name)
        where = f"{self._where}object {printable(thing.name)}"
        if not put_thing(self._graph, thing.name, kind, own, self._namespace, where):
            return
        color = thing.color if self._properties.are_declared() else ""
        if color:
            self._graph.put(own, self._properties.iri(COLOR), Literal(color))
        self._things[thing.name] = (kind, color)

    def faults(self, places: Iterable[Place], things: Iterable[Thing]) -> Iterator[InputError]:
        """The faults of these; all the others are added."""
        rooms, put = dict[str, str](), list[Callable[[], object]]()
        for place in places:
            rooms[place.room] = place.room_kind
            put.append(partial(self._individual, place.name, place.kind, "Furniture"))
        put += [partial(self._individual, room, kind, "Room") for room, kind in rooms.items()]
        put += [partial(self.add_thing, thing) for thing in things]
        for one in put:
            try:
                one()
            except InputError as fault:
                yield fault

    def file(self) -> bytes:
        """The additions as RDF/XML."""
        is_in, color = self._iri("isIn"), self._properties.iri(COLOR)
        furniture, rooms = self.kinds["Furniture"], self.kinds["Room"]
        places = self._places.values()
        return home_file(INDIVIDUALS, is_in, color, places, furniture, rooms, self._things)

    def _individual(self, name: str, kind: str, root: str) -> Identifier:
        individual = URIRef(INDIVIDUALS + name)
        self._graph.put(individual, RDF.type, self._kind(name, kind, root))
        return individual

    def _kind(self, name: str, kind: str, root: str) -> Identifier:
        class_ = self.kinds[root].get(kind)
        if class_ is None:
            known = ", ".join(self.kinds[root])
            is_other = any(kind in kinds for kinds in self.kinds.values())
            why = f"is no kind of {root.lower()}" if is_other else "the ontology lacks"
            where = f"{self._where}{printable(name)}"
            raise InputError(where, f"is a {printable(kind)!r}, which {why}", f"known are {known}")
        return class_

    def _iri(self, name: str) -> URIRef:
        return URIRef(self._namespace + name)


def _by_name(kinds: Iterable[Identifier]) -> dict[str, Identifier]:
    """Classes by the last part of their IRI; of several with one name, the first."""
    named: dict[str, Identifier] = {}
    for kind in kinds:
        named.setdefault(ending(kind), kind)
    return named
