"""What the benchmark of common sense asks: things, where they may be, and where they are."""

from dataclasses import dataclass

from executive.language.phrases import spoken, words_of
from executive.types.home import Place
from kb.advice.ranking import Known, answer
from kb.benchmark.placements import Placements, preposition
from kb.ontology.ontology import Ontology

SURVEYED = """
SELECT DISTINCT ?name (STRAFTER(STR(?k), "#") AS ?kind) ?room (STRAFTER(STR(?r), "#") AS ?room_kind)
WHERE { ?name household:isIn ?room . ?name a ?k . ?k rdfs:subClassOf* household:Furniture .
        ?room a ?r . ?r rdfs:subClassOf* household:Room }
"""
HOME = ("home", "Room")
"""Where furniture is of which nobody says in which room."""


@dataclass(frozen=True, slots=True)
class Item:
    """Where is this thing? Its places are the right answer; others may be used to work it out."""

    thing: Known
    others: tuple[Known, ...] = ()


@dataclass(frozen=True, slots=True)
class DataSet:
    """Questions about the same places.

    Attributes:
        name: for the command line.
        title: one line about it.
        answers: each place, and the answer that stands for it when it is scored.
        questions: what is asked.
    """

    name: str
    title: str
    answers: tuple[tuple[Place, str], ...]
    questions: tuple[Item, ...]

    @property
    def places(self) -> tuple[Place, ...]:
        """Every place that an answer may name."""
        return tuple(place for place, _ in self.answers)


def survey(rest: bool = False) -> DataSet:
    """The paper's survey: one object of each row of its table, the furniture that it was about.

    The answers are our default locations, so nothing of them is known; or, for `rest`, all rows but
    the one that is asked for.
    """
    told = Ontology()
    places = [Place(*map(str, row)) for row in told.query(SURVEYED).rows]
    ontology = Ontology(places, defaults=False)
    rows = [Known(name, told.classes_of(name)[0], told.among(name)) for name in _rows(told)]
    return DataSet(
        "survey-rest" if rest else "survey",
        "the paper's survey, "
        + ("the other rows are recorded" if rest else "no default location is recorded"),
        tuple((place, answer(place, ontology.preposition(place))) for place in places),
        tuple(Item(row, tuple(other for other in rows if rest and other != row)) for row in rows),
    )


def placements(data: Placements, fold: str, new: bool = False) -> DataSet:
    """One fold of the placements; those of the train fold are known.

    The folds share many nouns: "white shirt", "blue shirt". `new` leaves only things whose noun
    (last word) no known thing has.
    """
    known = data.folds["train"]
    nouns = {words_of(thing.name)[-1] for thing in known} if new else set()
    return DataSet(
        f"placements-{fold}" + ("-new" if new else ""),
        f"TextWorld Commonsense, {fold} fold, {len(known)} other things recorded"
        + (", of other nouns" if new else ""),
        tuple(
            (Place(name, "Furniture", *HOME), f"{preposition(name)} the {spoken(name)}")
            for name in data.places()
        ),
        tuple(
            Item(thing, known)
            for thing in data.folds[fold]
            if words_of(thing.name)[-1] not in nouns
        ),
    )


def _rows(ontology: Ontology) -> tuple[str, ...]:
    """One object of each row: a class of which all objects have the same default locations."""
    rows: dict[str, str] = {}
    for name in ontology.objects():
        if ontology.among(name):
            above = ontology.classes_of(name)[0]
            rows.setdefault(above if ontology.among(above) else name, name)
    return tuple(rows.values())
