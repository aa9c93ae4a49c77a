"""What things look like and are for, and how one speaks of them, as far as the files say."""

from collections.abc import Iterable

from rdflib import Literal, URIRef
from rdflib.term import Identifier

from kb.ontology.graph import Graph, one_line, unusable
from kb.ontology.names import unique

COLOR, SHAPE, USE, PRONOUN, NUMBER = PROPERTIES = ("color", "shape", "use", "pronoun", "number")
"""The ends of their IRIs."""
PLURAL = "plural"
"""As a number: one says "the scissors are"."""
SAID = (None, "en")
"""Languages of what is also said; "en-US" is one that is only understood."""


class Properties:
    """Colours, shapes and uses of things.

    An ontology without these properties, as old recordings have it, gives none.
    """

    def __init__(self, graph: Graph, namespace: str) -> None:
        """`namespace` is where the properties are."""
        self._graph = graph
        self._namespace = namespace

    def iri(self, name: str) -> URIRef:
        """Of one of `PROPERTIES`."""
        return URIRef(self._namespace + name)

    def are_declared(self) -> bool:
        """Whether the ontology knows of colours."""
        return self._graph.is_declared(self.iri(COLOR))

    def nearest(self, thing: Identifier, name: str) -> tuple[Literal, ...]:
        """What a thing, or else its nearest class that has any, has of it, in any language."""
        levels = (self._own(kind, name) for kind in self._graph.upwards(thing))
        return next(filter(None, levels), ())

    def every(self, thing: Identifier, name: str) -> tuple[Literal, ...]:
        """What a thing and all classes above it have of it, in any language."""
        levels = (self._own(kind, name) for kind in self._graph.upwards(thing))
        return tuple(dict.fromkeys(value for level in levels for value in level))

    def _own(self, kind: Identifier, name: str) -> tuple[Literal, ...]:
        given = self._graph.objects(kind, self.iri(name))
        return tuple(v for v in given if isinstance(v, Literal) and not unusable(one_line(v)))


def texts(values: Iterable[Literal]) -> tuple[str, ...]:
    """All that is understood."""
    return unique(map(one_line, values))


def said(values: Iterable[Literal]) -> tuple[str, ...]:
    """Those that are said: English ones, or all if there are none."""
    every = tuple(values)
    return texts(value for value in every if value.language in SAID) or texts(every)
