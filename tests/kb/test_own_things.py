"""Objects that a home declares are known like those of the files."""

from pathlib import Path

import pytest
from ontologies import OWL

from executive.errors import InputError
from executive.testing.bench import four_rooms
from executive.types.home import Thing
from kb.__main__ import main
from kb.ontology.ontology import Ontology

EXAMPLE = Path(__file__).parents[2] / "docs" / "examples" / "own_object.toml"
PLACES = four_rooms().places()
POT = """<owl:Class rdf:about="#Pot"><rdfs:label>pot</rdfs:label>
  <rdfs:subClassOf rdf:resource="http://robot-executive.org/household.owl#Kitchenware"/></owl:Class>"""


@pytest.fixture
def pot(tmp_path: Path) -> Path:
    """A person's own file that has a pot."""
    file = tmp_path / "pot.owl"
    file.write_text(OWL.format(POT))
    return file


def knowing(name: str, kind: str, *files: Path) -> Ontology:
    return Ontology(PLACES, things=[Thing(name, kind)], files=files)


def test_a_thing_goes_by_its_name_and_by_its_class() -> None:
    known = knowing("tea_pot", "Kitchenware")
    assert known.objects_named("the teapots") == ("tea_pot",)
    assert known.objects_named("kitchenware") == ("mug", "pitcher_base", "spatula", "tea_pot")
    assert known.classes_of("tea_pot") == ("kitchenware",)
    assert known.near_name("tea pott") == "tea_pot"
    assert list(known.faults()) == []


def test_a_thing_is_usually_where_things_of_its_class_are() -> None:
    assert knowing("plum", "Fruit").usual_places("plum") == Ontology(PLACES).usual_places("fruit")


def test_the_class_may_be_one_of_a_persons_own_file(pot: Path) -> None:
    known = knowing("teapot", "Pot", pot)
    assert known.objects_named("pot") == ("teapot",)
    assert known.classes_of("teapot") == ("pot", "kitchenware")


def test_what_a_persons_own_file_has_as_an_object_is_not_said_twice(pot: Path) -> None:
    assert knowing("pot", "Pot", pot).objects() == Ontology(PLACES, files=[pot]).objects()
    assert b"pot" not in knowing("pot", "Kitchenware", pot).files()["home.owl"]
    with pytest.raises(InputError, match="object pot: the ontology has a pot of this name"):
        knowing("pot", "Toy", pot)


@pytest.mark.parametrize(
    ("kind", "right"), [("Pot", "call it 'pot' if it is that one"), ("Toy", "give another name")]
)
def test_another_way_to_write_the_name_of_a_persons_object_is_told_how_it_is_written(
    pot: Path, kind: str, right: str
) -> None:
    with pytest.raises(InputError, match=f"the ontology has a pot of this name; {right}$"):
        knowing("Pots", kind, pot)


@pytest.mark.parametrize(
    ("name", "kind", "sentence"),
    [
        (
            "teapot",
            "Kitchnware",
            "object teapot: is a 'Kitchnware', which the ontology lacks; known",
        ),
        ("teapot", "Desk", "is a 'Desk', which is no kind of object; known are"),
        (
            "red_mug",
            "Mug",
            "is a Mug, which is an object itself; name the class above it, as Kitchen",
        ),
        ("cup", "Kitchenware", "object cup: the ontology has a mug of this name; give another"),
        ("fruit", "Food", "the ontology has a fruit of this name"),
        ("couch", "Toy", "the ontology has a sofa of this name"),
        ("the", "Toy", "this is no name of a thing"),
    ],
)
def test_a_thing_that_cannot_be_is_refused(name: str, kind: str, sentence: str) -> None:
    with pytest.raises(InputError) as refused:
        knowing(name, kind)
    assert sentence in str(refused.value)


@pytest.mark.parametrize(("name", "kind"), [("teapot", "Kitchnware"), ("cup", "Kitchenware")])
def test_the_file_of_the_home_is_named_where_a_thing_cannot_be(name: str, kind: str) -> None:
    with pytest.raises(InputError, match=rf"^homes/flat\.toml: object {name}: "):
        Ontology(PLACES, things=[Thing(name, kind)], home="homes/flat.toml")


def test_what_the_home_adds_to_the_ontology_is_kept_with_the_log(tmp_path: Path) -> None:
    (tmp_path / "flat.owl").write_bytes(knowing("red teapot", "Kitchenware").files()["home.owl"])
    known = Ontology(files=[tmp_path / "flat.owl"])
    assert known.classes_of("red teapot") == ("kitchenware",)


def test_a_home_with_a_thing_of_no_kind_of_object_is_named_on_the_command_line(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "flat.toml"
    file.write_text(EXAMPLE.read_text().replace('"Toy"', '"Desk"').replace("mesh =", "#"))
    assert main(["show", "mug", "--home", str(file)]) == 2
    said = f"error: {file}: object crate: is a 'Desk', which is no kind of object; known are"
    assert capsys.readouterr().err.startswith(said)


def test_show_knows_the_objects_of_a_home(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["show", "teapot", "--home", str(EXAMPLE)]) == 0
    shown = capsys.readouterr().out
    assert "is a         kitchenware" in shown
    assert "color        blue" in shown
