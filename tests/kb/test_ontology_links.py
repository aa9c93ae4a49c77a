"""Links to nothing in an ontology, what is imported, and names that stop the robot."""

from pathlib import Path

import pytest

from executive.errors import InputError
from kb.ontology.ontology import Ontology

HEAD = """
@prefix : <http://ex.org/my#> .
@prefix owl: <http://www.w3.org/2002/07/owl#> .
@prefix rdf: <http://www.w3.org/1999/02/22-rdf-syntax-ns#> .
@prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .
@prefix h: <http://robot-executive.org/household.owl#> .
"""


def loaded(folder: Path, *texts: str) -> Ontology:
    """Our ontology and these files."""
    files = [folder / f"part{number}.ttl" for number in range(len(texts))]
    for file, text in zip(files, texts, strict=True):
        file.write_text(HEAD + text)
    return Ontology(files=files)


def test_a_name_in_the_wrong_namespace_is_told_with_the_whole_of_it(tmp_path: Path) -> None:
    wrong = "<http://robot-executive.org/houshold.owl#Object>"
    (fault,) = loaded(tmp_path, f":Kettle a owl:Class ; rdfs:subClassOf {wrong} .").faults()
    assert fault == (
        "Kettle subClassOf http://robot-executive.org/houshold.owl#Object, which no file declares: "
        "write http://robot-executive.org/household.owl#Object, or declare it"
    )


def test_a_web_page_is_told_to_be_none(tmp_path: Path) -> None:
    (tmp_path / "my.owl").write_text("<!DOCTYPE html>\n<html><body>404</body></html>")
    with pytest.raises(InputError, match="is a web page .* get the file itself; save it as"):
        Ontology(files=[tmp_path / "my.owl"])


ANNOTATED = "[] a owl:Axiom ; owl:annotatedSource"
SUBCLASS = "owl:annotatedProperty rdfs:subClassOf ; owl:annotatedTarget"
DENIED = "[] a owl:NegativePropertyAssertion ;"
LINKS = {
    f"{ANNOTATED} :Kettel ; {SUBCLASS} h:Object .": "annotatedSource Kettel, ...: write Kettle,",
    f"{ANNOTATED} :Kettle ; {SUBCLASS} h:Objekt .": "annotatedTarget Objekt, ...: write Object,",
    f"{ANNOTATED} :Kettle ; owl:annotatedProperty h:isInn .": "isInn, ...: write isIn, or declare",
    f"{DENIED} owl:sourceIndividual h:dsek .": "sourceIndividual dsek, ...: write desk, or declare",
    f"{DENIED} owl:targetIndividual h:dsek .": "targetIndividual dsek, ...: write desk, or declare",
    f"{DENIED} owl:assertionProperty h:isInn .": "assertionProperty isInn, ...: write isIn,",
    ":Kettle owl:intersectionOf :nolist .": "Kettle intersectionOf nolist, ...: declare it",
    ":Kettle owl:unionOf [ rdf:rest rdf:nil ] .": "a list that has a part without rdf:first",
    ":Kettle owl:oneOf [ rdf:first h:Mug ] .": "oneOf a list that has a part without rdf:rest",
    ":Kettle owl:oneOf _:l . _:l rdf:first h:Mug ; rdf:rest _:l .": "that comes back to itself",
}


@pytest.mark.parametrize(("text", "sentence"), LINKS.items())
def test_a_link_to_nothing_is_named_wherever_owl_has_links(
    text: str, sentence: str, tmp_path: Path
) -> None:
    kettle = ":Kettle a owl:Class ; rdfs:subClassOf h:Object ."
    (fault,) = loaded(tmp_path, kettle + text).faults()
    assert sentence in fault.replace("which no file declares", "...")


def test_what_links_are_annotated_with_need_not_be_declared(tmp_path: Path) -> None:
    text = (
        ":Kettle a owl:Class ; rdfs:subClassOf h:Object ; rdfs:seeAlso <http://ex.org/page> ."
        "[] a owl:Axiom ; owl:annotatedSource :Kettle ; owl:annotatedProperty rdfs:seeAlso ;"
        "owl:annotatedTarget <http://ex.org/page> ; rdfs:comment 'seen' ."
        ":Pan a owl:Class ; rdfs:subClassOf h:Object ; owl:unionOf :list ."
        ":list rdf:first h:Mug ; rdf:rest rdf:nil ."
    )
    assert list(loaded(tmp_path, text).faults()) == []


def test_a_neighbour_of_a_loaded_file_is_not_loaded_with_it(tmp_path: Path) -> None:
    ontology = loaded(
        tmp_path,
        "<http://ex.org/a> a owl:Ontology ; owl:imports <http://ex.org/b/tools.owl> .",
        "<http://ex.org/b> a owl:Ontology .",
    )
    assert "imports http://ex.org/b/tools.owl, which is not loaded" in ontology.unmet_imports()[0]


@pytest.mark.parametrize("name", ["stop", "Halt!", "emergency stop"])
def test_a_thing_whose_name_stops_the_robot_is_a_fault(name: str, tmp_path: Path) -> None:
    text = f':Thing a owl:Class ; rdfs:subClassOf h:Object ; rdfs:label "{name}" .'
    (fault,) = loaded(tmp_path, text).faults()
    assert fault == f"Thing is called {name!r}, which tells the robot to stop: rename it"
