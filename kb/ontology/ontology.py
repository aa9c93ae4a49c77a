"""The ontology: which things there are, what they are called, and where they usually are."""

from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from pathlib import Path

from rdflib import URIRef
from rdflib.term import Identifier

from executive.errors import InputError
from executive.language.phrases import MOST_WORDS, spoken, words_of
from executive.text import printable
from executive.types.home import Called, OtherColor, Place, Thing
from kb.ontology.additions import INDIVIDUALS, HomeAdditions
from kb.ontology.descriptions import Descriptions, Look
from kb.ontology.graph import Graph
from kb.ontology.library import Library
from kb.ontology.names import PlaceNames, index_by_words, unique
from kb.ontology.owl import OwlFile, ending, read
from kb.ontology.properties import (
    COLOR,
    NUMBER,
    PLURAL,
    PRONOUN,
    SHAPE,
    USE,
    Properties,
    said,
    texts,
)
from kb.ontology.similarity import SimilarNames
from kb.ontology.speaking import places_called, thing_called
from kb.ontology.table import Table
from kb.ontology.unused import unused
from kb.ontology.uses import Uses
from kb.ontology.usual import kind_of, meant_here, standing_for
from kb.ontology.validation import ROOTS, faults

HOUSEHOLD = Path(__file__).parents[1] / "household.owl"
DEFAULTS = Path(__file__).parents[1] / "defaults.owl"
CLASSES = "http://robot-executive.org/household.owl#"
VOCABULARY = (
    *("Object", "Furniture", "Room", "Person"),
    *("isIn", "hasDefaultLocation", "preferredBy", "preposition"),
)
"""Classes and properties that household.owl, or its replacement, must declare."""
ALSO_CALLED = "http://www.w3.org/2004/02/skos/core#altLabel"
PREFIXES = {
    "household": CLASSES,
    "home": INDIVIDUALS,
    "skos": "http://www.w3.org/2004/02/skos/core#",
}
"""Prefixes that a query need not declare."""

PREPOSITIONS = ("in", "on")


class Ontology:
    """Implements `Knowledge` with OWL files and the furniture of one home.

    Objects are the leaf classes below `Object`. A default location is a class restriction
    `hasDefaultLocation value dining_table`; a thing inherits those of its nearest class with any.
    """

    def __init__(
        self,
        places: Sequence[Place] = (),
        *,
        things: Sequence[Thing] = (),
        defaults: bool = True,
        files: Sequence[Path | OwlFile] = (),
        person: str | None = None,
        home: str = "",
    ) -> None:
        """Load household.owl, defaults.owl if wanted, then `files`; add the furniture.

        A file with the IRI of an earlier one, such as one of ours, replaces it.

        Args:
            places: the furniture of the home.
            things: the objects that the home declares; each becomes a class below the one it names.
            defaults: whether to load defaults.owl.
            files: the user's OWL files, as paths or parsed; they add to ours or replace them.
            person: the name of the person at home, as in the files.
            home: the home file, for error messages.

        Raises:
            InputError: if a file is not an ontology, or two have the same name; if what replaces
                household.owl lacks a required name; if a place or a thing has an unknown class;
                if a thing has the name of something else; or if the person is unknown.
        """
        self._library = _library(defaults, files)
        self._graph = Graph(t for file in self._library.files for t in file.triples)
        self._expect_vocabulary()
        self._graph.expect_bounded([_class(root) for root in ROOTS])
        self._places = {place.name: place for place in places}
        self._usual_places: dict[str, tuple[str, ...]] = {}
        """Cache of `usual_places`."""
        self._order = {name: number for number, name in enumerate(self._places)}
        self._home = HomeAdditions(self._graph, CLASSES, home)
        for place in places:
            self._home.add_furniture(place)
        for own in things:
            self._home.add_thing(own)
        self._properties = Properties(self._graph, CLASSES)
        label = self._graph.label
        self._things = tuple(self._graph.downwards(_class("Object")))
        self._things_by_name = {label(thing): thing for thing in reversed(self._things)}
        self._objects = self._graph.leaves(_class("Object"))
        self._objects_by_words = self._index_of_objects()
        self._descriptions = self._describe()
        self._uses = Uses(
            (label(thing), texts(self._properties.every(thing, USE))) for thing in self._objects
        )
        self._names_by_words = self._index_of_names()
        self._person = self._person_named(person) if person else None
        self.place_names = PlaceNames(self.places(), self._called())
        """The names of the furniture and the rooms."""
        prepositions = {place.kind: self.preposition(place) for place in self.places()}
        self._places_called = places_called(self.places(), prepositions)

    def names(self) -> tuple[str, ...]:
        """All names of things and places."""
        return self._names

    @cached_property
    def _names(self) -> tuple[str, ...]:
        things = (name for thing in self._things for name in self._graph.names(thing))
        furniture = (name for names in self._called().values() for name in names)
        places = (name for place in self.places() for name in (place.name, place.room))
        return unique(spoken(name) for name in (*things, *furniture, *places))

    # --- the Knowledge protocol ---

    def places(self) -> tuple[Place, ...]:
        """All furniture of the home, in the order of the home file."""
        return tuple(self._places.values())

    def has_place(self, name: str) -> bool:
        """Whether the home has a piece of furniture of this name."""
        return name in self._places

    def called(self, name: str) -> Called | None:
        """How to say an object, a class or a piece of furniture; None if it is unknown."""
        if name in self._places_called:
            return self._places_called[name]
        thing = self._things_by_name.get(name)
        if thing is None:
            return None
        plural = PLURAL in texts(self._properties.nearest(thing, NUMBER))
        return thing_called(name, plural=plural, is_class=thing not in self._objects)

    def objects_named(self, words: str) -> tuple[str, ...]:
        """The objects that the words may mean: none, one, or several ("fruit", "the red one").

        Objects take precedence over classes, names over synonyms, and any name over appearance:
        "the orange" is the fruit.
        """
        named = self._objects_by_words.get("".join(words_of(words)), ())
        return named or self._descriptions.find(words)

    def other_color(self, words: str) -> OtherColor | None:
        """The objects meant if the words are wrong about the colour: "blue mug", and it is red."""
        return self._descriptions.other_color(words)

    def objects_for(self, purpose: str) -> tuple[str, ...]:
        """The objects for a purpose: "to drink from", "clean the bathroom with", "nails"."""
        return self._uses.serving(purpose)

    def nearest_names(self, words: str) -> tuple[str, ...]:
        """Known names that are most similar to the words, best first (at most 3)."""
        return self._similar.nearest(words)

    def near_name(self, words: str) -> str | None:
        """The known name that the words misspell; None if it is not clear."""
        return self._similar.slip(words)

    @cached_property
    def _similar(self) -> SimilarNames:
        graph = self._graph
        return SimilarNames((n, graph.label(one)) for one in self._things for n in graph.names(one))

    def names_in(self, words: str) -> tuple[str, ...]:
        """The names of objects and classes in a text, in its order."""
        rest, found = list(words_of(words)), list[str]()
        while rest:
            for length in range(min(MOST_WORDS, len(rest)), 0, -1):
                if names := self._names_by_words.get("".join(rest[:length])):
                    found.append(names[0])
                    break
            del rest[:length]
        return unique(found)

    def usual_places(self, name: str) -> tuple[str, ...]:
        """Default locations of the object or its nearest class, within this home."""
        if name not in self._usual_places:
            here = filter(self.has_place, self.among(name))
            self._usual_places[name] = tuple(sorted(here, key=self._order.__getitem__))
        return self._usual_places[name]

    def likely_places(self, name: str) -> Mapping[str, float]:
        """The share of the default locations that each place of this home represents."""
        named = self._default_locations(name)
        kinds = {ending(p): kind_of(p, self._graph, _class("isIn")) for p in named}
        return standing_for(kinds, self.places(), self._meant_here)

    @cached_property
    def _meant_here(self) -> dict[str, float]:
        recorded = {place for places in self.recorded_locations().values() for place in places}
        relation = _class("hasDefaultLocation")
        return meant_here(self._library.files, recorded, relation, self._places)

    def places_named(self, words: str) -> tuple[str, ...]:
        """Furniture that the words name, in their order; for a room, all its furniture."""
        return self.place_names.find(words)

    def is_place(self, words: str) -> bool:
        """Whether the words name furniture or rooms, and nothing else (no "Anna in the hall")."""
        return self.place_names.covers(words)

    def preferred(self, names: Sequence[str]) -> tuple[str, ...]:
        """The objects that the person at home prefers; none if that person is not known."""
        return tuple(
            name
            for name in names
            if self._person and self._person in self._preferring(self._thing(name))
        )

    # --- more about things ---

    def objects(self) -> tuple[str, ...]:
        """Names of all objects, in the order of the files."""
        return tuple(map(self._graph.label, self._objects))

    def classes_of(self, name: str) -> tuple[str, ...]:
        """Names of the superclasses of an object or a class, nearest first, without `Object`.

        Raises:
            InputError: if there is no such object or class (as in the methods below).
        """
        _, *above = self._graph.upwards(self._thing(name))
        return tuple(self._graph.label(c) for c in above if c != _class("Object"))

    def class_of(self, name: str) -> str:
        """Name of the nearest class of an object; empty if it has none, or is unknown."""
        return next(iter(self.classes_of(name)), "") if name in self._object_names else ""

    @cached_property
    def _object_names(self) -> frozenset[str]:
        return frozenset(self.objects())

    def synonyms(self, name: str) -> tuple[str, ...]:
        """Other names of an object or a class, in any language."""
        return self._graph.called(self._thing(name)).synonyms

    def colors(self, name: str) -> tuple[str, ...]:
        """Colours of an object or its nearest class, main colour first, to be said to a person."""
        return said(self._properties.nearest(self._thing(name), COLOR))

    def shapes(self, name: str) -> tuple[str, ...]:
        """Shapes or packages of an object or its nearest class, to be said to a person."""
        return said(self._properties.nearest(self._thing(name), SHAPE))

    def uses(self, name: str) -> tuple[str, ...]:
        """Uses of an object or a class: its own first, then those of its superclasses."""
        return said(self._properties.every(self._thing(name), USE))

    def among(self, name: str) -> tuple[str, ...]:
        """Default locations of an object or its nearest class, whether in this home or not."""
        return tuple(map(ending, self._default_locations(name)))

    def recorded_locations(self) -> dict[str, tuple[str, ...]]:
        """Default locations by object or class, for those that have some of their own in a file."""
        recorded = {self._graph.label(thing): self._locations(thing) for thing in self._things}
        return {name: tuple(map(ending, places)) for name, places in recorded.items() if places}

    def preferred_by(self, name: str) -> tuple[str, ...]:
        """The people who prefer this object or class."""
        return tuple(map(self._graph.label, self._preferring(self._thing(name))))

    def preposition(self, place: Place) -> str:
        """The preposition of a piece of furniture: "in" or "on"."""
        kinds = self._graph.upwards(self._home.kinds["Furniture"][place.kind])
        given = (str(p) for kind in kinds for p in self._graph.objects(kind, _class("preposition")))
        return next(filter(PREPOSITIONS.__contains__, given), "on")

    def files(self) -> Mapping[str, bytes]:
        """Contents of the loaded files and of the home's additions, by file name, for the log."""
        return {**self._library.contents(), "home.owl": self._home.file()}

    def faults(self) -> Iterator[str]:
        """A sentence for each fault of the ontology; none if it is valid."""
        return faults(self._graph, CLASSES, imports_met=not self.unmet_imports())

    def home_faults(
        self, places: Sequence[Place], things: Sequence[Thing], home: str
    ) -> Iterator[InputError]:
        """The faults of another home (of this file), if it were added; nothing is added."""
        graph = Graph(t for file in self._library.files for t in file.triples)
        return HomeAdditions(graph, CLASSES, home).faults(places, things)

    def unused(self) -> Iterator[str]:
        """Sentences about what the files state and the robot does not use."""
        return unused(self._graph, CLASSES)

    def unmet_imports(self) -> tuple[str, ...]:
        """A sentence for each import that is not loaded; nothing is fetched."""
        return tuple(self._library.unmet_imports())

    def warnings(self) -> tuple[str, ...]:
        """Sentences about imports that are not loaded, and files that add less than expected."""
        graph, roots = self._graph, list(map(_class, ROOTS))
        kinds = {kind for root in roots for kind in graph.downwards(root)}
        individuals = {one for root in roots for one in graph.instances(root)}
        return tuple(self._library.warnings(kinds | individuals))

    def query(self, sparql: str) -> Table:
        """Answer a SPARQL SELECT query.

        Raises:
            InputError: if it cannot be parsed, or takes too long.
        """
        from kb.ontology.sparql import select  # the engine loads slowly, and missions ask nothing

        return select(self._graph, sparql, PREFIXES)

    # --- inside ---

    def _expect_vocabulary(self) -> None:
        """Raise an InputError if a class or property that this class needs is not declared."""
        for iri in (*map(_class, VOCABULARY), URIRef(ALSO_CALLED)):
            if not self._graph.is_declared(iri):
                right = f"keep {iri} as household.owl has it"
                raise InputError("ontology", f"declares no {ending(iri)}", right)

    def _thing(self, name: str) -> Identifier:
        if name in self._things_by_name:
            return self._things_by_name[name]
        right = f"known are {', '.join(map(self._graph.label, self._things))}"
        raise InputError("ontology", f"there is no {printable(name)!r}", right)

    def _default_locations(self, name: str) -> list[Identifier]:
        for thing in self._graph.upwards(self._thing(name)):
            if self._graph.values(thing, _class("hasDefaultLocation")):
                return self._locations(thing)
        return []

    def _locations(self, thing: Identifier) -> list[Identifier]:
        """The declared default locations of this thing itself."""
        usual = self._graph.values(thing, _class("hasDefaultLocation"))
        return [place for place in usual if self._graph.is_declared(place)]

    def _preferring(self, thing: Identifier) -> list[Identifier]:
        people = self._graph.values(thing, _class("preferredBy"))
        return [person for person in people if self._graph.is_declared(person)]

    def _person_named(self, name: str) -> Identifier:
        label = self._graph.label
        everyone = self._graph.instances(_class("Person"))
        people = {words_of(label(person)): person for person in everyone}
        if words_of(name) in people:
            return people[words_of(name)]
        known = ", ".join(map(label, people.values()))
        right = f"known are {known}" if known else "declare them in an OWL file and give it as --kb"
        where = f"person {printable(name)}"
        raise InputError(where, "the ontology knows nobody of this name", right)

    def _index_of_names(self) -> dict[str, tuple[str, ...]]:
        """Map words, joined to one, to the names of the things and classes that have them."""
        label, names = self._graph.label, self._graph.names
        return index_by_words(
            [(words_of(label(thing)), label(thing)) for thing in self._things],
            [(words_of(name), label(thing)) for thing in self._things for name in names(thing)],
        )

    def _index_of_objects(self) -> dict[str, tuple[str, ...]]:
        """Map words, joined to one, to the names of the objects that they may mean."""
        graph, known = self._graph, set(self._objects)
        objects = [(graph.called(thing), graph.label(thing)) for thing in self._objects]
        members = [
            (graph.called(kind), graph.label(thing))
            for kind in self._things
            if kind not in known
            for thing in graph.leaves(kind)
        ]
        return index_by_words(
            [(words_of(called.name), name) for called, name in objects],
            [(words_of(n), name) for called, name in objects for n in called.synonyms],
            [(words_of(called.name), name) for called, name in members],
            [(words_of(n), name) for called, name in members for n in called.synonyms],
        )

    def _describe(self) -> Descriptions:
        """The appearance of the objects."""
        looks = []
        for thing in self._objects:
            colors = self._properties.nearest(thing, COLOR)
            shapes = texts(self._properties.nearest(thing, SHAPE))
            looks.append(Look(self._graph.label(thing), texts(colors), shapes, said(colors)))
        pronouns = texts(self._properties.every(_class("Object"), PRONOUN))
        return Descriptions(self._objects_by_words, looks, pronouns)

    def _called(self) -> dict[str, tuple[str, ...]]:
        """Map furniture and room classes to their names and those of their superclasses."""
        graph, roots = self._graph, {_class(root) for root in self._home.kinds}
        return {
            name: tuple(n for c in graph.upwards(kind) if c not in roots for n in graph.names(c))
            for kinds in self._home.kinds.values()
            for name, kind in kinds.items()
        }


def _library(defaults: bool, files: Sequence[Path | OwlFile]) -> Library:
    """Our files and the user's; a file with the IRI of one of ours replaces it."""
    paths = (HOUSEHOLD, *([DEFAULTS] if defaults else []), *files)
    read_files = (file if isinstance(file, OwlFile) else read(file) for file in paths)
    return Library(read_files, replaceable=(HOUSEHOLD.name, DEFAULTS.name))


def _class(name: str) -> URIRef:
    return URIRef(CLASSES + name)
