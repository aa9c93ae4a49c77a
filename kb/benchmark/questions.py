"""The questions of the common-sense benchmark: things, possible places, and right places."""

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
"""The room of furniture for which no room is given."""


@dataclass(frozen=True, slots=True)
class Item:
    """Where is this thing? Its places are the right answer; `others` may serve as precedents."""

    thing: Known
    others: tuple[Known, ...] = ()


@dataclass(frozen=True, slots=True)
class DataSet:
    """Questions about the same set of places.

    Attributes:
        name: for the command line.
        title: a one-line description.
        answers: each place, with the answer that is scored for it.
        questions: the questions.
    """

    name: str
    title: str
    answers: tuple[tuple[Place, str], ...]
    questions: tuple[Item, ...]

    @property
    def places(self) -> tuple[Place, ...]:
        """All places that an answer may name."""
        return tuple(place for place, _ in self.answers)


def survey(rest: bool = False) -> DataSet:
    """The paper's survey: one object from each row of its table, with the surveyed furniture.

    The right answers are our default locations, so these are not given; with `rest`, those of all
    other rows are.
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
    """One fold of the placements; the train fold is given as precedents.

    The folds share many nouns: "white shirt", "blue shirt". `new` keeps only things whose noun
    (last word) is that of no precedent.
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
    """One object for each row: a class whose objects all have the same default locations."""
    rows: dict[str, str] = {}
    for name in ontology.objects():
        if ontology.among(name):
            above = ontology.classes_of(name)[0]
            rows.setdefault(above if ontology.among(above) else name, name)
    return tuple(rows.values())
