"""Writes what a home adds to the ontology as RDF/XML, for the log and for other tools."""

from collections.abc import Iterable, Mapping
from xml.etree import ElementTree

from rdflib import OWL, RDF, RDFS
from rdflib.term import Identifier

from executive.text import printable
from executive.types.home import Place


def home_file(
    namespace: str,
    is_in: Identifier,
    color: Identifier,
    places: Iterable[Place],
    furniture: Mapping[str, Identifier],
    rooms: Mapping[str, Identifier],
    things: Mapping[str, tuple[Identifier, str]],
) -> bytes:
    """Rooms and furniture as individuals of their classes, each once; things as classes.

    Args:
        namespace: prefix of the IRIs, up to the `#`.
        is_in: the property for the room of a piece of furniture.
        color: the property for the colour of a thing.
        places: the furniture.
        furniture: furniture classes by name.
        rooms: room classes by name.
        things: for the objects that the home declares, by name: superclass and colour (empty if
            none is given).
    """
    root = ElementTree.Element(f"{{{RDF}}}RDF")
    _about(ElementTree.SubElement(root, f"{{{OWL}}}Ontology"), namespace.rstrip("#"))
    described = set[str]()
    for place in places:
        if place.room not in described:
            _individual(root, namespace + place.room, rooms[place.room_kind])
        described.add(place.room)
        piece = _individual(root, namespace + place.name, furniture[place.kind])
        _resource(piece, is_in, namespace + place.room)
    for name, (kind, paint) in things.items():
        own = ElementTree.SubElement(root, f"{{{OWL}}}Class")
        _about(own, namespace + name)
        _resource(own, RDFS.subClassOf, kind)
        ElementTree.SubElement(own, f"{{{RDFS}}}label").text = name
        if paint:
            ElementTree.SubElement(own, _tag(color)).text = paint
    ElementTree.indent(root)
    written: bytes = ElementTree.tostring(root, encoding="utf-8", xml_declaration=True)
    return written + b"\n"


def _individual(root: ElementTree.Element, iri: str, kind: Identifier) -> ElementTree.Element:
    individual = ElementTree.SubElement(root, f"{{{OWL}}}NamedIndividual")
    _about(individual, iri)
    _resource(individual, RDF.type, kind)
    return individual


def _about(element: ElementTree.Element, iri: str) -> None:
    element.set(f"{{{RDF}}}about", printable(iri))


def _resource(element: ElementTree.Element, relation: Identifier, iri: str) -> None:
    named = ElementTree.SubElement(element, _tag(relation))
    named.set(f"{{{RDF}}}resource", printable(iri))


def _tag(relation: Identifier) -> str:
    space, mark, name = relation.rpartition("#")
    return f"{{{space}{mark}}}{name}"
