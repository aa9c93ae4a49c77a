"""What the knowledge base knows about things and places, and how people may name them."""

import gzip
import re
from pathlib import Path
from xml.etree import ElementTree

import pytest
import rdflib
from hypothesis import example, given
from hypothesis import strategies as st
from ontologies import ANNA, OWL
from rdflib import OWL as OWL_
from rdflib import RDF, RDFS

from executive.errors import InputError
from executive.language.phrases import stem, words_of
from executive.testing.bench import four_rooms, ontology
from executive.types.home import Place
from kb.__main__ import main
from kb.ontology.names import PlaceNames
from kb.ontology.ontology import DEFAULTS, HOUSEHOLD, Ontology
from sim.home.home_file import home_text

PAPERS_OBJECTS = [
    *("adjustable_wrench", "apple", "banana", "bleach_cleanser", "colored_wood_blocks"),
    *("cracker_box", "hammer", "mug", "mustard_bottle", "orange", "peach", "pear", "pitcher_base"),
    *("potted_meat_can", "power_drill", "pudding_box", "scissors", "spatula", "strawberry"),
    *("sugar_box", "tennis_ball", "tomato_soup_can"),
]
SURVEY = {
    "mug": "dining_table coffee_table counter_wagon",
    "cracker_box": "cabinet_kitchen dining_table coffee_table counter_wagon",
    "fruit": "dining_table counter_wagon high_table",
    "mustard_bottle": "cabinet_kitchen dining_table counter_wagon high_table",
    "spatula": "cabinet_kitchen counter_wagon high_table",
    "power_drill": "shelf_lobby",
    "pitcher_base": "cabinet_kitchen dining_table counter_wagon high_table",
    "ball": "shelf_lobby",
    "pudding_box": "cabinet_kitchen dining_table coffee_table counter_wagon",
    "colored_wood_blocks": "",
    "bleach_cleanser": "cabinet_kitchen counter_wagon",
    "potted_meat_can": "cabinet_kitchen counter_wagon high_table",
    "tomato_soup_can": "cabinet_kitchen counter_wagon high_table",
    "sugar_box": "cabinet_kitchen counter_wagon high_table",
    "hammer": "shelf_lobby",
    "adjustable_wrench": "shelf_lobby sideboard",
    "scissors": "sideboard desk",
}
FRUITS = ("apple", "banana", "orange", "peach", "pear", "strawberry")
KNOWN = ontology(True)
NAMES = {place.name for place in four_rooms().places()}


def owl_file(folder: Path, content: str) -> Path:
    path = folder / "more.owl"
    path.write_text(OWL.format(content))
    return path


def test_the_objects_of_the_paper_are_known():
    assert set(KNOWN.objects()) >= set(PAPERS_OBJECTS)


@pytest.mark.parametrize(("name", "places"), SURVEY.items())
def test_default_locations_are_those_of_the_survey(name, places):
    assert KNOWN.among(name) == tuple(places.split())


def test_a_thing_takes_its_default_locations_from_its_nearest_class_that_has_any():
    assert KNOWN.among("apple") == KNOWN.among("fruit") != ()
    assert KNOWN.among("tennis_ball") == ("shelf_lobby",)


def test_without_defaults_nothing_is_usually_anywhere():
    assert not any(ontology(False).usual_places(name) for name in PAPERS_OBJECTS)


def test_usual_places_are_those_of_this_home_only():
    table = Place("high_table", "Table", "attic", "StorageRoom")
    assert Ontology([table]).usual_places("sugar_box") == ("high_table",)


@pytest.mark.parametrize(
    ("words", "objects"),
    [
        ("apple", ("apple",)),
        ("apples", ("apple",)),
        ("strawberries", ("strawberry",)),
        ("peaches", ("peach",)),
        ("Sugar Box", ("sugar_box",)),
        ("the sugar_box", ("sugar_box",)),
        ("sugar-box", ("sugar_box",)),
        ("sugarbox", ("sugar_box",)),
        ("a box of sugar", ("sugar_box",)),
        ("pitcher", ("pitcher_base",)),
        ("drill", ("power_drill",)),
        ("spam", ("potted_meat_can",)),
        ("my blocks", ("colored_wood_blocks",)),
        ("fruit", FRUITS),
        ("fruits", FRUITS),
        ("tool", ("hammer", "power_drill", "adjustable_wrench")),
        ("ball", ("tennis_ball",)),
        ("unicorn", ()),
        ("", ()),
    ],
)
def test_words_mean_an_object_or_all_members_of_a_class(words, objects):
    assert KNOWN.objects_named(words) == objects


def test_an_objects_name_beats_a_classs(tmp_path):
    toy = owl_file(
        tmp_path,
        """<owl:Class rdf:about="#ToyFruit"><rdfs:label>fruit</rdfs:label>
        <rdfs:subClassOf rdf:resource="http://robot-executive.org/household.owl#Toy"/></owl:Class>""",
    )
    assert Ontology(files=[toy]).objects_named("fruit") == ("fruit",)


@pytest.mark.parametrize(
    ("words", "nearest"), [("appel", "apple"), ("sugar bax", "sugar_box"), ("fruts", "fruit")]
)
def test_nearest_names_forgive_a_slip(words, nearest):
    assert KNOWN.nearest_names(words)[0] == nearest


def test_nearest_names_of_gibberish_are_none():
    assert KNOWN.nearest_names("xyzzy qqq") == ()


@pytest.mark.parametrize(
    ("words", "name"),
    [("appel", "apple"), ("suger_box", "sugar_box"), ("hamer", "hammer"), ("fruti", "fruit")]
    + [("zebra", None), ("box", None), ("pearh", None), ("", None)],
)
def test_a_slip_is_near_one_name_only(words, name):
    assert KNOWN.near_name(words) == name


@pytest.mark.parametrize(
    ("words", "names"),
    [
        ("an apple and two mugs", ("apple", "mug")),
        ("any fruit, and the box of sugar", ("fruit", "sugar_box")),
        ("a red apple", ("apple",)),
        ("apples, apples!", ("apple",)),
        ("nothing at all", ()),
        ("", ()),
    ],
)
def test_names_are_found_in_a_text(words, names):
    assert KNOWN.names_in(words) == names


@pytest.mark.parametrize(
    ("words", "places"),
    [
        ("on the kitchen cabinet or the desk", ("cabinet_kitchen", "desk")),
        ("dining_table", ("dining_table",)),
        ("Dining-Table!", ("dining_table",)),
        ("the cabinet in the kitchen", ("cabinet_kitchen",)),
        ("it is in the cupboard of the kitchen", ("cabinet_kitchen",)),
        ("bookcase", ("bookshelf_bedroom",)),
        ("in the fridge", ("refrigerator",)),
        ("not on the desk but on the sofa", ("sofa",)),
        ("I don't know, perhaps on the desk", ("desk",)),
        ("I don't know", ()),
        ("in the bedroom", ("bed", "desk", "bookshelf_bedroom")),
        ("bed room", ("bed", "desk", "bookshelf_bedroom")),
        ("the living room table", ("dining_table", "coffee_table")),
        ("the table in the bedroom", ()),
        ("on the roof", ()),
        ("the dinning table", ("dining_table",)),
        ("on the dsek", ("desk",)),
        ("in the kichen cabinett", ("cabinet_kitchen",)),
        ("", ()),
    ],
)
def test_places_are_found_as_people_write_them(words, places):
    assert KNOWN.places_named(words) == places


def test_a_name_beats_the_class_that_is_called_the_same():
    desks = [Place("desk", "Desk", "office", "Office"), Place("dad_desk", "Desk", "den", "Office")]
    assert PlaceNames(desks).find("on the desk") == ("desk",)


@given(
    st.text()
    | st.lists(st.sampled_from(["desk", "table", "in", "kitchen", "not", ","])).map(" ".join)
)
def test_no_words_name_a_place_that_does_not_exist(words):
    assert set(KNOWN.places_named(words)) <= NAMES


@given(
    st.sampled_from(sorted(NAMES)),
    st.sampled_from(["{}", "the {}", "on the {}.", "{} "]),
    st.booleans(),
)
def test_every_place_is_found_by_its_name(name, frame, upper):
    written = frame.format(name.replace("_", " "))
    assert KNOWN.places_named(written.upper() if upper else written) == (name,)


@given(st.text())
@example("ı")
def test_normalised_words_do_not_depend_on_case_or_separators(text):
    assert words_of(text.upper().lower()) == words_of(f"  {text.lower()}_-")


@pytest.mark.parametrize(
    ("one", "many"),
    [("apple", "apples"), ("box", "boxes"), ("shelf", "shelves"), ("knife", "knives")]
    + [("cookie", "cookies"), ("shoe", "shoes"), ("potato", "potatoes"), ("glass", "glasses")],
)
def test_a_noun_and_its_plural_have_one_stem(one, many):
    assert stem(one) == stem(many)


def test_things_are_in_cabinets_and_on_tables():
    kinds = {place.kind: KNOWN.preposition(place) for place in four_rooms().places()}
    assert (kinds["Cabinet"], kinds["Refrigerator"], kinds["Table"]) == ("in", "in", "on")


def test_a_place_of_an_unknown_class_is_refused_with_the_classes_there_are():
    with pytest.raises(InputError, match=r"seat: .*'Throne'.*known are .*Table.*Sofa"):
        Ontology([Place("seat", "Throne", "hall", "Lobby")])


def test_a_room_of_an_unknown_class_is_refused():
    with pytest.raises(InputError, match=r"dungeon: .*'Dungeon'.*known are Room.*Kitchen"):
        Ontology([Place("bed", "Bed", "dungeon", "Dungeon")])


def test_an_unknown_thing_has_no_class():
    with pytest.raises(InputError, match="there is no 'unicorn'; known are .*apple"):
        KNOWN.classes_of("unicorn")


@pytest.mark.parametrize(
    ("content", "fault"),
    [
        ("this is none", "more.owl: is no ontology: it begins with 'this is none'; save it as RDF"),
        ("<rdf:RDF>", "more.owl: is not XML: unbound prefix"),
        ("<htm></htm>", "more.owl: begins with <htm>; save it as RDF/XML or Turtle"),
    ],
)
def test_a_broken_file_is_refused(tmp_path, content, fault):
    path = tmp_path / "more.owl"
    path.write_text(content)
    with pytest.raises(InputError, match=fault):
        Ontology(files=[path])


@pytest.mark.parametrize(
    "content", [gzip.compress(b"<rdf:RDF/>"), b"PK\x03\x04"], ids=["gz", "zip"]
)
def test_a_compressed_file_is_refused_with_what_to_do(tmp_path, content):
    path = tmp_path / "more.owl"
    path.write_bytes(content)
    with pytest.raises(InputError, match="more.owl: is compressed; unpack it, and name the file"):
        Ontology(files=[path])


def test_a_missing_file_is_refused(tmp_path):
    with pytest.raises(InputError, match="nowhere.owl: cannot be read: No such file"):
        Ontology(files=[tmp_path / "nowhere.owl"])


def test_two_files_of_one_name_are_refused_because_one_would_be_lost_in_the_log(tmp_path):
    one = owl_file(tmp_path, "")
    (tmp_path / "other").mkdir()
    other = owl_file(tmp_path / "other", "")
    other.write_text(other.read_text().replace("example.org", "example.com"))
    with pytest.raises(InputError, match="more.owl: another file has the same name; rename one"):
        Ontology(files=[one, other])


@pytest.mark.parametrize("name", ["home.owl", "config.toml"])
def test_a_file_is_not_called_like_what_else_is_kept_with_the_log(tmp_path, name):
    (tmp_path / name).write_text(OWL.format(""))
    with pytest.raises(InputError, match=f"{name}: another file has the same name; rename one"):
        Ontology(files=[tmp_path / name])


def test_a_file_that_takes_the_place_of_ones_own_is_told(tmp_path):
    one = owl_file(tmp_path, "")
    other = tmp_path / "again.owl"
    other.write_text(one.read_text())
    [told] = Ontology(files=[one, other]).warnings()
    assert told.startswith("again.owl takes the place of more.owl, which declares the same IRI")


def test_a_file_is_kept_as_it_was_loaded(tmp_path):
    path = owl_file(tmp_path, "")
    known, loaded = Ontology(files=[path]), path.read_bytes()
    path.unlink()
    assert known.files()["more.owl"] == loaded


def test_two_knowledge_bases_do_not_share_anything():
    one, other = Ontology([Place("desk", "Desk", "den", "Office")]), Ontology(defaults=False)
    assert one.usual_places("scissors") == ("desk",)
    assert other.usual_places("scissors") == ()


def test_the_loaded_files_can_be_kept_with_the_log():
    files = KNOWN.files()
    assert files["household.owl"] == HOUSEHOLD.read_bytes()
    assert files["defaults.owl"] == DEFAULTS.read_bytes()


def test_what_the_home_adds_is_kept_as_an_ontology_and_has_the_last_word(tmp_path):
    den = [Place("desk", "Table", "den", "Office"), Place("cot", "Bed", "den", "Office")]
    (tmp_path / "den.owl").write_bytes(Ontology(den).files()["home.owl"])
    known = Ontology(files=[tmp_path / "den.owl"], defaults=False)
    asked = "SELECT ?piece ?kind WHERE { ?piece household:isIn home:den . ?piece a ?kind }"
    assert set(known.query(asked).rows) >= {("desk", "table"), ("cot", "bed")}


@pytest.mark.parametrize("path", [HOUSEHOLD, DEFAULTS])
def test_everything_in_the_files_is_said_once(path):
    about = "{http://www.w3.org/1999/02/22-rdf-syntax-ns#}about"
    named = [e.get(about) for e in ElementTree.parse(path).getroot() if e.get(about)]
    assert len(named) == len(set(named))


def test_check_finds_no_fault_in_the_files_that_come_with_it(capsys):
    assert main(["check"]) == 0
    assert capsys.readouterr().out == ""


@pytest.mark.parametrize(
    ("content", "fault"),
    [
        (
            """<owl:Class rdf:about="#Cup"><rdfs:label>Mugs</rdfs:label>
            <rdfs:subClassOf rdf:resource="http://robot-executive.org/household.owl#Kitchenware"/>
            </owl:Class>""",
            "'Mugs' names both Mug and Cup: rename one",
        ),
        (
            """<household:Desk rdf:about="#lost_desk"/>""",
            "lost_desk is in no room: say with isIn where it stands",
        ),
        (
            """<owl:Class rdf:about="http://robot-executive.org/household.owl#Mug"><rdfs:subClassOf>
            <owl:Restriction><owl:onProperty
              rdf:resource="http://robot-executive.org/household.owl#hasDefaultLocation"/>
            <owl:hasValue rdf:resource="http://robot-executive.org/home.owl#kitchen"/>
            </owl:Restriction></rdfs:subClassOf></owl:Class>""",
            "Mug has a default location, kitchen, that is no furniture: name a piece of furniture",
        ),
        (
            """<owl:Class rdf:about="http://robot-executive.org/household.owl#Mug"><rdfs:subClassOf>
            <owl:Restriction><owl:onProperty
              rdf:resource="http://robot-executive.org/household.owl#hasDefaultLocation"/>
            <owl:hasValue rdf:resource="http://robot-executive.org/home.owl#atlantis"/>
            </owl:Restriction></rdfs:subClassOf></owl:Class>""",
            "Mug hasDefaultLocation atlantis, which no file declares: declare it",
        ),
        (
            """<owl:Class rdf:about="http://robot-executive.org/household.owl#Mug"><rdfs:subClassOf>
            <owl:Restriction><owl:onProperty
              rdf:resource="http://robot-executive.org/household.owl#preferredBy"/>
            <owl:hasValue rdf:resource="http://robot-executive.org/home.owl#nobody"/>
            </owl:Restriction></rdfs:subClassOf></owl:Class>""",
            "Mug preferredBy nobody, which no file declares: declare it",
        ),
        (
            """<household:Desk rdf:about="#lost_desk"><household:isIn
            rdf:resource="http://robot-executive.org/home.owl#sofa"/></household:Desk>""",
            "lost_desk is in sofa, which is no room: name a room",
        ),
        (
            """<owl:Class rdf:about="#Cup"><rdfs:subClassOf
            rdf:resource="http://robot-executive.org/household.owl#Kitchenwear"/></owl:Class>""",
            "Cup subClassOf Kitchenwear, which no file declares: write Kitchenware, or declare it",
        ),
        (
            """<household:Person rdf:about="#anna"><household:lives
            rdf:resource="http://robot-executive.org/home.owl#kitchen"/></household:Person>""",
            "anna uses lives, which no file declares: declare it",
        ),
        (
            """<owl:Class rdf:about="#Lonely"/>""",
            "Lonely is in no class: put it below Object, Furniture, Room or Person",
        ),
        (
            """<owl:Class rdf:about="http://robot-executive.org/household.owl#Fruit"><rdfs:subClassOf
            rdf:resource="http://robot-executive.org/household.owl#Apple"/></owl:Class>""",
            "Fruit below Apple below Fruit: no class is below itself, take out one subClassOf",
        ),
    ],
)
def test_check_names_the_faults_of_a_file(tmp_path, capsys, content, fault):
    assert main(["check", str(owl_file(tmp_path, content))]) == 1
    assert capsys.readouterr().out.splitlines() == [fault]


def test_check_names_every_cycle(tmp_path, capsys):
    below = """<owl:Class rdf:about="http://robot-executive.org/household.owl#{}"><rdfs:subClassOf
        rdf:resource="http://robot-executive.org/household.owl#{}"/></owl:Class>"""
    content = below.format("Food", "Apple") + below.format("Tool", "Hammer")
    main(["check", str(owl_file(tmp_path, content))])
    assert capsys.readouterr().out.count("no class is below itself") == 2


MUG_ON_THE_DESK = """<owl:Class rdf:about="http://robot-executive.org/household.owl#Mug"><rdfs:subClassOf>
  <owl:Restriction><owl:onProperty
    rdf:resource="http://robot-executive.org/household.owl#hasDefaultLocation"/>
  <owl:hasValue rdf:resource="http://robot-executive.org/home.owl#desk"/>
  </owl:Restriction></rdfs:subClassOf></owl:Class>"""


def test_a_file_adds_to_ours(tmp_path):
    known = Ontology(four_rooms().places(), files=[owl_file(tmp_path, MUG_ON_THE_DESK)])
    assert set(known.usual_places("mug")) > {"desk", "dining_table"}


def test_a_file_with_the_iri_of_one_of_ours_replaces_it(tmp_path):
    file = owl_file(tmp_path, MUG_ON_THE_DESK)
    file.write_text(file.read_text().replace("example.org/more", "robot-executive.org/defaults"))
    known = Ontology(four_rooms().places(), files=[file])
    assert known.usual_places("mug") == ("desk",)
    assert known.usual_places("hammer") == ()
    assert set(known.files()) == {"household.owl", "more.owl", "home.owl"}


def test_what_replaces_household_owl_has_to_keep_the_names_that_every_home_needs(tmp_path):
    mine = tmp_path / "mine.owl"
    mine.write_text(HOUSEHOLD.read_text().replace("#isIn", "#standsIn"))
    with pytest.raises(InputError, match=r"declares no isIn; keep http://.*#isIn as household.owl"):
        Ontology(files=[mine])


def test_the_knowledge_of_another_home_can_be_asked(tmp_path, capsys):
    home = tmp_path / "mine.toml"
    home.write_text(home_text("four_rooms").replace("sideboard", "dresser_of_gran"))
    where = "SELECT ?room WHERE { home:dresser_of_gran household:isIn ?room }"
    assert main(["query", "--home", str(home), where]) == 0
    assert capsys.readouterr().out == "room\nlobby\n"
    assert main(["show", "--no-defaults", "hammer"]) == 0
    assert "usually at   -" in capsys.readouterr().out


@pytest.mark.parametrize("path", [HOUSEHOLD, DEFAULTS])
def test_other_tools_read_the_files(path):
    graph = rdflib.Graph().parse(path, format="xml")
    iri = rdflib.URIRef(f"http://robot-executive.org/{path.name}")
    assert list(graph.subjects(RDF.type, OWL_.Ontology)) == [iri]
    here = {
        HOUSEHOLD.with_name(str(i).rpartition("/")[2]) for i in graph.objects(iri, OWL_.imports)
    }
    assert here <= {HOUSEHOLD}


def test_other_tools_find_a_label_and_a_comment_on_everything():
    graph = rdflib.Graph().parse(HOUSEHOLD)
    apple = rdflib.URIRef("http://robot-executive.org/household.owl#Apple")
    above = set(graph.transitive_objects(apple, RDFS.subClassOf))
    assert {str(one).rpartition("#")[2] for one in above} == {"Apple", "Fruit", "Food", "Object"}
    for thing in graph.subjects(RDF.type, OWL_.Class):
        assert graph.value(thing, RDFS.label)
    for thing in graph.subjects(RDF.type):
        assert isinstance(thing, rdflib.BNode) or graph.value(thing, RDFS.comment), thing


def test_show_says_what_is_known_about_a_thing(capsys):
    assert main(["show", "sugar"]) == 0
    shown = capsys.readouterr().out
    assert "sugar_box" in shown
    assert "box of sugar" in shown
    assert "packaged food" in shown
    assert "cabinet_kitchen, counter_wagon, high_table" in shown


def test_show_offers_the_nearest_name(capsys):
    assert main(["show", "appel"]) == 1
    assert "did you mean apple?" in capsys.readouterr().err


def test_a_favourite_is_known_to_whoever_knows_the_person(tmp_path, capsys):
    file = owl_file(tmp_path, ANNA)
    assert Ontology(files=[file], person="anna").preferred(FRUITS) == ("pear",)
    assert Ontology(files=[file]).preferred(FRUITS) == ()
    main(["show", "--kb", str(file), "pear"])
    assert "preferred by Anna" in capsys.readouterr().out


def test_the_file_that_the_docs_show_is_sound(tmp_path):
    docs = Path(__file__).parents[2] / "docs" / "knowledge.md"
    [shown] = re.findall(r"^<rdf:RDF.*?^</rdf:RDF>", docs.read_text(), re.DOTALL | re.MULTILINE)
    (tmp_path / "anna.owl").write_text(shown)
    known = Ontology(files=[tmp_path / "anna.owl"], person="Anna")
    assert known.preferred(FRUITS) == ("pear",)
    assert list(known.faults()) == []


def test_an_unknown_person_is_refused_with_who_is_known(tmp_path):
    with pytest.raises(InputError, match="person Bob: .* known are Anna"):
        Ontology(files=[owl_file(tmp_path, ANNA)], person="Bob")
    with pytest.raises(InputError, match="person Bob: .* give it as --kb"):
        Ontology(person="Bob")


def test_a_query_is_answered_as_a_table_and_as_json(capsys):
    assert main(["query", "SELECT ?room WHERE { home:desk household:isIn ?room }"]) == 0
    assert capsys.readouterr().out == "room\nbedroom\n"
    assert main(["query", "--json", "SELECT ?x WHERE { ?x rdfs:subClassOf household:Ball }"]) == 0
    assert capsys.readouterr().out == '[{"x": "tennis_ball"}]\n'
    assert main(["query", "SELECT ?x WHERE { ?x rdfs:subClassOf household:Apple }"]) == 1


@pytest.mark.parametrize("sparql", ["", "what?", "ASK { ?x ?y ?z }", "SELECT ?x { ?x :y ?z }"])
def test_a_query_that_cannot_be_read_is_bad_input(sparql, capsys):
    assert main(["query", sparql]) == 2
    assert "write for example: SELECT" in capsys.readouterr().err


def test_a_query_changes_nothing(capsys):
    insert = "INSERT { ?x skos:altLabel 'x' } WHERE { ?x rdfs:subClassOf household:Fruit }"
    assert main(["query", insert]) == 2
    assert "is no SELECT" in capsys.readouterr().err


def test_a_bad_file_ends_the_command_with_one_sentence(tmp_path, capsys):
    assert main(["check", str(tmp_path / "nowhere.owl")]) == 2
    assert "cannot be read" in capsys.readouterr().err
