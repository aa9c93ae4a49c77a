"""Reading OWL files offline, and walking what they say, in terms of owlready2."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import owlready2

from executive.errors import InputError

_RDF = "{http://www.w3.org/1999/02/22-rdf-syntax-ns#}"
_OWL = "{http://www.w3.org/2002/07/owl#}"


def load(world: owlready2.World, path: Path) -> None:
    """Read one RDF/XML file into the world; nothing is ever fetched from the network.

    Raises:
        InputError: if it is no such file, or imports an ontology that was not loaded before it.
    """
    try:
        root = ElementTree.parse(path).getroot()
    except OSError as error:
        raise InputError(str(path), f"cannot be read: {error.strerror}") from None
    except ElementTree.ParseError as error:
        raise InputError(str(path), f"is not XML: {error}") from None
    if root.tag != f"{_RDF}RDF":
        raise InputError(str(path), f"begins with <{root.tag}>", "save the ontology as RDF/XML")
    loaded = {iri.rstrip("#") for iri in world.ontologies}
    for imported in root.iter(f"{_OWL}imports"):
        iri = imported.get(f"{_RDF}resource", "")
        if iri.rstrip("#") not in loaded:
            right = f"load first the file that holds it; loaded are {', '.join(sorted(loaded))}"
            raise InputError(str(path), f"imports {iri}", right)
    try:
        with path.open("rb") as file:
            world.get_ontology(path.absolute().as_uri()).load(only_local=True, fileobj=file)
    except (owlready2.OwlReadyError, TypeError, ValueError) as error:
        raise InputError(str(path), f"is no ontology that owlready2 can read: {error}") from None


def label(entity: Any) -> str:
    """What an entity is called: its rdfs:label, or the end of its IRI."""
    return str(entity.label.first() or entity.name)


def upwards(entity: Any) -> Iterator[Any]:
    """The class and all classes above it, nearest first, without owl:Thing."""
    level, seen = [entity], {owlready2.Thing}
    while level:
        new = [c for c in dict.fromkeys(level) if c not in seen]
        yield from new
        seen.update(new)
        level = [s for c in new for s in c.is_a if isinstance(s, owlready2.ThingClass)]


def downwards(entity: Any) -> Iterator[Any]:
    """The class and all classes below it, each once, depth first in the files' order."""
    stack, seen = [entity], set()
    while stack:
        current = stack.pop()
        if current not in seen:
            seen.add(current)
            yield current
            stack.extend(reversed(list(current.subclasses())))


def leaves(entity: Any) -> list[Any]:
    """The classes below this one (or itself) that have none below them."""
    return [c for c in downwards(entity) if not list(c.subclasses())]


def values(entity: Any, relation: Any) -> list[Any]:
    """What the class's own restrictions `relation value x` name; None what no file declares."""
    return [
        c.value
        for c in entity.is_a
        if isinstance(c, owlready2.Restriction)
        and c.property is relation
        and c.type == owlready2.VALUE
    ]
