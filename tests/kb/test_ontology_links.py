"""Links to nothing in an ontology, what is imported, and names that stop the robot."""

from pathlib import Path

import pytest

from kb.ontology.ontology import Ontology

HEAD = """
@prefix : <http://ex.org/my#> .
@prefix owl: <http://www.w3.org/2002/07/owl#> .
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
