"""Detects the syntax of an ontology from its beginning; file name endings are not reliable."""

import re
from codecs import BOM_UTF8, BOM_UTF16_BE, BOM_UTF16_LE

from executive.errors import InputError
from executive.text import printable

SAVE = 'save it as RDF/XML or Turtle (in Protégé: File, Save as, "RDF/XML Syntax")'
"""The advice if a syntax is not supported."""
START = 10_000
"""Bytes used to detect the syntax; a comment before the ontology may be as long."""
MOST_ESCAPES = 100_000
"""Backslashes in a Turtle file: rdflib takes quadratic time for those in one string."""

_XML = re.compile(r"<(?:\?xml|!|rdf:RDF\b|[A-Za-z_][\w.:-]*(?:\s|/>)|[A-Za-z_][\w.-]*>)")
"""Turtle may begin with `<urn:x>`, which is no element, because nothing says what `urn` is."""
_PACKED = b"\x1f\x8b", b"PK\x03\x04", b"BZh", b"\xfd7zXZ\0"
"""How files begin that gzip, zip, bzip2 and xz make."""
_PAGE = re.compile(r"<!doctype\s+html|<html\b", re.IGNORECASE)
_OTHERS = (
    ("OWL functional syntax", re.compile(r"(?:Prefix|Ontology)\s*\(")),
    ("Manchester syntax", re.compile(r"(?:Prefix|Ontology|Namespace)\s*:")),
    ("JSON-LD", re.compile(r"\{\s*[\"}]|\[\s*\{")),
    ("TriG", re.compile(r"\{|GRAPH\s", re.IGNORECASE)),
    ("OBO", re.compile(r"format-version\s*:|\[Term\]")),
)
_BRACES = re.compile(
    r"^[ \t]*(?:GRAPH[ \t]+)?(?:<[^<>\n]*>|[\w.-]*:[\w.-]*)?[ \t]*\{", re.IGNORECASE | re.MULTILINE
)
_QUADS = re.compile(r"^(?:<[^<>\s]*>|_:\S+) <[^<>\s]*> \S.* <[^<>\s]*> \.[ \t]*$", re.MULTILINE)
_TURTLE = re.compile(r"@?(?:prefix|base)\b|<|_:|\[|\(|\w*:\w", re.IGNORECASE)


def is_xml(content: bytes, where: str) -> bool:
    """Whether the content is XML; else it is Turtle, which includes N-Triples.

    Raises:
        InputError: if it is neither; the message says what would be right.
    """
    if content.startswith(_PACKED):
        raise InputError(where, "is compressed", "unpack it, and name the file that was in it")
    start = _without_comments(_decoded(content[:START], "replace"))
    if _PAGE.match(start):
        raise InputError(where, "is a web page (HTML), no ontology", f"get the file itself; {SAVE}")
    if _XML.match(start):
        return True
    for name, begins in _OTHERS:
        if begins.match(start):
            raise InputError(where, f"is in {name}, which is not read", SAVE)
    if not _TURTLE.match(start):
        begins_with = f"begins with {printable(start[:30])!r}" if start else "is empty"
        raise InputError(where, f"is no ontology: it {begins_with}", SAVE)
    return False


def beyond_turtle(text: str) -> str | None:
    """The syntax of a text that begins like Turtle but is not; None if it is Turtle."""
    if _BRACES.search(text):
        return "Notation3" if "=>" in text else "TriG"
    return "N-Quads" if _QUADS.search(text) else None


def turtle_text(content: bytes, where: str) -> str:
    """Decode a Turtle file.

    Raises:
        InputError: if it is not UTF-8, or has too many escapes.
    """
    try:
        text = _decoded(content, "strict")
    except UnicodeDecodeError as error:
        fault = f"is no UTF-8 text: byte {error.start} is none of it"
        raise InputError(where, fault, "save it as UTF-8") from None
    if text.count("\\") > MOST_ESCAPES:
        fault = f"has more than {MOST_ESCAPES} escapes"
        raise InputError(where, fault, "write the characters themselves")
    return text


def _decoded(content: bytes, errors: str) -> str:
    for mark, encoding in ((BOM_UTF16_LE, "utf-16"), (BOM_UTF16_BE, "utf-16")):
        if content.startswith(mark):
            return content.decode(encoding, errors)
    return content.removeprefix(BOM_UTF8).decode("utf-8", errors)


def _without_comments(text: str) -> str:
    """The text without leading blank and comment lines (`# ...`)."""
    lines = text.lstrip().splitlines()
    while lines and (not lines[0].strip() or lines[0].lstrip().startswith("#")):
        del lines[0]
    return "\n".join(lines).lstrip()
