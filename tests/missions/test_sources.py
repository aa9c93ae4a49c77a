"""Whoever else knows where things are is asked, too: knowledge sources beside the ontology."""

import io
import json
from dataclasses import dataclass
from pathlib import Path

import pytest

from executive.app.session import Session
from executive.app.sources import read, written
from executive.config import KnowledgeSystem, load_settings
from executive.errors import InputError
from executive.records import Utterance
from executive.replay.replaying import replay
from executive.testing.bench import run_mission
from executive.types import DriveTo, MissionStatus
from logs.recording.reader import Run

NOWHERE: tuple[str, ...] = ()


@dataclass
class Note:
    """A note on the refrigerator about one thing."""

    places: tuple[str, ...] = ("sofa",)
    name: str = "note"
    says: str = "it is on your note"
    raises: bool = False

    def places_of(self, name: str) -> tuple[str, ...]:
        if self.raises:
            raise OSError("the refrigerator is open")
        return self.places if name == "hammer" else ()


def test_its_word_goes_before_the_ontology_and_is_told_as_its_own() -> None:
    run = run_mission("Find the hammer", sources=[Note()], place={"hammer": "sofa"})
    assert (run.outcome.source, run.outcome.visited) == ("note", ("sofa",))
    said = [utterance.text for utterance in run.notebook.all(Utterance)]
    assert "I look for the hammer at sofa: it is on your note." in said


def test_where_it_names_no_real_place_the_others_are_asked() -> None:
    run = run_mission("Find the hammer", sources=[Note(("the moon",)), Note(NOWHERE)])
    assert run.outcome.status == MissionStatus.DONE
    assert run.outcome.source not in ("note", None)
    assert "the moon" not in run.outcome.visited


def test_sources_are_asked_in_their_order_until_the_thing_is_seen() -> None:
    notes = [Note(("desk",), "first"), Note(("desk", "sofa"), "second"), Note(("bed",), "third")]
    run = run_mission("Find the hammer", sources=notes, place={"hammer": "sofa"})
    assert (run.outcome.source, run.outcome.visited) == ("second", ("desk", "sofa"))


def test_a_place_that_was_looked_at_in_vain_is_not_named_again() -> None:
    run = run_mission(
        "Find the hammer", sources=[Note(("desk",), "first"), Note(("desk",), "second")]
    )
    assert run.goals.count(DriveTo("desk")) == 1


def session(note: Note, runs: Path) -> Session:
    settings = load_settings(
        world="fake",
        knowledge=KnowledgeSystem.OKB,
        user="oracle",
        place={"hammer": "sofa"},
        runs=runs,
    )
    return Session(settings, sources=[note], out=io.StringIO())


def test_the_recording_has_its_name_and_replays_without_it(tmp_path: Path) -> None:
    outcome = session(Note(), tmp_path).run("Take the hammer")
    run = Run(Path(outcome.run_dir or ""))
    recorded = run.outcome()
    assert recorded
    assert [recorded.source, *(c.source for c in recorded.candidates)] == ["note", "note"]
    assert replay(run.path).parting is None


def test_one_that_raises_knows_nothing_and_the_mission_goes_on(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    outcome = session(Note(raises=True), tmp_path).run("Find the hammer")
    assert outcome.status == MissionStatus.DONE
    assert "the note does not answer: OSError: the refrigerator is open" in caplog.text
    assert replay(Path(outcome.run_dir or "")).parting is None


def test_what_is_no_list_of_sources_is_refused_in_words() -> None:
    assert read("a run", written([Note()], ["hammer", "mug"]))[0].places_of("hammer") == ("sofa",)
    with pytest.raises(InputError, match="a run: its sources.json does not say what is where"):
        read("a run", json.dumps({"hammer": "sofa"}).encode())
