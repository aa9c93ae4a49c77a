"""Reads ontologies: a file as triples. Nothing in it is executed, opened or fetched.

rdflib's parsers only turn text into triples. owlready2's loader is not used, because it imports
the Python module named in an annotation, and reads imported files.
"""

import logging
import re
import warnings
from dataclasses import dataclass
from functools import lru_cache
from io import BytesIO, StringIO
from pathlib import Path
from typing import Any

import rdflib
from rdflib import OWL, RDF, BNode, URIRef
from rdflib.parser import InputSource
from rdflib.term import Identifier

from executive.errors import ExecutiveError, InputError
from executive.files import read_bytes
from executive.text import printable
from kb.ontology.bounds import base_of_bounded
from kb.ontology.syntax import SAVE, beyond_turtle, is_xml, turtle_text

Triple = tuple[Identifier, Identifier, Identifier]
"""Subject, predicate, object: each is an IRI, a blank node or a literal, and a str."""

MOST_BYTES = 4 * 2**20
MOST_TRIPLES = 100_000
LONGEST_FAULT = 200
_AT = re.compile(r"^None:(\d+):\d+:")
"""How the reader of RDF/XML says in which line."""
OWLREADY = "http://www.lesfleursdunormal.fr/static/_downloads/owlready_ontology.owl#"
_RUNS_PYTHON = URIRef(OWLREADY + "python_module")

logging.getLogger("rdflib").setLevel(logging.CRITICAL)
"""It would print malformed IRIs and literals, unfiltered."""
rdflib.NORMALIZE_LITERALS = False
"""Otherwise, a short number such as 1e999999999 is written out in full."""


class _Markup(str):
    """A value that is XML or HTML itself; not parsed."""


for _kind in (RDF.XMLLiteral, RDF.HTML):
    rdflib.term.bind(_kind, _Markup)


@dataclass(frozen=True, slots=True, eq=False)
class OwlFile:
    """A parsed file: its triples, the IRI and versions of its ontology, and the IRIs it imports.

    Cached: the same path with the same content gives the same object, for the last few files.
    """

    path: Path
    content: bytes
    triples: tuple[Triple, ...]
    iri: str
    versions: tuple[str, ...]
    imports: tuple[str, ...]


def read(path: Path) -> OwlFile:
    """Read and parse a file.

    Raises:
        InputError: if it cannot be opened or is too large, and as `parsed` does.
    """
    return parsed(path, read_bytes(path, MOST_BYTES))


def parsed(path: Path, content: bytes) -> OwlFile:
    """Parse a file; without a declared IRI, its IRI is its xml:base, or else its file: address.

    Raises:
        InputError: if it is neither RDF/XML nor Turtle, refers to another file, is too large, or
            names Python code to be run.
    """
    if len(content) > MOST_BYTES:
        fault = f"is larger than {MOST_BYTES >> 20} MB"
        raise InputError(printable(path), fault, "give a smaller part of it")
    return _parsed(path, content, path.absolute().as_uri())


@lru_cache(maxsize=8)
def _parsed(path: Path, content: bytes, here: str) -> OwlFile:
    where = printable(path)
    if is_xml(content, where):
        base = base_of_bounded(content, where)
        triples = _triples(content, "xml", "RDF/XML", here, where)
    else:
        base = ""
        triples = _triples(turtle_text(content, where), "turtle", "Turtle", here, where)
    for subject, relation, module in triples:
        if relation == _RUNS_PYTHON:
            fault = f"{ending(subject)} names Python code to be run, python_module {_shown(module)}"
            raise InputError(where, fault, "nothing in an ontology is run: take python_module out")
    declared = [s for s, p, o in triples if p == RDF.type and o == OWL.Ontology]
    names = [iri for iri in declared if isinstance(iri, URIRef)]
    return OwlFile(
        path,
        content,
        triples,
        (names[0] if names else base or here).rstrip("#"),
        tuple(str(o) for _, p, o in triples if p == OWL.versionIRI),
        tuple(dict.fromkeys(str(o) for _, p, o in triples if p == OWL.imports)),
    )


def ending(entity: str) -> str:
    """The last part of an IRI, to be shown to people; a blank node has none."""
    if isinstance(entity, BNode):
        return "something nameless"
    last = entity.rstrip("#/").replace("#", "/").rpartition("/")[2]
    return printable(last)[:LONGEST_FAULT] or "nameless"


class _Read(rdflib.Graph):
    """Collects triples from a parser, in the order of the file."""

    def __init__(self, where: str) -> None:
        super().__init__(bind_namespaces="none")
        self.where = where
        self.triples_read: dict[Triple, None] = {}

    def add(self, triple: Any) -> "_Read":
        self.triples_read[triple] = None
        if len(self.triples_read) > MOST_TRIPLES:
            fault = f"says more than {MOST_TRIPLES} things"
            raise InputError(self.where, fault, "give a smaller part of it")
        return self


def _triples(
    content: bytes | str, syntax: str, called: str, here: str, where: str
) -> tuple[Triple, ...]:
    graph = _Read(where)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            graph.parse(_source(content, here), format=syntax)
    except ExecutiveError:
        raise
    except RecursionError:
        raise InputError(where, "is nested too deep", "give what is inside a name") from None
    except Exception as error:  # on malformed input, parsers raise anything
        if isinstance(content, str) and (other := beyond_turtle(content)):
            raise InputError(where, f"is in {other}, which is not read", SAVE) from None
        fault = f"cannot be read as {called}: {_reason(error)}"
        raise InputError(where, fault) from None
    return tuple(graph.triples_read)


def _source(content: bytes | str, here: str) -> InputSource:
    """The input of a parser; bytes declare their encoding themselves."""
    source = InputSource()
    source.setPublicId(here)
    if isinstance(content, bytes):
        source.setByteStream(BytesIO(content))
    else:
        source.setCharacterStream(StringIO(content))
    return source


def _reason(error: Exception) -> str:
    """A parser's message on one line, without the parts of the file that rdflib quotes."""
    if isinstance(error, IndexError):
        return "it ends too early"
    if "integer string conversion" in str(error):
        return "it has a number of thousands of digits"
    line, why = getattr(error, "lines", None), getattr(error, "_why", None)
    said = f"line {line + 1}: {why}" if why and isinstance(line, int) else str(error)
    said = _AT.sub(r"line \1:", said)
    return _shown(said or type(error).__name__)


def _shown(text: str) -> str:
    return printable(text)[:LONGEST_FAULT]
