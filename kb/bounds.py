"""What an XML file may ask of its reader: no file, no address, and a bounded amount of work."""

from dataclasses import dataclass, field
from xml.parsers import expat

from executive.errors import InputError
from executive.text import printable
from kb.syntax import SAVE

MOST_DEPTH = 200
"""Elements in one another: what people nest has a dozen."""
LONGEST_ENTITY = 1_000
"""Characters of an entity, which stands for the beginning of an IRI."""
MOST_EXPANDED = 30_000_000
"""Characters that all entities may come to, wherever they are used."""

_RDF = "http://www.w3.org/1999/02/22-rdf-syntax-ns# RDF"
_BASE = "http://www.w3.org/XML/1998/namespace base"


@dataclass(slots=True)
class _Bounds:
    """Handlers of expat: they raise as soon as something is too much."""

    where: str
    content: bytes
    base: str = ""
    depth: int = 0
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
        if self.depth > MOST_DEPTH:
            fault = f"has more than {MOST_DEPTH} elements in one another"
            raise InputError(self.where, fault, "give what is inside a name of its own")

    def end(self, name: str) -> None:
        self.depth -= 1


def base_of_bounded(content: bytes, where: str) -> str:
    """The xml:base of an RDF/XML file, empty if it has none.

    Raises:
        InputError: if it is no XML, no RDF/XML, refers to another file, or is too much to read.
    """
    bounds = _Bounds(where, content)
    parser = expat.ParserCreate(namespace_separator=" ")
    parser.EntityDeclHandler = bounds.entity
    parser.EndDoctypeDeclHandler = bounds.declared
    parser.StartElementHandler = bounds.start
    parser.EndElementHandler = bounds.end
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
