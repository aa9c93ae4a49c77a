"""Reading OWL files offline, and walking what they say, in terms of owlready2."""

from collections.abc import Iterator
from dataclasses import dataclass
from io import BytesIO
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import owlready2

from executive.errors import InputError

_RDF = "{http://www.w3.org/1999/02/22-rdf-syntax-ns#}"
_OWL = "{http://www.w3.org/2002/07/owl#}"
_BASE = "{http://www.w3.org/XML/1998/namespace}base"


@dataclass(frozen=True, slots=True)
class OwlFile:
    """An RDF/XML file, the IRI of the ontology in it, and the IRIs that this one imports."""

    path: Path
    content: bytes
    iri: str
    imports: tuple[str, ...]


def read(path: Path) -> OwlFile:
    """Read a file; one that declares no IRI goes by its place on the disk.

    Raises:
        InputError: if it is no RDF/XML.
    """
    try:
        content = path.read_bytes()
        root = ElementTree.fromstring(content)
    except OSError as error:
        raise InputError(str(path), f"cannot be read: {error.strerror}") from None
    except ElementTree.ParseError as error:
        raise InputError(str(path), f"is not XML: {error}") from None
    if root.tag != f"{_RDF}RDF":
        raise InputError(str(path), f"begins with <{root.tag}>", "save the ontology as RDF/XML")
    declared = root.find(f"{_OWL}Ontology")
    about = "" if declared is None else declared.get(f"{_RDF}about", "")
    iri = about or root.get(_BASE) or path.absolute().as_uri()
    imports = (imported.get(f"{_RDF}resource", "") for imported in root.iter(f"{_OWL}imports"))
    return OwlFile(path, content, iri.rstrip("#"), tuple(name.rstrip("#") for name in imports))


def load(world: owlready2.World, file: OwlFile) -> None:
    """Put a file into the world; nothing is ever fetched from the network.

    Raises:
        InputError: if it is no ontology, or imports one that was not loaded before it.
    """
    loaded = {iri.rstrip("#") for iri in world.ontologies}
    for iri in file.imports:
        if iri not in loaded:
            right = f"load first the file that holds it; loaded are {', '.join(sorted(loaded))}"
            raise InputError(str(file.path), f"imports {iri}", right)
    try:
        ontology = world.get_ontology(file.path.absolute().as_uri())
        ontology.load(only_local=True, fileobj=BytesIO(file.content))
    except (owlready2.OwlReadyError, TypeError, ValueError) as error:
        fault = f"is no ontology that owlready2 can read: {error}"
        raise InputError(str(file.path), fault) from None


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
