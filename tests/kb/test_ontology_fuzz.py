"""Whatever is in a file, an ontology is known or refused in a sentence, and nothing is touched."""

from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from ontologies import OWLREADY
from watching import watched

from executive.errors import ExecutiveError
from executive.testing.bench import four_rooms
from executive.text import printable
from kb.ontology.ontology import DEFAULTS, HOUSEHOLD, Ontology

OURS = HOUSEHOLD.read_bytes()
KNOWN = Ontology(defaults=False)
PLACES = four_rooms().places()[:4]
W3 = "http://www.w3.org/"
VOCABULARY = {
    f"{W3}2002/07/owl#": "Class Thing Nothing Ontology imports versionIRI Restriction onProperty "
    "hasValue someValuesFrom equivalentClass intersectionOf unionOf complementOf members oneOf "
    "disjointWith AllDisjointClasses Axiom annotatedSource annotatedTarget deprecated onClass "
    "NamedIndividual ObjectProperty propertyChainAxiom inverseOf sameAs",
    f"{W3}1999/02/22-rdf-syntax-ns#": "type first rest nil List Property",
    f"{W3}2000/01/rdf-schema#": "subClassOf label comment domain range subPropertyOf Class",
    f"{W3}2004/02/skos/core#": "altLabel prefLabel hiddenLabel",
    "http://robot-executive.org/household.owl#": "Object Furniture Room Person isIn Fruit Apple "
    "hasDefaultLocation preferredBy preposition Mug Table Kitchen",
    "http://robot-executive.org/home.owl#": "desk kitchen nobody",
    "http://example.org/x#": "A B C __class__ name label",
    OWLREADY: "python_module python_name",
}
IRIS = [f"<{space}{name}>" for space, names in VOCABULARY.items() for name in names.split()]
BLANKS = [f"_:b{number}" for number in range(5)]
LITERALS = [
    *('"pot"', '"Topf"@de', '"pot"@en-GB', '""', '"hand"', "42", "true", f'"{"x" * 200}"'),
    *('"a\\u001b[31m"', '"\\u202Eevil"', '"\\n0 faults"', '"<b>"@en', '"guest_code"'),
    *(
        f"{text}^^<{W3}2001/XMLSchema#{kind}>"
        for text in ('"99999999999999999999"', '"1e99999999"', '"x"', '"NaN"', '"-1"')
        for kind in ("integer", "decimal", "double", "dateTime", "boolean", "hexBinary")
    ),
]
ASKED = ["rdf:type", "rdfs:subClassOf", "rdfs:label", "household:isIn", "household:Object"]
NODES = st.sampled_from(IRIS) | st.sampled_from(BLANKS)
TRIPLES = st.tuples(NODES, st.sampled_from(IRIS), NODES | st.sampled_from(LITERALS))
NOISE = st.sampled_from(
    [b"<", b"&", b'"', b"</", b"<!--", b"]]>", b"<![CDATA[", b"&#0;", b"\x00", b"\xff", b"&amp;"]
    + [b'rdf:parseType="Collection"', b'rdf:parseType="Literal"', b'rdf:nodeID="a"', b"rdf:li"]
    + [b'xml:lang="de"', b'rdf:ID="Mug"', b'xml:base="x"', b"<!DOCTYPE a>", b"<owl:Class>"]
)
EDITS = st.lists(
    st.tuples(st.integers(0, len(OURS)), st.integers(0, 300), NOISE | st.binary(max_size=5)),
    min_size=1,
    max_size=5,
)
FEW = settings(
    max_examples=60,
    deadline=None,
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
)


def everything_of(file: Path) -> list[str]:
    """All that a file makes the ontology say; a refusal is what it says, too."""
    try:
        known = Ontology(PLACES, files=[file])
    except ExecutiveError as refused:
        return [str(refused)]
    told = [*known.faults(), *known.unused(), *known.warnings()]
    for name in known.objects():
        told += [name, *known.classes_of(name), *known.synonyms(name), *known.preferred_by(name)]
        told += [*known.among(name), *known.usual_places(name), *known.likely_places(name)]
        known.objects_named(name)
    known.names_in("the pot and an apple")
    known.near_name("appel")
    known.recorded_locations()
    known.files()
    return told + [known.preposition(place) for place in known.places()]


def expect_harmless(file: Path, content: bytes) -> None:
    file.write_bytes(content)
    with watched(HOUSEHOLD, DEFAULTS, file) as touched:
        told = everything_of(file)
    assert touched == []
    assert told == [printable(line) for line in told]


@pytest.fixture
def file(tmp_path: Path) -> Path:
    """Where the odd ontology is; everything that Python loads at first is loaded."""
    path = tmp_path / "odd.owl"
    for content in (OURS.replace(b"household.owl", b"odd.owl"), b"<urn:a> <urn:b> 'c' ."):
        path.write_bytes(content)
        everything_of(path)
    return path


@FEW
@given(edits=EDITS)
def test_damaged_xml_is_refused_or_read_and_touches_nothing(file, edits):
    content = bytearray(OURS.replace(b"/household.owl", b"/odd.owl", 1))
    for at, length, noise in edits:
        content[at : at + length] = noise
    expect_harmless(file, bytes(content))


@FEW
@given(triples=st.lists(TRIPLES, min_size=1, max_size=40))
def test_any_statements_are_refused_or_known_and_touch_nothing(file, triples):
    expect_harmless(file, "\n".join(" ".join((*triple, ".")) for triple in triples).encode())


@FEW
@given(
    parts=st.lists(
        st.sampled_from([*IRIS, *BLANKS, *LITERALS, *";,.[]()^@a", "@prefix"]) | st.text()
    )
)
def test_any_text_is_refused_or_read_and_touches_nothing(file, parts):
    text = " ".join(["<urn:a>", *parts])
    expect_harmless(file, text.encode("utf-8", "replace"))


@FEW
@given(triples=st.lists(TRIPLES, max_size=30), asked=st.sampled_from(ASKED))
def test_any_ontology_can_be_asked(file, triples, asked):
    file.write_text("\n".join(" ".join((*triple, ".")) for triple in triples) or "@prefix : <x> .")
    try:
        known = Ontology(PLACES, files=[file])
    except ExecutiveError:
        return
    known.query(f"SELECT ?x ?y WHERE {{ ?x {asked} ?y }}")
    known.query(f"SELECT ?x ?y WHERE {{ {asked} ?x ?y }}")


@settings(FEW, max_examples=30)
@given(words=st.lists(st.sampled_from([*"{}().;,a*+?", "?x", "FILTER", "UNION", "'b'"])))
def test_any_question_is_answered_or_refused(words):
    try:
        KNOWN.query(" ".join(["SELECT ?x WHERE {", *words]))
    except ExecutiveError as refused:
        assert "\n" not in str(refused)  # noqa: PT017 - an answer is right, too
