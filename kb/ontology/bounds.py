"""Limits for reading an XML file: no other file, no address, and a bounded amount of work."""

from dataclasses import dataclass, field
from xml.parsers import expat

from executive.errors import InputError
from executive.text import printable
from kb.ontology.syntax import SAVE

MOST_DEPTH = 200
"""Nested elements; hand-written files have a dozen."""
LONGEST_ENTITY = 1_000
"""Characters of an entity, which abbreviates the beginning of an IRI."""
MOST_EXPANDED = 30_000_000
"""Characters of all entities after expansion."""
LONGEST_TEXT = 20_000
"""Characters of one value; rdflib copies it for each line that it appends."""
MOST_NAMESPACES = 500
"""Prefixes declared at one place; all are copied for each further one."""
MOST_MARKUP, MOST_MARKED_UP = 2_000, 100_000
"""Pieces and characters of all values that are XML themselves (`rdf:parseType="Literal"`).

rdflib parses such a value again for each piece that it appends.
"""

_RDF = "http://www.w3.org/1999/02/22-rdf-syntax-ns# RDF"
_PARSE = "http://www.w3.org/1999/02/22-rdf-syntax-ns# parseType"
_STRUCTURES = ("Resource", "Collection", None)
_BASE = "http://www.w3.org/XML/1998/namespace base"


@dataclass(slots=True)
class _Bounds:
    """Handlers for expat, which raise an InputError as soon as a limit is exceeded."""

    where: str
    content: bytes
    base: str = ""
    depth: int = 0
    literal_at: int | None = None
    text_length: int = 0
    namespaces: int = 0
    pieces: int = 0
    characters: int = 0
    lengths: list[int] = field(default_factory=list)

    def entity(
        self,
        name: str,
        is_parameter: bool,
        value: str | None,
        base: str | None,
        system: str | None,
        public: str | None,
        notation: str | None,
    ) -> None:
        what = f"its entity {printable(name)[:100]!r}"
        if value is None or is_parameter:
            fault = f"{what} stands in another file, and nothing else is opened"
            raise InputError(self.where, fault, "write out what it stands for")
        if "&" in value or len(value) > LONGEST_ENTITY:
            fault = f"{what} is made of others, or longer than {LONGEST_ENTITY} characters"
            raise InputError(self.where, fault, "write out what it stands for")
        self.lengths.append(len(value))

    def declared(self) -> None:
        if self.content.count(b"&") * max(self.lengths, default=0) > MOST_EXPANDED:
            fault = f"its entities come to more than {MOST_EXPANDED} characters"
            raise InputError(self.where, fault, "write out what they stand for")

    def start(self, name: str, attributes: dict[str, str]) -> None:
        if not self.depth:
            if name != _RDF:
                _refuse_root(self.where, name)
            self.base = attributes.get(_BASE, "")
        self.depth += 1
        self.text_length = 0
        if self.literal_at is not None:
            self.inside_literal()
        elif attributes.get(_PARSE) not in _STRUCTURES:
            self.literal_at = self.depth
        if self.depth > MOST_DEPTH:
            fault = f"has more than {MOST_DEPTH} elements in one another"
            raise InputError(self.where, fault, "give what is inside a name of its own")

    def end(self, name: str) -> None:
        if self.literal_at == self.depth:
            self.literal_at = None
        self.depth -= 1
        self.text_length = 0

    def opens_namespace(self, prefix: str | None, iri: str | None) -> None:
        self.namespaces += 1
        if self.namespaces > MOST_NAMESPACES:
            fault = f"has more than {MOST_NAMESPACES} prefixes at one place"
            raise InputError(self.where, fault, "declare those that are used")

    def closes_namespace(self, prefix: str | None) -> None:
        self.namespaces -= 1

    def text(self, data: str) -> None:
        self.text_length += len(data)
        if self.text_length > LONGEST_TEXT:
            fault = f"has a text of more than {LONGEST_TEXT} characters"
            raise InputError(self.where, fault, "shorten it")
        if self.literal_at is not None:
            self.inside_literal(len(data))

    def inside_literal(self, characters: int = 0) -> None:
        self.pieces += 1
        self.characters += characters
        if self.pieces > MOST_MARKUP or self.characters > MOST_MARKED_UP:
            fault = "has too much XML as values (rdf:parseType Literal)"
            raise InputError(self.where, fault, "write them as text")


def base_of_bounded(content: bytes, where: str) -> str:
    """Check the limits, and return the xml:base of an RDF/XML file (empty if it has none).

    Raises:
        InputError: if it is not RDF/XML, refers to another file, or exceeds a limit.
    """
    bounds = _Bounds(where, content)
    parser = expat.ParserCreate(namespace_separator=" ")
    parser.EntityDeclHandler = bounds.entity
    parser.EndDoctypeDeclHandler = bounds.declared
    parser.StartElementHandler = bounds.start
    parser.EndElementHandler = bounds.end
    parser.CharacterDataHandler = bounds.text
    parser.StartNamespaceDeclHandler = bounds.opens_namespace
    parser.EndNamespaceDeclHandler = bounds.closes_namespace
    try:
        parser.Parse(content, True)
    except (expat.ExpatError, ValueError) as error:
        raise InputError(where, f"is not XML: {error}") from None
    return bounds.base


def _refuse_root(where: str, name: str) -> None:
    space, _, local = name.rpartition(" ")
    if local == "Ontology":
        raise InputError(where, "is in OWL/XML, which is not read", SAVE)
    shown = printable(f"{{{space}}}{local}" if space else local)[:100]
    raise InputError(where, f"begins with <{shown}>", SAVE)
