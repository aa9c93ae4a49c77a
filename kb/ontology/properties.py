"""Properties of things in the ontology: appearance, use, and grammar of their names."""

from collections.abc import Iterable

from rdflib import Literal, URIRef
from rdflib.term import Identifier

from kb.ontology.graph import Graph, one_line, unusable
from kb.ontology.names import unique

COLOR, SHAPE, USE, PRONOUN, NUMBER = PROPERTIES = ("color", "shape", "use", "pronoun", "number")
"""Last parts of the properties' IRIs."""
PLURAL = "plural"
"""Value of `number`, as in "the scissors are"."""
SAID = (None, "en")
"""Languages of values that the robot says; values in others, even "en-US", are only understood."""


class Properties:
    """The properties of things.

    An ontology that does not declare them, as in old recordings, has no values.
    """

    def __init__(self, graph: Graph, namespace: str) -> None:
        """`namespace` is the IRI prefix of the properties."""
        self._graph = graph
        self._namespace = namespace

    def iri(self, name: str) -> URIRef:
        """The IRI of one of `PROPERTIES`."""
        return URIRef(self._namespace + name)

    def are_declared(self) -> bool:
        """Whether the ontology declares the property `color`."""
        return self._graph.is_declared(self.iri(COLOR))

    def nearest(self, thing: Identifier, name: str) -> tuple[Literal, ...]:
        """Values of a property of a thing or its nearest class with any, in all languages."""
        levels = (self._own(kind, name) for kind in self._graph.upwards(thing))
        return next(filter(None, levels), ())

    def every(self, thing: Identifier, name: str) -> tuple[Literal, ...]:
        """Values of a property of a thing and all its superclasses, in all languages."""
        levels = (self._own(kind, name) for kind in self._graph.upwards(thing))
        return tuple(dict.fromkeys(value for level in levels for value in level))

    def _own(self, kind: Identifier, name: str) -> tuple[Literal, ...]:
        given = self._graph.objects(kind, self.iri(name))
        return tuple(v for v in given if isinstance(v, Literal) and not unusable(one_line(v)))


def texts(values: Iterable[Literal]) -> tuple[str, ...]:
    """All values as text."""
    return unique(map(one_line, values))


def said(values: Iterable[Literal]) -> tuple[str, ...]:
    """The values to say: those in English, or all if there are none."""
    every = tuple(values)
    return texts(value for value in every if value.language in SAID) or texts(every)
