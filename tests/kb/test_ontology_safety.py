"""An ontology is read and nothing else: it runs, opens and fetches nothing, and is bounded."""

import os
import sys
from pathlib import Path

import pytest
from mcap.reader import make_reader
from ontologies import HEAD, KETTLE, OWLREADY, TURTLE, rdf
from rdflib import URIRef
from replays import recorded
from watching import watched

import kb.ontology.owl
from executive.__main__ import main as mission
from executive.errors import InputError
from executive.replay.replaying import replay
from kb.__main__ import main
from kb.ontology import bounds, graph
from kb.ontology.ontology import DEFAULTS, HOUSEHOLD, Ontology
from logs.__main__ import main as logs

ABOUT = '<owl:Ontology rdf:about="">{}</owl:Ontology>'
COMMENT = '<owl:Class rdf:about="#K"><rdfs:comment>{}</rdfs:comment></owl:Class>'
MARKUP = COMMENT.replace("rdfs:comment>{}", 'rdfs:comment rdf:parseType="Literal">{}')
PREFIXES = "".join(f' xmlns:p{number}="urn:{number}"' for number in range(501))
SPELLINGS = {
    "an element": HEAD + ABOUT.format("<py:python_module>guest_code</py:python_module>"),
    "an attribute": HEAD + '<owl:Ontology rdf:about="" py:python_module="guest_code"/>',
    "an element without a prefix": HEAD
    + ABOUT.format(f'<python_module xmlns="{OWLREADY}">guest_code</python_module>'),
    "an entity": f'<!DOCTYPE rdf:RDF [<!ENTITY m "guest_code"><!ENTITY o "{OWLREADY}">]>'
    + HEAD
    + ABOUT.format('<python_module xmlns="&o;">&m;</python_module>'),
    "a class": HEAD
    + KETTLE.replace("<rdfs:label>", "<py:python_module>guest_code</py:python_module><rdfs:label>"),
    "a typed value": HEAD
    + ABOUT.format(
        '<py:python_module rdf:datatype="http://www.w3.org/2001/XMLSchema#string">guest_code'
        "</py:python_module>"
    ),
    "a prefix in Turtle": TURTLE + '<http://example.org/guest.ttl> py:python_module "guest_code" .',
    "a whole IRI in Turtle": TURTLE + f'[] <{OWLREADY}python_module> "guest_code" .',
    "an IRI with escapes in Turtle": TURTLE + f'[] <{OWLREADY}\\u0070ython_module> "guest_code" .',
}
SPELLINGS = {
    kind: text if text.startswith("@") else text + "</rdf:RDF>" for kind, text in SPELLINGS.items()
}
QUICK = ["--world", "fake", "--llm", "none", "--user", "none"]


@pytest.fixture
def guest(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with a module in it that leaves a mark when it is imported, and Python in it."""
    (tmp_path / "guest_code.py").write_text("open('mark', 'w').close()")
    monkeypatch.chdir(tmp_path)
    monkeypatch.syspath_prepend(tmp_path)
    yield tmp_path
    assert "guest_code" not in sys.modules
    assert not (tmp_path / "mark").exists()


@pytest.mark.parametrize("text", SPELLINGS.values(), ids=SPELLINGS)
def test_an_annotation_that_names_python_code_is_refused_and_the_code_not_run(guest, text):
    (guest / "guest.owl").write_text(text)
    with pytest.raises(InputError, match="python_module guest_code; nothing in an ontology is run"):
        Ontology(files=[guest / "guest.owl"])


@pytest.mark.parametrize("text", SPELLINGS.values(), ids=SPELLINGS)
def test_even_if_it_were_not_refused_nothing_would_be_run(guest, text, monkeypatch):
    monkeypatch.setattr(kb.ontology.owl, "_RUNS_PYTHON", URIRef("urn:none"))
    (guest / "guest.owl").write_text(text)
    known = Ontology(files=[guest / "guest.owl"])
    assert [*known.faults(), *known.unused()] != []
    assert known.query("SELECT ?x WHERE { ?x rdfs:subClassOf household:Fruit }").rows
    assert known.files()["guest.owl"] == text.encode()


def test_another_name_for_the_annotation_runs_nothing_either(guest):
    same = f"""<owl:AnnotationProperty rdf:about="#runs">
      <owl:equivalentProperty rdf:resource="{OWLREADY}python_module"/>
      <rdfs:subPropertyOf rdf:resource="{OWLREADY}python_module"/></owl:AnnotationProperty>
      <owl:Ontology rdf:about=""><runs xmlns="http://example.org/guest.owl#">guest_code</runs>
      </owl:Ontology>"""
    Ontology(files=[rdf(guest, same)])


@pytest.mark.parametrize(
    "command",
    [
        lambda file: mission([*QUICK, "--kb", file, "Find a mug"]),
        lambda file: main(["check", file]),
        lambda file: main(["check", "--kb", file]),
        lambda file: main(["show", "--kb", file, "mug"]),
        lambda file: main(["query", "--kb", file, "SELECT ?x WHERE { ?x a owl:Class }"]),
    ],
    ids=["mission", "check", "check --kb", "show", "query"],
)
def test_every_command_refuses_it_in_one_line(guest, command, capsys):
    (guest / "guest.owl").write_text(SPELLINGS["an element"])
    assert command("guest.owl") == 2
    told = capsys.readouterr()
    assert told.err.count("\n") == 1
    assert "python_module" in told.err
    assert told.out == ""


def test_the_replay_of_a_recording_that_carries_it_runs_nothing(guest, monkeypatch, capsys):
    (guest / "guest.owl").write_text(SPELLINGS["an element"])
    with monkeypatch.context() as lenient:
        lenient.setattr(kb.ontology.owl, "_RUNS_PYTHON", URIRef("urn:none"))
        run = recorded(guest, "Find a mug", llm=False, kb=(guest / "guest.owl",))
        (guest / "guest.owl").unlink()
        assert replay(run).parting is None
    with (run / "mission.mcap").open("rb") as file:
        assert "guest.owl" in {one.name for one in make_reader(file).iter_attachments()}
    executive_replay_forgets()
    assert logs(["replay", str(run)]) != 0
    told = capsys.readouterr()
    assert "python_module" in told.out + told.err


def executive_replay_forgets() -> None:
    from executive.replay.recorded import _ontology

    _ontology.cache_clear()
    kb.ontology.owl._parsed.cache_clear()


def test_reading_opens_its_file_and_touches_nothing_else(tmp_path):
    importing = ABOUT.format(
        """<owl:imports rdf:resource="http://example.org/far.owl"/>
        <owl:imports rdf:resource="file:///etc/hostname"/><owl:imports rdf:resource="near.owl"/>"""
    )
    far = rdf(tmp_path, importing + KETTLE)
    turtle = tmp_path / "guest.ttl"
    turtle.write_text(TURTLE + "<http://example.org/guest.ttl> owl:imports <file:///etc/passwd> .")
    rdf(tmp_path, KETTLE, "near.owl")
    Ontology(files=[far, turtle])  # Python and rdflib load their own parts at the first time
    with watched(HOUSEHOLD, DEFAULTS, far, turtle) as touched:
        known = Ontology(files=[far, turtle])
        [*known.faults(), *known.unused(), *known.warnings()]
        known.files()
    assert touched == []


def test_a_question_touches_nothing(tmp_path):
    known = Ontology(files=[rdf(tmp_path, KETTLE)])
    asked = "SELECT ?x ?name WHERE { ?x rdfs:subClassOf* household:Object . ?x rdfs:label ?name }"
    known.query(asked)
    with watched() as touched:
        known.query(asked)
    assert [one for one in touched if not one.startswith(("compile", "exec"))] == []


@pytest.mark.parametrize(
    "asked",
    [
        "LOAD <file:///etc/hostname>",
        "SELECT ?x WHERE { SERVICE <http://127.0.0.1:9/sparql> { ?x ?y ?z } }",
        "SELECT ?x FROM <http://127.0.0.1:9/far.owl> WHERE { ?x ?y ?z",
        "DELETE { ?x ?y ?z } WHERE { ?x ?y ?z }",
        "SELECT (readfile('/etc/hostname') AS ?x) WHERE { }",
        "SELECT (load_extension('x.so') AS ?x) WHERE { }",
        "SELECT * WHERE { ?x ?y " + "[ ?a " * 1000,
        "SELECT ?x WHERE { " * 600,
    ],
)
def test_a_question_that_would_do_more_than_read_is_refused(asked, capsys):
    with watched() as touched:
        assert main(["query", asked]) == 2
    assert not [one for one in touched if one.startswith(("socket", "open /etc", "urllib"))]
    assert capsys.readouterr().err.count("\n") == 1


LAUGHS = "".join(f'<!ENTITY l{n} "{f"&l{n - 1};" * 10}">' for n in range(1, 10))


@pytest.mark.parametrize(
    ("declared", "used", "fault"),
    [
        ('<!ENTITY l0 "lol">' + LAUGHS, "&l9;", "entity 'l1' is made of others"),
        (f'<!ENTITY big "{"x" * 1000}">', "&big;" * 40_000, "entities come to more than 30000000"),
        (f'<!ENTITY big "{"x" * 2000}">', "&big;", "or longer than 1000 characters"),
        ('<!ENTITY out SYSTEM "file:///etc/hostname">', "&out;", "'out' stands in another file"),
        ('<!ENTITY out SYSTEM "http://127.0.0.1:9/x">', "&out;", "'out' stands in another file"),
        ('<!ENTITY % out SYSTEM "http://127.0.0.1:9/x"> %out;', "", "'out' stands in another file"),
        ('<!ENTITY loop "&loop;">', "&loop;", "'loop' is made of others"),
    ],
)
def test_entities_neither_explode_nor_open_anything(tmp_path, declared, used, fault):
    label = f'<owl:Class rdf:about="#K"><rdfs:label>{used}</rdfs:label></owl:Class>'
    file = rdf(tmp_path, f"<!DOCTYPE rdf:RDF [{declared}]>{HEAD}{label}</rdf:RDF>")
    with watched(HOUSEHOLD, DEFAULTS, file) as touched, pytest.raises(InputError, match=fault):
        Ontology(files=[file])
    assert touched == []


def test_a_document_type_from_elsewhere_is_not_fetched(tmp_path):
    file = rdf(tmp_path, f'<!DOCTYPE rdf:RDF SYSTEM "file:///etc/passwd">{HEAD}{KETTLE}</rdf:RDF>')
    Ontology(files=[file])
    with watched(HOUSEHOLD, DEFAULTS, file) as touched:
        assert "kettle" in Ontology(files=[file]).objects()
    assert touched == []


def test_entities_that_shorten_iris_are_read(tmp_path):
    entity = '<!DOCTYPE rdf:RDF [<!ENTITY h "http://robot-executive.org/household.owl#">]>'
    kettle = KETTLE.replace("http://robot-executive.org/household.owl#", "&h;")
    assert (
        "kettle" in Ontology(files=[rdf(tmp_path, f"{entity}{HEAD}{kettle}</rdf:RDF>")]).objects()
    )


@pytest.mark.parametrize(
    ("content", "fault"),
    [
        ("<h:Room>" * 100_000, "has more than 200 elements in one another"),
        ("x" * (4 * 2**20 + 1), "is larger than 4 MB"),
        (COMMENT.format("\n" * 20_001), "has a text of more than 20000 characters"),
        (MARKUP.format("<a/>" * 2_001), "has too much XML as values"),
        (MARKUP.format("&amp;x" * 2_001), "has too much XML as values"),
        (KETTLE.replace("Class", "Class" + PREFIXES, 1), "has more than 500 prefixes at one place"),
        (KETTLE * 2 + '<h:Room rdf:ID="1 2"/>', r"cannot be read as RDF/XML: line \d+: .*"),
    ],
)
def test_a_file_that_is_too_much_or_broken_is_refused_in_a_sentence(tmp_path, content, fault):
    with pytest.raises(InputError, match=rf"guest.owl: {fault}"):
        Ontology(files=[rdf(tmp_path, content)])


@pytest.mark.parametrize(
    ("content", "fault"),
    [
        ("<urn:a> <urn:b> " + "[ <urn:c> " * 5000, "is nested too deep"),
        ("<urn:a> <urn:b> " + "(" * 5000, "is nested too deep"),
        ("<urn:a> <urn:b> <urn:c>", "cannot be read as Turtle: it ends too early"),
        ("<urn:a> <urn:b> " + "9" * 5000 + " .", "it has a number of thousands of digits"),
        ("<urn:a> <urn:b> '" + "\\t" * 100_001 + "' .", "has more than 100000 escapes"),
        ("<urn:a> <urn:b> .", "cannot be read as Turtle: line 5: "),
        ("<urn:a> <urn:b> \x1b[31m .", r"cannot be read as Turtle: line [^\x1b]*"),
    ],
)
def test_a_broken_turtle_file_is_refused_in_one_line(tmp_path, content, fault):
    (tmp_path / "guest.ttl").write_text(TURTLE + content)
    with pytest.raises(InputError, match=fault) as refused:
        Ontology(files=[tmp_path / "guest.ttl"])
    assert str(refused.value).isprintable()


def test_more_triples_than_people_write_are_refused(tmp_path, monkeypatch):
    monkeypatch.setattr(kb.ontology.owl, "MOST_TRIPLES", 1000)
    (tmp_path / "guest.ttl").write_text(
        TURTLE + f"h:Mug rdfs:label {', '.join(map(str, range(1001)))} ."
    )
    with pytest.raises(InputError, match="says more than 1000 things"):
        Ontology(files=[tmp_path / "guest.ttl"])


def test_a_chain_of_very_many_classes_is_refused_and_not_walked_for_hours(tmp_path):
    chain = "".join(f"h:C{n + 1} rdfs:subClassOf h:C{n} .\n" for n in range(3_000))
    (tmp_path / "guest.ttl").write_text(TURTLE + "h:C0 rdfs:subClassOf h:Object .\n" + chain)
    with pytest.raises(InputError, match="too many classes, one above another, above C"):
        Ontology(files=[tmp_path / "guest.ttl"])


def test_many_classes_side_by_side_are_no_trouble(tmp_path):
    flat = "".join(
        f'h:C{n} rdfs:subClassOf h:Object ; rdfs:label "c {n}" .\n' for n in range(2_000)
    )
    (tmp_path / "guest.ttl").write_text(TURTLE + flat)
    assert len(Ontology(files=[tmp_path / "guest.ttl"]).objects()) > 2_000


def test_what_is_no_file_is_not_waited_for(tmp_path):
    os.mkfifo(tmp_path / "guest.owl")
    with pytest.raises(InputError, match="it is a pipe or a device; give a plain file"):
        Ontology(files=[tmp_path / "guest.owl"])
    with pytest.raises(InputError, match="it is a folder; give a plain file"):
        Ontology(files=[tmp_path])


def test_numbers_of_any_size_are_only_text(tmp_path):
    xsd = "http://www.w3.org/2001/XMLSchema#"
    numbers = [f'"1e999999999"^^<{xsd}decimal>', f'"{"9" * 5000}"^^<{xsd}integer>', "9" * 30]
    numbers += [f'"x"^^<{xsd}integer>', f'"NaN"^^<{xsd}double>', f'"z"^^<{xsd}hexBinary>']
    (tmp_path / "guest.ttl").write_text(TURTLE + f"h:Mug h:weight {', '.join(numbers)} .")
    known = Ontology(files=[tmp_path / "guest.ttl"])
    table = known.query("SELECT ?w WHERE { household:Mug household:weight ?w }")
    assert len(table.rows) == len(numbers)


def test_a_value_that_is_xml_is_left_as_it_is(tmp_path):
    kind = "<http://www.w3.org/1999/02/22-rdf-syntax-ns#XMLLiteral>"
    (tmp_path / "guest.ttl").write_text(TURTLE + f'h:Mug h:notes "<a/>unclosed<b>"^^{kind} .')
    known = Ontology(files=[tmp_path / "guest.ttl"])
    asked = "SELECT ?x WHERE { household:Mug household:notes ?x }"
    assert known.query(asked).rows == (("<a/>unclosed<b>",),)


def test_the_bounds_leave_room_for_what_people_write():
    assert HOUSEHOLD.stat().st_size * 100 < kb.ontology.owl.MOST_BYTES
    assert bounds.MOST_DEPTH >= 100
    assert graph.MOST_STEPS >= 100_000


def test_the_watch_sees_what_is_opened_imported_and_run(tmp_path):
    with watched() as touched:
        (tmp_path / "seen").write_text("x")
        exec("0")
    assert [one.split()[0] for one in touched] == ["open", "compile", "exec"]


def test_a_question_that_takes_too_long_is_given_up(monkeypatch, capsys):
    from kb.ontology import sparql

    monkeypatch.setattr(sparql, "LONGEST_S", 0.2)
    pairs = "SELECT (COUNT(*) AS ?n) WHERE { ?a ?b ?c . ?d ?e ?f . ?g ?h ?i . ?j ?k ?l }"
    assert main(["query", pairs]) == 2
    assert "query: takes longer than 0 s; ask for less" in capsys.readouterr().err


def test_a_mission_says_what_is_not_loaded_and_goes_on(guest, capsys, caplog):
    file = rdf(guest, ABOUT.format('<owl:imports rdf:resource="http://far.example/x.owl"/>'))
    assert mission([*QUICK, "--search", "paper", "--kb", str(file), "Find a sugar_box"]) == 1
    assert "guest.owl imports http://far.example/x.owl, which is not loaded" in caplog.text
    assert "sugar box" in capsys.readouterr().out
