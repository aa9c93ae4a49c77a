"""What the robot remembers of where things are, and what it makes of it."""

import json
import os
import signal
import sqlite3
import subprocess
import sys
from collections.abc import Iterator
from itertools import count
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from executive.app.parts import furniture_at
from executive.errors import InputError
from executive.testing.bench import Run, four_rooms, run_mission
from executive.types.goals import DriveTo, LookAt, Pick, PutDown
from executive.types.knowledge import Source
from executive.types.outcome import MissionStatus
from kb.__main__ import age, main
from kb.facts import Fact, FactKind, FactStore


@pytest.fixture
def facts() -> Iterator[FactStore]:
    store = FactStore(now=count().__next__)
    yield store
    store.close()


def test_a_thing_is_where_it_was_seen_last(facts: FactStore) -> None:
    facts.saw(["mug", "apple"], "desk")
    facts.saw(["mug"], "sofa")
    assert (facts.places_of("mug"), facts.places_of("apple")) == (("sofa",), ("desk",))


def test_what_was_said_since_comes_first_in_the_persons_order(facts: FactStore) -> None:
    facts.saw(["mug"], "desk")
    facts.heard("mug", ["bed", "sofa"])
    assert facts.places_of("mug") == ("bed", "sofa", "desk")


def test_a_look_in_vain_contradicts_what_was_known_before_it(facts: FactStore) -> None:
    facts.saw(["mug"], "desk")
    facts.saw(["mug"], "sofa")
    facts.missed("mug", "sofa")
    assert facts.places_of("mug") == ("desk",)
    facts.saw(["mug"], "sofa")
    assert facts.places_of("mug") == ("sofa",)


def test_what_was_said_not_to_be_there_is_not_until_it_is_seen_or_said_to_be(
    facts: FactStore,
) -> None:
    facts.saw(["mug"], "desk")
    facts.heard_not("mug", ["desk", "sofa"])
    assert facts.places_of("mug") == ()
    assert facts.denials() == {"mug": ("sofa", "desk")}
    facts.heard("mug", ["sofa"])
    assert facts.places_of("mug") == ("sofa",)
    assert facts.denials() == {"mug": ("desk",)}
    facts.saw(["mug"], "desk")
    assert facts.places_of("mug") == ("desk",)
    assert facts.denials() == {}


@given(
    st.lists(
        st.tuples(
            st.sampled_from(["saw", "heard", "heard_not", "missed", "took"]), st.integers(0, 2)
        )
    )
)
def test_no_place_is_believed_and_denied_at_once(told: list[tuple[str, int]]) -> None:
    store = FactStore()
    for what, place in told:
        things: dict[str, tuple[object, object]] = {
            "saw": (["mug"], str(place)),
            "heard": ("mug", [str(place)]),
            "heard_not": ("mug", [str(place)]),
        }
        getattr(store, what)(*things.get(what, ("mug", str(place))))
    believed, denied = store.places_of("mug"), store.denials().get("mug", ())
    assert not {*believed} & {*denied}
    if told and told[-1][0] == "heard_not":
        assert str(told[-1][1]) in denied
    if told and told[-1][0] in ("saw", "heard"):
        assert believed[0] == str(told[-1][1])
    again = FactStore.believing(store.beliefs(), denials=store.denials())
    assert (again.places_of("mug"), {*again.denials().get("mug", ())}) == (believed, {*denied})
    again.close()
    store.close()


def test_a_taken_thing_is_nowhere_until_it_is_put_down(facts: FactStore) -> None:
    facts.saw(["mug"], "desk")
    facts.took("mug", "desk")
    assert facts.places_of("mug") == ()
    facts.put("mug", "delivery")
    assert facts.beliefs() == {"mug": ("delivery",)}


def believed(facts: list[Fact]) -> tuple[str, ...]:
    """What follows from the facts about one thing, read from the newest back."""
    places: list[str] = []
    missed: set[str] = set()
    for fact in reversed(facts):
        if fact.kind == FactKind.TAKEN:
            break
        if fact.kind in (FactKind.MISSED, FactKind.DENIED):
            missed.add(fact.place)
        elif fact.kind != FactKind.LOOKED and fact.place not in missed:
            places.append(fact.place)
            if fact.kind != FactKind.SAID:
                break
    return tuple(dict.fromkeys(places))


a_fact = st.builds(
    Fact,
    st.sampled_from(FactKind),
    st.sampled_from(["mug", "apple"]),
    st.sampled_from(["desk", "sofa", "bed"]),
    st.just(0.0),
)


@given(st.lists(a_fact))
def test_what_is_believed_follows_from_the_facts_in_their_order(told: list[Fact]) -> None:
    store = FactStore()
    store.load(told)
    for name in ("mug", "apple"):
        assert store.places_of(name) == believed([fact for fact in told if fact.object == name])
    store.forget("mug")
    assert store.places_of("mug") == ()
    assert set(store.beliefs()) <= {"apple"}
    store.close()


def test_the_clock_may_be_set_back(facts: FactStore) -> None:
    facts.load([Fact(FactKind.SEEN, "mug", "desk", 2e9), Fact(FactKind.SEEN, "mug", "sofa", 1e9)])
    assert facts.places_of("mug") == ("sofa",)


def test_whoever_does_not_learn_only_reads(tmp_path: Path) -> None:
    FactStore(tmp_path / "facts").saw(["mug"], "desk")
    reader = FactStore(tmp_path / "facts", learns=False)
    reader.missed("mug", "desk")
    assert reader.places_of("mug") == ("desk",)


def test_a_full_disk_costs_the_fact_only(
    facts: FactStore, caplog: pytest.LogCaptureFixture
) -> None:
    facts.saw(["mug"], "desk")
    facts._database.execute("PRAGMA query_only = on")
    facts.saw(["mug"], "sofa")
    assert facts.places_of("mug") == ("desk",)
    assert "a fact could not be kept (mug seen sofa)" in caplog.text


def test_a_memory_that_cannot_be_read_is_no_memory(
    facts: FactStore, caplog: pytest.LogCaptureFixture
) -> None:
    facts.saw(["mug"], "desk")
    facts.close()
    assert facts.places_of("mug") == ()
    assert "facts about the mug could not be read" in caplog.text


@pytest.mark.parametrize("kind", ["text", "other database", "folder"])
def test_a_file_of_something_else_is_refused_and_left_alone(tmp_path: Path, kind: str) -> None:
    file = tmp_path / "file"
    if kind == "text":
        file.write_text("Dear diary," * 100)
    elif kind == "folder":
        file.mkdir()
    else:
        other = sqlite3.connect(file)
        other.execute("CREATE TABLE diary (day)")
        other.close()
    with pytest.raises(InputError, match="file: .*; name a file that --memory made"):
        FactStore(file)


def test_facts_survive_a_kill(tmp_path: Path) -> None:
    code = f"""
from pathlib import Path; from kb.facts import FactStore
facts = FactStore(Path({str(tmp_path / "facts")!r}))
for number in range(10**9):
    facts.saw([f"thing_{{number}}"], "desk")
    print(number, flush=True)
    facts.took(f"thing_{{number}}", "desk")
"""
    with subprocess.Popen(
        [sys.executable, "-c", code], stdout=subprocess.PIPE, text=True
    ) as writer:
        assert writer.stdout
        told = [next(writer.stdout) for _ in range(50)]
        os.kill(writer.pid, signal.SIGKILL)
        told += list(writer.stdout)
    kept = FactStore(tmp_path / "facts")
    seen = [fact.object for fact in kept.all() if fact.kind == FactKind.SEEN]
    taken = [fact.object for fact in kept.all() if fact.kind == FactKind.TAKEN]
    assert seen[: len(told)] == [f"thing_{number}" for number in range(len(told))]
    assert len(told) - 1 <= len(taken) <= len(seen) <= len(told) + 1
    assert list(kept.beliefs()) == [name for name in seen if name not in taken]


# --- in missions ---


def visited_and_asked(run: Run) -> tuple[object, ...]:
    outcome = run.outcome
    return outcome.source, outcome.visited, outcome.inquiries, outcome.llm_calls


def test_the_second_request_needs_no_model_and_no_question(facts: FactStore) -> None:
    first = run_mission("Find an apple.", llm=False, answers=["dining table"], facts=facts)
    assert visited_and_asked(first) == (Source.USER, ("dining_table",), 1, 0)
    second = run_mission("Find an apple.", answers=[], defaults=False, facts=facts)
    assert visited_and_asked(second) == (Source.MEMORY, ("dining_table",), 0, 0)


def test_what_is_seen_by_the_way_is_remembered(facts: FactStore) -> None:
    run_mission("Find an apple.", llm=False, answers=["dining table"], facts=facts)
    assert facts.places_of("banana") == ("dining_table",)


def test_memory_comes_before_the_ontology(facts: FactStore) -> None:
    facts.saw(["hammer"], "sofa")
    run = run_mission("Find a hammer.", place={"hammer": "sofa"}, facts=facts)
    assert visited_and_asked(run) == (Source.MEMORY, ("sofa",), 0, 0)


def test_after_a_wrong_memory_the_ontology_is_asked(facts: FactStore) -> None:
    facts.saw(["hammer"], "sofa")
    run = run_mission("Find a hammer.", facts=facts)
    assert visited_and_asked(run) == (Source.ONTOLOGY, ("sofa", "shelf_lobby"), 0, 0)
    assert facts.places_of("hammer") == ("shelf_lobby",)


def test_no_place_is_looked_at_twice_without_the_persons_word(facts: FactStore) -> None:
    facts.saw(["hammer"], "shelf_lobby")
    liked = {"shelf_lobby": 2.0, "bed": 1.0}
    scores = [liked.get(place.name, 0.0) for place in four_rooms().places()]
    run = run_mission("Find a hammer.", place={"hammer": "bed"}, replies=[scores], facts=facts)
    assert visited_and_asked(run) == (Source.LLM, ("shelf_lobby", "bed"), 0, 1)


def test_the_persons_word_is_remembered_and_contradicted(facts: FactStore) -> None:
    answers = ["desk or sofa", "high table"]
    run = run_mission("Find a peach.", llm=False, answers=answers, facts=facts)
    assert run.outcome.visited == ("desk", "sofa", "high_table")
    kinds = [(fact.kind, fact.place) for fact in facts.all() if fact.object == "peach"]
    assert kinds == [
        (FactKind.SAID, "sofa"),
        (FactKind.SAID, "desk"),
        (FactKind.MISSED, "desk"),
        (FactKind.MISSED, "sofa"),
        (FactKind.SAID, "high_table"),
        (FactKind.SEEN, "high_table"),
    ]


def test_a_place_that_could_not_be_seen_contradicts_nothing(facts: FactStore) -> None:
    facts.saw(["hammer"], "sofa")
    run_mission(
        "Find a hammer.",
        fault=lambda goal: "my neck is stiff" if goal == LookAt("sofa") else None,
        facts=facts,
    )
    assert FactKind.MISSED not in [fact.kind for fact in facts.all()]


def test_a_brought_thing_is_fetched_from_the_delivery_table(facts: FactStore) -> None:
    run_mission("Bring a hammer.", facts=facts)
    assert facts.places_of("hammer") == ("delivery",)
    run = run_mission("Take a hammer.", place={"hammer": "delivery"}, facts=facts)
    assert visited_and_asked(run) == (Source.MEMORY, ("delivery",), 0, 0)
    assert facts.places_of("hammer") == ()


@pytest.mark.parametrize(("goal", "places"), [(Pick, ("shelf_lobby",)), (PutDown, ())])
def test_a_thing_that_was_not_grasped_or_not_put_down_is_not_remembered_so(
    goal: type, places: tuple[str, ...], facts: FactStore
) -> None:
    run = run_mission(
        "Bring a hammer.", fault=lambda g: "no" if isinstance(g, goal) else None, facts=facts
    )
    assert run.outcome.status == MissionStatus.NOT_DONE
    assert facts.places_of("hammer") == places


def test_a_place_of_another_home_is_not_visited(facts: FactStore) -> None:
    facts.saw(["hammer"], "attic_shelf")
    run = run_mission("Find a hammer.", facts=facts)
    assert run.goals[0] == DriveTo("shelf_lobby")


def test_a_thing_is_on_the_furniture_below_it() -> None:
    home = four_rooms()
    for piece in (*home.furniture, home.delivery):
        assert furniture_at(home, (*piece.pose[:2], 1.0)) == piece.name
        inside, outside = piece.size[0] / 2 - 0.01, piece.size[0] / 2 + 0.01
        assert furniture_at(home, piece.to_map((inside, 0.0, 1.0))) == piece.name
        assert furniture_at(home, piece.to_map((outside, 0.0, 1.0))) != piece.name


# --- from the command line ---


@pytest.fixture
def file(tmp_path: Path) -> Path:
    path = tmp_path / "facts.sqlite"
    store = FactStore(path, now=lambda: 1e9)
    store.saw(["mug", "apple"], "desk")
    store.close()
    return path


def test_facts_are_shown_with_their_age(file: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["facts", "--memory", str(file)]) == 0
    [first, _] = capsys.readouterr().out.splitlines()
    assert "mug" in first
    assert "seen" in first
    assert "desk" in first
    assert "days ago" in first


@pytest.mark.parametrize(
    ("seconds", "said"),
    [(-1, "0 seconds"), (1.2, "1 second"), (90, "90 seconds"), (7300, "2 hours")],
)
def test_an_age_is_told_in_the_unit_that_fits(seconds: float, said: str) -> None:
    assert age(seconds) == said


def test_facts_are_printed_as_json(file: Path, capsys: pytest.CaptureFixture[str]) -> None:
    main(["facts", "--memory", str(file), "--json"])
    [mug, _] = json.loads(capsys.readouterr().out)
    assert mug == {"kind": "seen", "object": "mug", "place": "desk", "time_s": 1e9}


@pytest.mark.parametrize(("words", "left"), [(["mug"], ["apple"]), ([], []), (["the Mugs"], None)])
def test_facts_are_forgotten(file: Path, words: list[str], left: list[str] | None) -> None:
    assert main(["forget", "--memory", str(file), *words]) == 0
    kept = [fact.object for fact in FactStore(file).all()]
    assert kept == (["apple"] if left is None else left)


@pytest.mark.parametrize("command", ["facts", "forget"])
def test_a_missing_file_is_no_empty_memory(
    command: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main([command, "--memory", str(tmp_path / "none")]) == 2
    assert "there is no such file" in capsys.readouterr().err
    assert not (tmp_path / "none").exists()
