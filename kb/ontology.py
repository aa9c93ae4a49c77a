"""The ontology: which things there are, what they are called, and where they usually are."""

from collections.abc import Iterator, Mapping, Sequence
from io import BytesIO
from pathlib import Path
from typing import Any

import owlready2
from rapidfuzz import fuzz, process

from executive.errors import InputError
from executive.types import Place
from kb.faults import faults
from kb.names import MOST_WORDS, PlaceNames, index_by_words, spoken, unique, words_of
from kb.owl import downwards, label, leaves, load, read, upwards, values
from kb.sparql import Table, select

HOUSEHOLD = Path(__file__).with_name("household.owl")
DEFAULTS = Path(__file__).with_name("defaults.owl")
CLASSES = "http://robot-executive.org/household.owl#"
INDIVIDUALS = "http://robot-executive.org/home.owl#"
VOCABULARY = (
    *("Object", "Furniture", "Room", "Person"),
    *("isIn", "hasDefaultLocation", "preferredBy", "preposition"),
)
"""Classes and properties that household.owl, or what replaces it, has to declare."""
ALSO_CALLED = "http://www.w3.org/2004/02/skos/core#altLabel"
PREFIXES = {
    "household": CLASSES,
    "home": INDIVIDUALS,
    "skos": "http://www.w3.org/2004/02/skos/core#",
}
"""Names that a query may use without declaring them."""

MOST_NAMES = 3
LEAST_SIMILARITY = 60.0
"""Of 100, as rapidfuzz counts; below it two names share little but a few letters."""
SLIP_SIMILARITY, SLIP_MARGIN = 75.0, 10.0
"""A slip of the finger is as similar as this, and more similar by this than to anything else."""


class Ontology:
    """Implements `Knowledge` with OWL files and the furniture of one home.

    Objects are the leaf classes below `Object`. A default location is a class restriction
    `hasDefaultLocation value dining_table`; a thing takes them from its nearest class with any.
    """

    def __init__(
        self,
        places: Sequence[Place] = (),
        *,
        defaults: bool = True,
        files: Sequence[Path] = (),
        person: str | None = None,
    ) -> None:
        """Load household.owl, defaults.owl if wanted, then `files`, and put the furniture in.

        A file with the IRI of another ontology, such as one of ours, takes its place.

        Args:
            places: the furniture of the home.
            defaults: whether to load defaults.owl.
            files: a person's own OWL files, which add to ours or replace them.
            person: the name of who is at home, as the files have it.

        Raises:
            InputError: if a file is no ontology, imports one that is not loaded or is called like
                another; if what replaces household.owl lacks a name that every home needs, a place
                is of a class that the ontology does not have, or nobody knows the person.
        """
        self._world = owlready2.World()
        self._files: dict[str, bytes] = {}
        read_files = map(read, (HOUSEHOLD, *([DEFAULTS] if defaults else []), *files))
        for file in {file.iri: file for file in read_files}.values():
            if file.path.name in self._files:
                raise InputError(str(file.path), "another file has the same name", "rename one")
            load(self._world, file)
            self._files[file.path.name] = file.content
        self._expect_vocabulary()
        self._places = {place.name: place for place in places}
        self._order = {name: number for number, name in enumerate(self._places)}
        self._home = self._world.get_ontology(INDIVIDUALS)
        self._kinds = {
            root: {kind.name: kind for kind in downwards(self._class(root))}
            for root in ("Furniture", "Room")
        }
        with self._home:
            for place in places:
                self._add(place)
        self._things = tuple(downwards(self._class("Object")))
        self._things_by_name = {label(thing): thing for thing in reversed(self._things)}
        self._objects = leaves(self._class("Object"))
        self._objects_by_words = self._index()
        self._names_by_words = index_by_words(
            *(
                [
                    (words_of(name), label(thing))
                    for thing in self._things
                    for name in names_of(thing)
                ]
                for names_of in (lambda thing: (label(thing),), _names)
            )
        )
        self._person = self._person_named(person) if person else None
        self.place_names = PlaceNames(self.places(), self._called())
        """What the furniture and the rooms of the home are called."""

    # --- the Knowledge protocol ---

    def places(self) -> tuple[Place, ...]:
        """Every piece of furniture of the home, in the home file's order."""
        return tuple(self._places.values())

    def has_place(self, name: str) -> bool:
        """Whether a piece of furniture of this name is in the home."""
        return name in self._places

    def objects_named(self, words: str) -> tuple[str, ...]:
        """The objects that the words may mean: none, one, or all members of a class ("fruit").

        An object counts before a class, a name before a synonym.
        """
        return self._objects_by_words.get("".join(words_of(words)), ())

    def nearest_names(self, words: str) -> tuple[str, ...]:
        """Known names that look most like the words, best first (at most 3)."""
        return tuple(self._similar(words))[:MOST_NAMES]

    def near_name(self, words: str) -> str | None:
        """The one known name that the words are most likely a slip of, if it is clear."""
        (best, similarity), (_, next_best) = (*self._similar(words).items(), *2 * [("", 0.0)])[:2]
        clear = similarity >= SLIP_SIMILARITY and similarity - next_best >= SLIP_MARGIN
        return best if clear else None

    def names_in(self, words: str) -> tuple[str, ...]:
        """The names of objects and classes that a text has in it, in their order."""
        rest, found = list(words_of(words)), list[str]()
        while rest:
            for length in range(min(MOST_WORDS, len(rest)), 0, -1):
                if names := self._names_by_words.get("".join(rest[:length])):
                    found.append(names[0])
                    break
            del rest[:length]
        return unique(found)

    def usual_places(self, name: str) -> tuple[str, ...]:
        """Default locations of the object or its nearest class; those in this home only."""
        here = filter(self.has_place, self.default_locations(name))
        return tuple(sorted(here, key=self._order.__getitem__))

    def places_named(self, words: str) -> tuple[str, ...]:
        """Furniture that the words name, in their order; a room stands for its furniture."""
        return self.place_names.find(words)

    def preferred(self, names: Sequence[str]) -> tuple[str, ...]:
        """Those of the objects that the person at home prefers; none if nobody knows who it is."""
        return tuple(
            name
            for name in names
            if self._person and self._person in self._preferring(self._thing(name))
        )

    # --- more about things ---

    def objects(self) -> tuple[str, ...]:
        """Names of all objects, in the files' order."""
        return tuple(label(thing) for thing in self._objects)

    def classes_of(self, name: str) -> tuple[str, ...]:
        """What the classes above an object or a class are called, nearest first, less `Object`.

        Raises:
            InputError: if there is no such thing, here and below.
        """
        _, *above = upwards(self._thing(name))
        return tuple(label(c) for c in above if c is not self._class("Object"))

    def synonyms(self, name: str) -> tuple[str, ...]:
        """Other names of an object or a class."""
        return tuple(self._thing(name).altLabel)

    def default_locations(self, name: str) -> tuple[str, ...]:
        """Default locations of an object or its nearest class, in this home or not."""
        for thing in upwards(self._thing(name)):
            if usual := values(thing, self._class("hasDefaultLocation")):
                return tuple(place.name for place in usual if place is not None)
        return ()

    def recorded_locations(self) -> dict[str, tuple[str, ...]]:
        """Default locations of each object and class for which a file has some of its own."""
        usual = self._class("hasDefaultLocation")
        recorded = {
            label(thing): tuple(place.name for place in values(thing, usual) if place is not None)
            for thing in self._things
        }
        return {name: places for name, places in recorded.items() if places}

    def preferred_by(self, name: str) -> tuple[str, ...]:
        """The people who prefer an object or a class, of others like it."""
        return tuple(label(person) for person in self._preferring(self._thing(name)))

    def preposition(self, place: Place) -> str:
        """How things are with this piece of furniture: "in" or "on"."""
        given = (p for kind in upwards(self._class(place.kind)) for p in kind.preposition)
        return next(given, "on")

    def files(self) -> Mapping[str, bytes]:
        """The loaded files by name, and what the home adds to them, to be kept with the log."""
        home = BytesIO()
        self._home.save(home, format="rdfxml")
        return {**self._files, "home.owl": home.getvalue()}

    def faults(self) -> Iterator[str]:
        """What is wrong with the knowledge, a sentence each; nothing if it is sound."""
        return faults(self._world, CLASSES)

    def query(self, sparql: str) -> Table:
        """Answer a SELECT in SPARQL.

        Raises:
            InputError: if it cannot be read.
        """
        return select(self._world, sparql, PREFIXES)

    # --- inside ---

    def _expect_vocabulary(self) -> None:
        """Refuse an ontology without the names that this class is about."""
        for iri in (*(CLASSES + name for name in VOCABULARY), ALSO_CALLED):
            if self._world[iri] is None:
                right = f"keep {iri} as household.owl has it"
                raise InputError("ontology", f"declares no {iri.rpartition('#')[2]}", right)

    def _similar(self, words: str) -> dict[str, float]:
        """Names that look like the words, most similar first, and how similar (of 100)."""
        names = [(spoken(name), label(thing)) for thing in self._things for name in _names(thing)]
        found = process.extract(
            spoken(words),
            [name for name, _ in names],
            scorer=fuzz.token_sort_ratio,
            score_cutoff=LEAST_SIMILARITY,
            limit=None,
        )
        similar: dict[str, float] = {}
        for _, similarity, index in found:
            similar.setdefault(names[index][1], similarity)
        return similar

    def _class(self, name: str) -> Any:
        return self._world[CLASSES + name]

    def _thing(self, name: str) -> Any:
        if name in self._things_by_name:
            return self._things_by_name[name]
        right = f"known are {', '.join(label(thing) for thing in self._things)}"
        raise InputError("ontology", f"there is no {name!r}", right)

    def _preferring(self, thing: Any) -> list[Any]:
        return [person for person in values(thing, self._class("preferredBy")) if person]

    def _person_named(self, name: str) -> Any:
        people = {words_of(label(person)): person for person in self._class("Person").instances()}
        if words_of(name) in people:
            return people[words_of(name)]
        known = ", ".join(label(person) for person in people.values())
        right = f"known are {known}" if known else "declare them in an OWL file and give it as --kb"
        raise InputError(f"person {name}", "the ontology knows nobody of this name", right)

    def _add(self, place: Place) -> None:
        """Put a piece of furniture, and its room, in as individuals."""
        room = self._individual(place.room, place.room_kind, "Room")
        self._individual(place.name, place.kind, "Furniture").isIn = room

    def _individual(self, name: str, kind: str, root: str) -> Any:
        class_ = self._kinds[root].get(kind)
        if class_ is None:
            known = ", ".join(self._kinds[root])
            raise InputError(name, f"is a {kind!r}, which the ontology lacks", f"known are {known}")
        individual = self._world[INDIVIDUALS + name]
        if individual is None:
            return class_(name, namespace=self._home)
        individual.is_a = [class_]
        return individual

    def _index(self) -> dict[str, tuple[str, ...]]:
        """Words, run together -> names of the objects that they may mean."""
        classes = [thing for thing in self._things if thing not in self._objects]
        return index_by_words(
            [(words_of(label(thing)), label(thing)) for thing in self._objects],
            [(words_of(name), label(thing)) for thing in self._objects for name in thing.altLabel],
            [(words_of(label(c)), label(thing)) for c in classes for thing in leaves(c)],
            [
                (words_of(n), label(thing))
                for c in classes
                for n in c.altLabel
                for thing in leaves(c)
            ],
        )

    def _called(self) -> dict[str, tuple[str, ...]]:
        """Furniture or room class -> what it and the classes above it are called."""
        return {
            name: tuple(n for c in upwards(kind) if c.name not in self._kinds for n in _names(c))
            for kinds in self._kinds.values()
            for name, kind in kinds.items()
        }


def _names(entity: Any) -> tuple[str, ...]:
    """Label and synonyms."""
    return (label(entity), *entity.altLabel)
