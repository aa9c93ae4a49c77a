"""Things are found by what they look like and what they are for."""

from collections import Counter
from pathlib import Path

import pytest
from ontologies import OWL
from PIL import Image

from executive.colors import color_name
from executive.testing.bench import four_rooms, ontology
from executive.types.home import OtherColor, Thing
from kb.__main__ import main
from kb.ontology.ontology import HOUSEHOLD, Ontology
from kb.ontology.uses import purpose_of

KNOWN = ontology(True)
MESHES = Path(__file__).parents[2] / "sim" / "assets" / "objects"
BOTTLES = ("mustard_bottle", "bleach_cleanser")
RED = ("apple", "strawberry", "cracker_box", "tomato_soup_can", "mug", "colored_wood_blocks")
ORANGE = ("orange", "peach", "power_drill", "scissors")
HOUSEHOLDS = "http://robot-executive.org/household.owl#"


def of_mug(said: str) -> str:
    return OWL.format(f'<owl:Class rdf:about="{HOUSEHOLDS}Mug">{said}</owl:Class>')


@pytest.mark.parametrize("name", KNOWN.objects())
def test_everything_has_a_color_a_shape_and_a_use(name: str) -> None:
    assert KNOWN.colors(name)
    assert KNOWN.shapes(name)
    assert KNOWN.uses(name)


BETWEEN_YELLOW_AND_GREEN = {"pear"}


@pytest.mark.parametrize("name", sorted({*KNOWN.objects()} - BETWEEN_YELLOW_AND_GREEN))
def test_the_chief_color_is_that_of_the_mesh(name: str) -> None:
    with Image.open(MESHES / name / "textured.png") as picture:
        shown = picture.convert("RGB").resize((64, 64)).tobytes()
    pixels = zip(shown[::3], shown[1::3], shown[2::3], strict=True)
    counted = Counter(color_name(r / 255, g / 255, b / 255) for r, g, b in pixels)
    assert counted[KNOWN.colors(name)[0]] > 0.2 * 64 * 64


@pytest.mark.parametrize(
    ("words", "objects"),
    [
        ("the yellow bottle", ("mustard_bottle",)),
        ("the red one", RED),
        ("red things", RED),
        ("something red", RED),
        ("red", RED),
        ("the red mug", ("mug",)),
        ("a red can of tomato soup", ("tomato_soup_can",)),
        ("the yellow fruit", ("banana",)),
        ("the round one", ("apple", "orange", "peach", "tomato_soup_can", "tennis_ball")),
        ("gray hammer", ("hammer",)),
        ("bottles", BOTTLES),
        ("tins", ("tomato_soup_can", "potted_meat_can")),
        ("the blue can", ("potted_meat_can",)),
        ("colourful blocks", ("colored_wood_blocks",)),
    ],
)
def test_things_are_found_by_what_they_look_like(words: str, objects: tuple[str, ...]) -> None:
    assert KNOWN.objects_named(words) == objects


@pytest.mark.parametrize(
    ("words", "objects"),
    [
        ("the orange", ("orange",)),
        ("the oranges", ("orange",)),
        ("the orange one", ORANGE),
        ("something orange", ORANGE),
        ("an orange orange", ("orange",)),
        ("the orange fruit", ("orange", "peach")),
        ("the ball", ("tennis_ball",)),
        ("a cup", ("mug",)),
    ],
)
def test_a_name_stays_a_name_though_it_is_a_property_too(
    words: str, objects: tuple[str, ...]
) -> None:
    assert KNOWN.objects_named(words) == objects


@pytest.mark.parametrize(
    "words", ["the big red mug", "red mug and apple", "something", "the one", "red mug bottle"]
)
def test_words_that_are_not_understood_describe_nothing(words: str) -> None:
    assert KNOWN.objects_named(words) == ()
    assert KNOWN.other_color(words) is None


@pytest.mark.parametrize(
    ("words", "wanted", "actual"),
    [
        ("a blue mug", ("blue",), [("mug", ("red",))]),
        ("the purple mug", ("purple",), [("mug", ("red",))]),
        ("red bottle", ("red",), [(BOTTLES[0], ("yellow",)), (BOTTLES[1], ("white", "blue"))]),
    ],
)
def test_it_is_known_what_has_another_color(
    words: str, wanted: tuple[str, ...], actual: list[tuple[str, tuple[str, ...]]]
) -> None:
    assert KNOWN.objects_named(words) == ()
    assert KNOWN.other_color(words) == OtherColor(wanted, tuple(actual))


@pytest.mark.parametrize("words", ["a red mug", "mug", "unicorn", "blue unicorn", "a purple one"])
def test_no_other_color_is_told_of_what_is_found_or_unknown(words: str) -> None:
    assert KNOWN.other_color(words) is None


@pytest.mark.parametrize(
    ("purpose", "objects"),
    [
        ("to drink from", ("mug", "pitcher_base")),
        ("drink water from", ("mug", "pitcher_base")),
        ("clean the bathroom with", ("bleach_cleanser",)),
        ("cleaning", ("bleach_cleanser",)),
        ("for nails", ("hammer",)),
        ("drive a nail into the wall with", ("hammer",)),
        ("cutting paper", ("scissors",)),
        ("fix the sink with", ("hammer", "power_drill", "adjustable_wrench")),
        ("play with", ("tennis_ball", "colored_wood_blocks")),
        ("write with", ()),
        ("", ()),
    ],
)
def test_things_are_found_by_what_they_are_for(purpose: str, objects: tuple[str, ...]) -> None:
    assert KNOWN.objects_for(purpose) == objects


def test_all_food_is_to_eat() -> None:
    assert KNOWN.objects_for("eat") == KNOWN.objects_named("food")


@pytest.mark.parametrize(
    ("use", "purpose"),
    [("to eat", "eat with"), ("to drink from", "drink"), ("for nails", "clean my nails with")],
)
def test_another_preposition_or_verb_is_another_purpose(use: str, purpose: str) -> None:
    assert not purpose_of(use).serves(purpose_of(purpose))


def test_an_own_file_says_what_its_things_are_like_and_for(tmp_path: Path) -> None:
    file = tmp_path / "pen.ttl"
    file.write_text(
        f"""@prefix h: <{HOUSEHOLDS}> . @prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .
        <urn:pen> rdfs:subClassOf h:OfficeSupply ; rdfs:label "pen" ;
          h:color "blue", "azul"@es ; h:shape "thin" ; h:use "to write with" ."""
    )
    known = Ontology(files=[file])
    assert list(known.faults()) == []
    assert known.objects_for("write a letter with") == ("pen",)
    assert known.objects_named("something azul") == known.objects_named("thin one") == ("pen",)
    assert known.colors("pen") == ("blue",)


def test_a_thing_of_the_home_has_the_color_of_its_declaration(tmp_path: Path) -> None:
    known = Ontology(four_rooms().places(), things=[Thing("tea_pot", "Kitchenware", "blue")])
    assert known.objects_named("blue teapot") == ("tea_pot",)
    assert known.other_color("red teapot") == OtherColor(("red",), (("tea_pot", ("blue",)),))
    (tmp_path / "flat.owl").write_bytes(known.files()["home.owl"])
    assert Ontology(files=[tmp_path / "flat.owl"]).colors("tea_pot") == ("blue",)


def test_of_a_thing_without_a_color_nobody_says_that_it_has_another() -> None:
    known = Ontology(four_rooms().places(), things=[Thing("tea_pot", "Kitchenware")])
    assert known.objects_named("red teapot") == ()
    assert known.other_color("red teapot") is None


def test_an_ontology_without_properties_knows_names_only(tmp_path: Path) -> None:
    lines = HOUSEHOLD.read_text().splitlines()
    tags = ("<color", "<shape", "<use", "<pronoun")
    old = "\n".join(line for line in lines if not line.strip().startswith(tags))
    for name in ("color", "shape", "use", "pronoun"):
        old = old.replace(f'rdf:about="#{name}"', f'rdf:about="#no{name}"')
    (tmp_path / "household.owl").write_text(old)
    things = [Thing("tea_pot", "Kitchenware", "blue")]
    known = Ontology(things=things, files=[tmp_path / "household.owl"], defaults=False)
    assert known.objects_named("red one") == known.objects_named("blue tea pot") == ()
    assert known.other_color("blue mug") is None
    assert known.objects_named("mug") == ("mug",)


@pytest.mark.parametrize(
    ("said", "fault"),
    [
        (
            "<household:use>drinking</household:use>",
            "Mug has the use 'drinking', which does not say a purpose: write to ... or for ...",
        ),
        (
            "<household:color> </household:color>",
            "Mug has the color '', which has no word in it: write one",
        ),
        (
            f'<household:shape rdf:resource="{HOUSEHOLDS}Ball"/>',
            "Mug has the shape Ball, which is no text: write it in words",
        ),
        (
            '<household:color rdf:datatype="http://www.w3.org/2001/XMLSchema#integer">5'
            "</household:color>",
            "Mug has the color 5, which is no text: write it in words",
        ),
        (
            "<household:number>many</household:number>",
            "Mug has the number 'many', which is no number: write plural, or leave it out",
        ),
        (
            "<household:pronoun>it</household:pronoun>",
            "Mug has a pronoun, which stands for any object: say it of Object, or make it a name",
        ),
    ],
)
def test_check_names_properties_that_are_said_wrongly(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], said: str, fault: str
) -> None:
    (tmp_path / "more.owl").write_text(of_mug(said))
    assert main(["check", str(tmp_path / "more.owl")]) == 1
    assert capsys.readouterr().out.splitlines() == [fault]


def test_the_color_of_what_is_no_object_is_noted(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "more.owl").write_text(
        of_mug("<household:color>red</household:color>").replace("#Mug", "#Sofa")
    )
    assert main(["check", str(tmp_path / "more.owl")]) == 0
    told = "note: Sofa has a color, which is used of classes of objects only"
    assert told in capsys.readouterr().out.splitlines()


def test_show_says_what_a_thing_looks_like_and_is_for(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["show", "mug"]) == 0
    shown = capsys.readouterr().out
    assert "  color        red\n" in shown
    assert "  shape        cup\n" in shown
    assert "  use          to drink from, to drink out of, for coffee, for tea\n" in shown


def test_looks_can_be_asked_in_sparql() -> None:
    asked = "SELECT ?thing WHERE { ?thing household:color 'yellow' . ?thing household:shape 'box' }"
    assert KNOWN.query(asked).rows == (("sugar_box",),)


@pytest.mark.parametrize(
    ("words", "place"),
    [("fridge", "refrigerator"), ("couch", "sofa"), ("cupboard", "cabinet_kitchen")]
    + [("work table", "desk"), ("loveseat", "sofa"), ("foyer", "shelf_lobby")],
)
def test_furniture_and_rooms_go_by_what_people_call_them(words: str, place: str) -> None:
    assert place in KNOWN.places_named(f"in the {words}")
