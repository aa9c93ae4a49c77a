"""Ontologies as people have them: what is not as ours are is read, or told with what is right."""

import re
from pathlib import Path

import pytest
from ontologies import KETTLE, TURTLE, rdf

from executive.errors import InputError
from executive.testing.bench import four_rooms
from kb.__main__ import main
from kb.ontology.ontology import Ontology

HOUSE = "http://robot-executive.org/household.owl#"
HOME = "http://robot-executive.org/home.owl#"


def named(labels: str) -> str:
    """A class below Object with these names."""
    return KETTLE.replace("<rdfs:label>kettle</rdfs:label>", labels)


def checked(folder: Path, content: str, capsys: pytest.CaptureFixture[str]) -> list[str]:
    """What `kb check` finds in a file with this content."""
    main(["check", "--kb", str(rdf(folder, content))])
    return capsys.readouterr().out.splitlines()


def turtle(folder: Path, content: str) -> Path:
    path = folder / "guest.ttl"
    path.write_text(
        TURTLE + f"@prefix home: <{HOME}> . @prefix x: <http://example.org/x#> .{content}"
    )
    return path


# --- names ---


def label(text: str, language: str = "", kind: str = "rdfs:label") -> str:
    tag = f' xml:lang="{language}"' if language else ""
    skos = ' xmlns:skos="http://www.w3.org/2004/02/skos/core#"'
    return f"<{kind}{skos}{tag}>{text}</{kind}>"


@pytest.mark.parametrize(
    ("labels", "name", "synonyms"),
    [
        (label("Kessel", "de") + label("pot", "en"), "pot", ("Kessel",)),
        (label("Kessel", "de") + label("pot", "en-GB"), "pot", ("Kessel",)),
        (label("marmite", "fr") + label("pot"), "pot", ("marmite",)),
        (label("pot") + label("kettle", "en"), "pot", ("kettle",)),
        (label("Kessel", "de"), "Kessel", ()),
        (label("pot", "en", "skos:prefLabel"), "pot", ()),
        (label("Topf", "de") + label("pot", "en", "skos:prefLabel"), "pot", ("Topf",)),
        (label("pot") + label("Pott", "nds", "skos:hiddenLabel"), "pot", ("Pott",)),
        (
            label("pot") + label("olla", "es", "skos:altLabel") + label("pot", "en"),
            "pot",
            ("olla",),
        ),
        (label("\n   big\n   pot\n"), "big pot", ()),
        ("", "Kettle", ()),
    ],
)
def test_the_english_or_untagged_label_names_a_thing_and_all_others_are_known(
    tmp_path, labels, name, synonyms
):
    known = Ontology(files=[rdf(tmp_path, named(labels))])
    assert name in known.objects()
    assert known.synonyms(name) == synonyms
    assert all(known.objects_named(synonym) == (name,) for synonym in synonyms)


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ("", "has no word in it: write one"),
        ("the", "has no word in it: write one"),
        ("?!", "has no word in it: write one"),
        ("x" * 5000, "is longer than 100 characters: give a shorter one"),
        ("evil\u202elive", "has characters that nobody sees: take them out"),
        ("no\u200bbody", "has characters that nobody sees: take them out"),
    ],
)
@pytest.mark.parametrize("kind", ["rdfs:label", "skos:altLabel"])
def test_a_name_that_would_break_the_house_is_told_and_not_used(tmp_path, capsys, text, why, kind):
    file = named(label(text, "", kind))
    known = Ontology(files=[rdf(tmp_path, file)])
    assert known.objects()[-1] == "Kettle"
    assert known.synonyms("Kettle") == ()
    [told] = checked(tmp_path, file, capsys)
    assert re.match(r"Kettle: the name '.*' " + why, told)


@pytest.mark.parametrize("pronoun", ["it", "That one"])
def test_a_thing_that_is_called_as_what_was_spoken_of_before_is_told(tmp_path, capsys, pronoun):
    [told] = checked(tmp_path, named(label(pronoun)), capsys)
    assert told == f"Kettle is called '{pronoun}', which says what was spoken of before: rename it"


@pytest.mark.parametrize("name", ["two kettles", "7 up", "All Spice"])
def test_a_thing_whose_name_says_how_many_is_told(tmp_path, capsys, name):
    [told] = checked(tmp_path, named(label(name)), capsys)
    assert told == f"Kettle is called '{name}', which says how many: rename it"


@pytest.mark.parametrize("content", ["", "skos:Kettle a skos:Concept ."])
def test_a_file_that_adds_nothing_is_noted_when_it_is_checked(tmp_path, capsys, content):
    file = tmp_path / "guest.ttl"
    file.write_text(f"@prefix skos: <http://www.w3.org/2004/02/skos/core#> . {content}")
    assert main(["check", "--kb", str(file)]) == 0
    assert f"note: {file.name} adds nothing that the robot uses" in capsys.readouterr().out


def test_two_classes_whose_iris_end_alike_are_told_apart(tmp_path, capsys):
    content = "<http://x.org/y#Mug> a owl:Class ; rdfs:subClassOf h:Kitchenware ."
    main(["check", "--kb", str(turtle(tmp_path, content))])
    assert f"'Mug' names both {HOUSE}Mug and http://x.org/y#Mug" in capsys.readouterr().out


@pytest.mark.parametrize("taken", ["hand", "Floor", "the person", "delivery"])
def test_a_thing_that_is_called_like_something_of_the_robots_is_told(tmp_path, capsys, taken):
    [told] = checked(tmp_path, named(label(taken)), capsys)
    assert told.startswith(f"Kettle is called '{taken}', as the robot calls something else")


def test_no_control_character_of_a_file_reaches_the_terminal(tmp_path, capsys):
    content = rf"""
      <http://example.org/x#Bad\u202e\u001B> a owl:Class ; rdfs:subClassOf h:Object ,
        <{HOUSE}Objec\u202Et> ; rdfs:label "a\u001b[31m\nforged: 0 faults" , 7 ;
        h:hasDefaultLocation "\u009b2J\r" .
      [] owl:members ( <{HOUSE}Mug\u0007> ) ; owl:imports <http://x.org/\u202e> .
      <http://example.org/guest.ttl> owl:imports <http://x.org/\u202E> .
      <{HOME}desk\u0007x> a h:Desk . """
    file = str(turtle(tmp_path, content))
    asked = "SELECT ?a ?b ?c WHERE { ?a ?b ?c }"
    main(["check", "--kb", file])
    main(["show", "--kb", file, "Bad", "\x1b[31m"])
    main(["show", "--kb", file, "fruit"])
    main(["query", "--kb", file, asked])
    main(["query", "--kb", file, "--json", asked])
    told = capsys.readouterr()
    lines = (told.out + told.err).split("\n")
    assert all(line.isprintable() for line in lines)
    assert not any(line.startswith("forged") for line in lines)


# --- syntaxes ---


def test_turtle_is_read(tmp_path):
    content = 'x:Kettle a owl:Class ; rdfs:subClassOf h:Object ; rdfs:label "kettle" .'
    assert "kettle" in Ontology(files=[turtle(tmp_path, content)]).objects()


def test_n_triples_are_read_whatever_the_file_is_called(tmp_path):
    path = tmp_path / "guest.owl"
    below = "http://www.w3.org/2000/01/rdf-schema#subClassOf"
    path.write_text(f"# mine\n\n<urn:Kettle> <{below}> <{HOUSE}Object> .\n")
    assert "urn:Kettle" in Ontology(files=[path]).objects()


@pytest.mark.parametrize("encoding", ["utf-8-sig", "utf-16"])
def test_a_byte_order_mark_does_not_matter(tmp_path, encoding):
    xml, ttl = rdf(tmp_path, KETTLE), turtle(tmp_path, "x:Pan rdfs:subClassOf h:Object .")
    for file in (xml, ttl):
        file.write_bytes(file.read_text().encode(encoding))
    assert {"kettle", "Pan"} <= set(Ontology(files=[xml, ttl]).objects())


def test_an_encoding_that_the_file_names_is_heeded(tmp_path):
    file = rdf(tmp_path, named(label("théière")))
    declared = '<?xml version="1.0" encoding="ISO-8859-1"?>' + file.read_text()
    file.write_bytes(declared.encode("iso-8859-1"))
    assert "théière" in Ontology(files=[file]).objects()


@pytest.mark.parametrize(
    ("text", "syntax"),
    [
        (
            f"Prefix(:=<urn:x#>)\nOntology(<urn:x> SubClassOf(:K <{HOUSE}Object>))",
            "functional syntax",
        ),
        ("# by hand\nOntology( <urn:x> )", "functional syntax"),
        ("Prefix: h: <urn:x#>\nOntology: <urn:x>\nClass: h:K", "Manchester syntax"),
        ('{"@context": {}, "@id": "urn:x"}', "JSON-LD"),
        ('[ {"@id": "urn:x"} ]', "JSON-LD"),
        ("{ <urn:K> a <urn:C> . }", "TriG"),
        ("@prefix x: <urn:x#> .\nx:g { x:K a x:C . }", "TriG"),
        ("<urn:x> <urn:y> <urn:z> .\nGRAPH <urn:g> {\n<urn:K> a <urn:C> }", "TriG"),
        ("@prefix x: <urn:x#> .\n{ ?k a x:C } => { ?k a x:D } .", "Notation3"),
        ("<urn:K> <urn:p> <urn:C> <urn:g> .", "N-Quads"),
        ("format-version: 1.2\n[Term]\nid: X:1\n", "OBO"),
        ('<?xml version="1.0"?><Ontology xmlns="http://www.w3.org/2002/07/owl#"/>', "OWL/XML"),
    ],
)
def test_another_syntax_is_named_with_how_to_save_the_file(tmp_path, text, syntax):
    path = tmp_path / "guest.owl"
    path.write_text(text)
    right = r"which is not read; save it as RDF/XML or Turtle \(in Protégé: File, Save as"
    with pytest.raises(InputError, match=rf"guest.owl: is in .*{syntax}, {right}"):
        Ontology(files=[path])


@pytest.mark.parametrize("content", [b"", b"\n\n", b"\x89PNG\r\n", b"\x00" * 99, b"\xff"])
def test_what_is_no_ontology_is_refused_in_one_line(tmp_path, content):
    path = tmp_path / "guest.owl"
    path.write_bytes(content)
    with pytest.raises(InputError, match="save it as") as refused:
        Ontology(files=[path])
    assert str(refused.value).isprintable()


def test_text_that_is_no_utf_8_is_refused(tmp_path):
    path = turtle(tmp_path, 'h:Mug rdfs:label "Becher" .')
    path.write_bytes(path.read_bytes().replace(b"Becher", b"B\xe9cher"))
    with pytest.raises(InputError, match="is no UTF-8 text: byte .*; save it as UTF-8"):
        Ontology(files=[path])


# --- imports ---

IMPORT = '<owl:Ontology rdf:about=""><owl:imports rdf:resource="{}"/></owl:Ontology>'
VERSION = """<owl:Ontology rdf:about="http://other.example/kitchen.owl">
  <owl:versionIRI rdf:resource="http://other.example/2024/things"/></owl:Ontology>"""


@pytest.mark.parametrize(
    "wanted",
    [
        "http://other.example/kitchen.owl",
        "http://other.example/kitchen.owl#",
        "http://other.example/kitchen.owl/1.0",
        "http://other.example/2024/things",
        "http://elsewhere.example/kitchen.owl",
        "pots.owl",
        "http://elsewhere.example/pots",
    ],
)
def test_an_import_is_met_by_a_loaded_file_of_that_iri_version_or_name(tmp_path, capsys, wanted):
    pots = rdf(tmp_path, VERSION, "pots.owl")
    file = rdf(tmp_path, IMPORT.format(wanted))
    for order in ([pots, file], [file, pots]):
        assert main(["check", *(f"--kb={one}" for one in order)]) == 0
        assert capsys.readouterr().out == ""


def test_an_import_that_is_not_met_is_told_and_the_rest_is_known(tmp_path, capsys):
    file = rdf(tmp_path, IMPORT.format("http://other.example/kitchen.owl") + KETTLE)
    told = "guest.owl imports http://other.example/kitchen.owl, which is not loaded, and nothing is"
    assert main(["check", "--kb", str(file)]) == 0
    assert capsys.readouterr().out.startswith(f"note: {told}")
    assert main(["show", "--kb", str(file), "kettle"]) == 0
    assert capsys.readouterr().err.startswith(f"warning: {told}")


# --- what is said in other ways ---


@pytest.mark.parametrize(
    "axiom",
    [
        """<owl:Axiom><owl:annotatedSource rdf:resource="#Kettle"/><owl:annotatedProperty
          rdf:resource="http://www.w3.org/2000/01/rdf-schema#subClassOf"/><owl:annotatedTarget
          rdf:resource="http://robot-executive.org/household.owl#Object"/><dc:creator
          xmlns:dc="http://purl.org/dc/elements/1.1/">me</dc:creator></owl:Axiom>""",
        """<owl:Ontology rdf:about=""><l:license xmlns:l="http://purl.org/dc/terms/"
          rdf:resource="http://creativecommons.org/licenses/by/4.0/"/></owl:Ontology>""",
    ],
)
def test_annotations_are_no_faults(tmp_path, capsys, axiom):
    assert checked(tmp_path, KETTLE + axiom, capsys) == []


@pytest.mark.parametrize(
    ("axiom", "who"),
    [
        (
            """<rdf:Description><rdf:type rdf:resource="http://www.w3.org/2002/07/owl#{kind}"/>
            <owl:members rdf:parseType="Collection"><owl:Class rdf:about="#Kettle"/>
            <rdf:Description rdf:about="{house}Applle"/></owl:members></rdf:Description>""",
            "AllDisjointClasses members",
        ),
        (
            """<rdf:Description rdf:about="#Kettle">
            <owl:disjointWith rdf:resource="{house}Applle"/></rdf:Description>""",
            "Kettle disjointWith",
        ),
        (
            """<rdf:Description rdf:about="#Kettle"><owl:equivalentClass><owl:Class>
            <owl:unionOf rdf:parseType="Collection"><rdf:Description rdf:about="{house}Applle"/>
            </owl:unionOf></owl:Class></owl:equivalentClass></rdf:Description>""",
            "Kettle unionOf",
        ),
    ],
)
def test_a_misspelt_class_is_named_wherever_it_is(tmp_path, capsys, axiom, who):
    filled = axiom.format(house=HOUSE, kind="AllDisjointClasses")
    told = checked(tmp_path, KETTLE + filled, capsys)
    assert told[0] == f"{who} Applle, which no file declares: write Apple, or declare it"


def test_disjoint_classes_that_exist_are_no_fault(tmp_path, capsys):
    disjoint = f"""<rdf:Description rdf:about="#Kettle">
      <owl:disjointWith rdf:resource="{HOUSE}Mug"/></rdf:Description>"""
    assert main(["check", str(rdf(tmp_path, KETTLE + disjoint))]) == 0
    assert "note: not used (only classes" in capsys.readouterr().out


def test_a_definition_by_intersection_says_what_a_thing_is_and_where(tmp_path):
    content = """x:Kettle a owl:Class ; rdfs:label "kettle" ; owl:equivalentClass [ a owl:Class ;
      owl:intersectionOf ( h:Kitchenware [ a owl:Restriction ;
        owl:onProperty h:hasDefaultLocation ; owl:hasValue home:desk ] ) ] ."""
    known = Ontology(four_rooms().places(), files=[turtle(tmp_path, content)])
    assert known.classes_of("kettle")[0] == "kitchenware"
    assert known.usual_places("kettle") == ("desk",)


def test_a_default_location_may_be_said_of_a_class_directly(tmp_path):
    content = "x:Kettle rdfs:subClassOf h:Object ; h:hasDefaultLocation home:desk , home:sofa ."
    known = Ontology(four_rooms().places(), files=[turtle(tmp_path, content)])
    assert known.usual_places("Kettle") == ("sofa", "desk")


@pytest.mark.parametrize(
    ("content", "told"),
    [
        (
            "home:grans_mug a h:Mug .",
            "grans_mug is an individual of Mug, and only classes are objects: declare it as a "
            "class (owl:Class) that is rdfs:subClassOf Mug",
        ),
        (
            "x:Pan a owl:Class, owl:NamedIndividual, h:Mug ; rdfs:subClassOf h:Object .",
            "Pan is a class and an individual of Mug, too: take out the individual "
            "(owl:NamedIndividual), the class is enough",
        ),
        (
            "[] a h:Mug .",
            "a nameless individual of Mug is not used: only classes are objects",
        ),
        (
            "h:Mug rdfs:subClassOf [ owl:onProperty h:hasDefaultLocation ; owl:hasValue 42 ] .",
            "Mug has a default location, 42, that is no furniture: name a piece of furniture",
        ),
        (
            "h:Mug h:preferredBy home:desk .",
            "Mug is preferred by desk, which is no Person: name one",
        ),
        (
            "x:Toy rdfs:subClassOf h:Object ; rdfs:label 'couch' .",
            "'couch' names both Sofa and Toy: rename one",
        ),
        (
            "x:Toy rdfs:subClassOf h:Object ; rdfs:label 'high-table' .",
            "'high-table' names both high_table and Toy: rename one",
        ),
        (
            "x:Cup rdfs:subClassOf h:Object ; rdfs:label 'Mugs' .",
            "'Mugs' names both Mug and Cup: rename one",
        ),
        (
            "h:Table h:preposition 'under' .",
            "Table has the preposition under: write in or on",
        ),
        (
            "home:nook a h:Desk ; h:isIn 'upstairs' .",
            "nook is in upstairs, which is no room: name a room",
        ),
        (
            "home:nook a h:Desk ; h:isIn home:kitchen, home:bedroom .",
            "nook is in kitchen and in bedroom: it stands in one room, take out the other isIn",
        ),
        (
            "h:Mug h:hasDefaultLocation [ a h:Table ] .",
            "something nameless is in no room: say with isIn where it stands",
        ),
        (
            "home:ann a h:Person ; rdfs:label 'Ann' . home:anne a h:Person ; rdfs:label 'ann' .",
            "'ann' names both ann and anne: rename one",
        ),
        (
            "h:Mug rdfs:subClassOf owl:Nothing .",
            "Mug is below Nothing, so that there is none: take out what says so",
        ),
        (
            "h:Mug owl:equivalentClass owl:Nothing .",
            "Mug is below Nothing, so that there is none: take out what says so",
        ),
        (
            "h:Mug rdfs:subClassOf h:Mug .",
            "Mug below Mug: no class is below itself, take out one subClassOf",
        ),
    ],
)
def test_what_is_wrong_is_told_with_what_would_be_right(tmp_path, capsys, content, told):
    assert main(["check", "--kb", str(turtle(tmp_path, content))]) == 1
    assert capsys.readouterr().out.splitlines() == [told]


@pytest.mark.parametrize(
    ("content", "told"),
    [
        (
            """h:Mug rdfs:subClassOf [ a owl:Restriction ; owl:onProperty h:hasDefaultLocation ;
            owl:someValuesFrom h:Table ] .""",
            "Mug hasDefaultLocation some Table is not used: write owl:hasValue and one individual",
        ),
        (
            "x:Pan rdfs:subClassOf h:Object ; owl:equivalentClass h:Mug .",
            "Pan is equivalent to Mug, which is not used: keep one of the two, and give it the "
            "other's name as skos:altLabel",
        ),
        (
            "x:Pan rdfs:subClassOf h:Object ; owl:deprecated true .",
            "Pan is deprecated, and used all the same: take it out of the file",
        ),
        (
            "h:isIn py:python_name 'stands' .",
            "python_name is an annotation for programs in Python, and not used",
        ),
        (
            """h:Mug rdfs:subClassOf [ owl:onProperty h:isIn ; owl:someValuesFrom [ owl:unionOf
            ( h:Kitchen h:Lobby ) ] ] . h:isIn owl:propertyChainAxiom ( h:isIn h:isIn ) .""",
            "not used (only classes, their names, default locations, rooms, favourites, looks and "
            "uses are): 1 restrictions (isIn), 1 chains of properties, 1 unions",
        ),
    ],
)
def test_what_is_not_used_is_noted_and_no_fault(tmp_path, capsys, content, told):
    assert main(["check", "--kb", str(turtle(tmp_path, content))]) == 0
    assert f"note: {told}" in capsys.readouterr().out.splitlines()


def test_a_circle_hides_no_thing(tmp_path):
    known = Ontology(files=[turtle(tmp_path, "h:Fruit rdfs:subClassOf h:Apple .")])
    assert {"apple", "pear"} <= set(known.objects())


def test_names_that_python_has_are_only_names(tmp_path):
    names = ("__class__", "name", "label", "is_a", "storid", "altLabel", "namespace", "_world")
    content = "".join(f"x:{name} a owl:Class ; rdfs:subClassOf h:Object . " for name in names)
    assert set(names) <= set(Ontology(files=[turtle(tmp_path, content)]).objects())


def test_many_faults_of_a_kind_are_counted(tmp_path, capsys):
    content = "".join(f"x:C{n} a owl:Class . " for n in range(50))
    main(["check", "--kb", str(turtle(tmp_path, content))])
    told = capsys.readouterr().out.splitlines()
    assert told[20] == "and 30 more of this kind (in no class)"


UPPER = """
  <http://example.org/guest.ttl> owl:imports <http://upper.example/DUL.owl> ,
    <package://maps/x.owl> .
  @prefix dul: <http://upper.example/DUL.owl#> . @prefix m: <http://maps.example/lab.owl#> .
  m:Cupboard a owl:Class ; rdfs:subClassOf dul:DesignedArtifact , [ a owl:Restriction ;
    owl:onProperty dul:hasPart ; owl:someValuesFrom m:Drawer ] .
  m:Drawer a owl:Class ; rdfs:subClassOf dul:DesignedArtifact .
  m:cupboard_1 a owl:NamedIndividual , m:Cupboard ; dul:hasRegion m:pose_1 .
  m:pose_1 a dul:Region ; m:translation "1.0 2.0 0.5" ; m:quaternion "0 0 0 1" .
"""


def test_a_map_after_an_upper_ontology_loads_and_says_why_nothing_of_it_is_known(tmp_path):
    known = Ontology(files=[turtle(tmp_path, UPPER)])
    *imports, last = known.warnings()
    assert len(imports) == 2
    assert last == (
        "guest.ttl adds nothing that the robot uses: put its classes below Object, Furniture, "
        "Room or Person of household.owl (rdfs:subClassOf)"
    )
    assert not any("DesignedArtifact" in fault for fault in known.faults())


def test_our_own_files_say_nothing_in_vain():
    known = Ontology(four_rooms().places())
    assert [*known.faults(), *known.unused(), *known.warnings()] == []


def test_the_turtle_that_the_docs_show_says_what_the_docs_say(tmp_path):
    docs = (Path(__file__).parents[2] / "docs" / "knowledge.md").read_text()
    anna, pen = re.findall(r"^```turtle\n(.*?)^```", docs, re.DOTALL | re.MULTILINE)
    (tmp_path / "anna.ttl").write_text(anna)
    (tmp_path / "pen.ttl").write_text(pen)
    known = Ontology(files=[tmp_path / "anna.ttl", tmp_path / "pen.ttl"], person="Anna")
    assert known.preferred(("apple", "pear")) == ("pear",)
    assert known.objects_for("write a letter with") == ("pen",)
    assert [*known.faults(), *known.unused(), *known.warnings()] == []


def test_a_class_of_objects_without_a_name_is_told(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    content = f'<owl:Class><rdfs:subClassOf rdf:resource="{HOUSE}Mug"/></owl:Class>'
    said = "a class below Mug has no name, and is not used: give it a name of its own"
    assert any(said in line for line in checked(tmp_path, content, capsys))


def test_what_is_a_thing_and_a_place_is_told(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    above = f'<rdfs:subClassOf rdf:resource="{HOUSE}Furniture"/>'
    content = f'<owl:Class rdf:about="{HOUSE}Mug">{above}</owl:Class>'
    said = "Mug is below Object and below Furniture: take out one subClassOf"
    assert said in checked(tmp_path, content, capsys)
