"""Whoever else knows where things are is asked, too: knowledge sources beside the ontology."""

import io
import json
import re
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import pytest

from executive.app.parts import Parts
from executive.app.session import Session
from executive.app.sources import read, written
from executive.config import KnowledgeSystem, load_settings
from executive.errors import InputError
from executive.guards import GuardedSource
from executive.records import SourceAnswer, Utterance
from executive.replay.replaying import replay
from executive.testing.bench import Notebook, run_mission
from executive.types.goals import DriveTo
from executive.types.outcome import MissionStatus
from logs.recording.reader import Run

NOWHERE: tuple[str, ...] = ()


@dataclass
class Note:
    """A note on the refrigerator about one thing."""

    places: tuple[str, ...] | str = ("sofa",)
    name: str = "note"
    says: str = "it is on your note"
    raises: bool = False
    asked: list[str] = field(default_factory=list)

    def places_of(self, name: str) -> Any:
        self.asked.append(name)
        if self.raises:
            raise OSError("the refrigerator is open")
        return self.places if name == "hammer" else ()


def test_its_word_goes_before_the_ontology_and_is_told_as_its_own() -> None:
    run = run_mission("Find the hammer", sources=[Note()], place={"hammer": "sofa"})
    assert (run.outcome.source, run.outcome.visited) == ("note", ("sofa",))
    said = [utterance.text for utterance in run.notebook.all(Utterance)]
    assert "I look for the hammer on the sofa: it is on your note." in said


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
        search="paper",
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


def test_a_recording_keeps_what_was_asked_in_the_mission_and_nothing_else(tmp_path: Path) -> None:
    note = Note()
    outcome = session(note, tmp_path).run("Find the hammer")
    run = Run(Path(outcome.run_dir or ""))
    assert note.asked == ["hammer"]
    assert [at.value for at in run.records(SourceAnswer)] == [
        SourceAnswer("note", "hammer", ("sofa",))
    ]
    assert json.loads(run.attachments["sources.json"]) == [
        {"name": "note", "says": "it is on your note"}
    ]


def test_one_that_raises_knows_nothing_and_that_is_said_once_a_mission(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    with session(Note(raises=True), tmp_path) as robot:
        for words in ("Find the hammer", "Find the mug"):
            caplog.clear()
            outcome = robot.run(words)
            assert outcome.status == MissionStatus.DONE
            (told,) = [line.getMessage() for line in caplog.records if "note" in line.getMessage()]
            assert told == "the note does not answer: OSError: the refrigerator is open"
            assert replay(Path(outcome.run_dir or "")).parting is None


def test_one_that_raises_again_is_not_told_of_again(caplog: pytest.LogCaptureFixture) -> None:
    source = GuardedSource(Note(raises=True), Notebook())
    assert [source.places_of("hammer"), source.places_of("mug")] == [(), ()]
    assert len([line for line in caplog.records if line.levelname == "WARNING"]) == 1


def test_a_text_in_place_of_places_is_one_place() -> None:
    run = run_mission("Find the hammer", sources=[Note("sofa")], place={"hammer": "sofa"})
    assert (run.outcome.source, run.outcome.visited) == ("note", ("sofa",))


def test_a_replay_is_given_the_answers_in_their_order() -> None:
    answers = [SourceAnswer("note", "hammer", ("sofa",)), SourceAnswer("note", "hammer", ())]
    (source,) = read("a run", written([Note()]), answers)
    assert [source.places_of("hammer") for _ in range(3)] == [("sofa",), (), ()]
    assert source.places_of("mug") == ()


def test_recordings_that_kept_what_was_known_of_all_things_are_read() -> None:
    text = b'[{"name": "note", "says": "so", "places": {"hammer": ["sofa"], "mug": []}}]'
    (source,) = read("a run", text)
    assert [source.places_of("hammer"), source.places_of("mug")] == [("sofa",), ()]


def test_what_is_no_list_of_sources_is_refused_in_words() -> None:
    with pytest.raises(InputError, match="a run: its sources.json does not say what is where"):
        read("a run", json.dumps({"hammer": "sofa"}).encode())


class Mute:
    name = "mute"
    places_of = says = None


@pytest.mark.parametrize(
    ("sources", "sentence"),
    [
        (Note(), "sources: one Note is no list; give a list"),
        ("note", "sources: one str is no list"),
        ([Note], "sources[0]: is the class Note, and no source; call it: Note(...)"),
        ([object()], "sources[0]: object has no name; a source has a name"),
        ([Note(name="my note")], "sources[0]: its name 'my note' is no word"),
        ([Note(name="llm")], "sources[0]: its name 'llm' is taken"),
        ([Note(), Note()], "sources[1]: another one is called 'note', too"),
        ([Note(says=" ")], "sources[0]: its says ' ' is no clause"),
        ([Mute()], "sources[0]: its says None is no clause"),
    ],
)
def test_a_wrong_source_is_found_when_the_session_is_built(sources: Any, sentence: str) -> None:
    with pytest.raises(InputError, match=re.escape(sentence)):
        Session(load_settings(world="fake", llm="none"), sources=sources, recorded=False)


def test_a_wrong_source_among_changed_parts_is_found_too() -> None:
    def change(parts: Parts) -> Parts:
        return replace(parts, sources=(Note(name="user"),))

    with pytest.raises(InputError, match="its name 'user' is taken"):
        Session(load_settings(world="fake", llm="none"), change=change, recorded=False)
