"""Finds colours, shapes and uses that are stated in a way that has no effect."""

from collections.abc import Iterator

from rdflib import XSD, Literal, URIRef
from rdflib.term import Identifier

from executive.text import printable
from kb.ontology.graph import Graph, one_line, unusable
from kb.ontology.owl import ending
from kb.ontology.properties import NUMBER, PLURAL, PRONOUN, PROPERTIES, SAID, USE
from kb.ontology.uses import PURPOSE_WORDS

MOST_SHOWN = 40
_TEXTS = (None, XSD.string, XSD.normalizedString, XSD.token)


def misuse(graph: Graph, namespace: str, root: Identifier) -> Iterator[str]:
    """Each misuse, with what would be right.

    Args:
        graph: the triples of the loaded files.
        namespace: the IRI prefix of the properties.
        root: the class of all objects.
    """
    for thing in graph.downwards(root):
        for name in PROPERTIES:
            for value in graph.objects(thing, URIRef(namespace + name)):
                if fault := _fault(name, value, of_root=thing == root):
                    yield f"{ending(thing)} {fault}"


def _fault(name: str, value: Identifier, *, of_root: bool) -> str | None:
    if name == PRONOUN and not of_root:
        return "has a pronoun, which stands for any object: say it of Object, or make it a name"
    if not isinstance(value, Literal) or value.datatype not in _TEXTS:
        shown = printable(ending(value))[:MOST_SHOWN]
        return f"has the {name} {shown}, which is no text: write it in words"
    text = one_line(value)
    shown = f"has the {name} {printable(text)[:MOST_SHOWN]!r}, which"
    if why := unusable(text):
        return f"{shown} {why}"
    if name == NUMBER and text not in (PLURAL, "singular"):
        return f"{shown} is no number: write {PLURAL}, or leave it out"
    begins = text.casefold().startswith(tuple(f"{word} " for word in PURPOSE_WORDS))
    if name == USE and value.language in SAID and not begins:
        return f"{shown} does not say a purpose: write to ... or for ..."
    return None
