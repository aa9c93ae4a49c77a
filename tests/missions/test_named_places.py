"""Where the words say that a thing is, it is looked for first."""

from pathlib import Path

import pytest
from talking import session_in, told

from executive.replay.replaying import replay
from executive.testing.bench import run_mission
from executive.types.goals import DriveTo
from executive.types.knowledge import Source
from executive.types.outcome import MissionStatus
from kb.facts import FactStore


@pytest.mark.parametrize("kind", ["find", "take", "bring"])
def test_the_place_that_the_words_name_is_looked_at_first(kind: str) -> None:
    run = run_mission(f"{kind} the power_drill from the sofa", llm=False)
    assert run.goals[0] == DriveTo("sofa")
    assert run.outcome.visited == ("sofa", "shelf_lobby")


def test_who_asked_is_the_source_of_the_place(tmp_path: Path) -> None:
    session, _ = session_in(tmp_path)
    outcome = session.run("Bring the mug from the coffee table")
    assert (outcome.status, outcome.inquiries) == (MissionStatus.DONE, 0)
    assert (outcome.source, outcome.location) == (Source.USER, "coffee_table")
    assert told(session)[0] == "I look for the mug on the coffee table: as you said."
    session.close()


def test_a_room_stands_for_its_furniture_with_the_likeliest_first() -> None:
    run = run_mission("Find the scissors from the bedroom", llm=False)
    assert run.outcome.visited == ("desk",)
    assert run.situation.request.from_places == ("desk", "bed", "bookshelf_bedroom")


def test_what_the_robot_remembers_elsewhere_is_looked_for_where_the_words_say_first() -> None:
    facts = FactStore.believing({"mug": ["sofa"]})
    words = "Bring the mug from the coffee table"
    run = run_mission(words, llm=False, facts=facts)
    assert run.outcome.visited == ("coffee_table",)


def test_what_is_not_there_is_said_not_to_be_and_searched_for_as_ever(tmp_path: Path) -> None:
    session, world = session_in(tmp_path)
    outcome = session.run("Bring the power_drill from the dining table")
    assert outcome.visited == ("dining_table", "shelf_lobby")
    assert (outcome.status, outcome.source) == (MissionStatus.DONE, Source.ONTOLOGY)
    assert "The power drill is not on the dining table. I look further." in told(session)
    session.close()
    assert session.folder
    assert replay(session.folder).parting is None


def test_where_the_robot_could_not_look_it_does_not_say_that_nothing_is_there(
    tmp_path: Path,
) -> None:
    session, world = session_in(tmp_path)
    world.fault = lambda goal: "the way is blocked" if goal == DriveTo("desk") else None
    outcome = session.run("Bring the power_drill from the desk")
    assert "I could not get to the desk: the way is blocked. I look further." in told(session)
    assert outcome.status == MissionStatus.DONE
    session.close()


@pytest.mark.parametrize("place", ["attic", "Anna's desk"])
def test_a_place_that_is_not_known_is_asked_for(tmp_path: Path, place: str) -> None:
    session, _ = session_in(tmp_path, ["on the coffee table"])
    outcome = session.run(f"Bring the mug from the {place}")
    assert f"I know no place '{place}'. Where is the mug?" in told(session)
    assert (outcome.status, outcome.visited) == (MissionStatus.DONE, ("coffee_table",))
    session.close()
    assert session.folder
    assert replay(session.folder).parting is None


def test_a_place_that_nobody_knows_does_not_end_the_search(tmp_path: Path) -> None:
    session, _ = session_in(tmp_path, ["I don't know"])
    outcome = session.run("Bring the hammer from the attic")
    assert "I know no place 'attic'; I look for the hammer where it may be." in told(session)
    assert (outcome.status, outcome.visited) == (MissionStatus.DONE, ("shelf_lobby",))
    session.close()


def test_a_thing_that_is_gone_from_there_is_not_looked_for_there_again(tmp_path: Path) -> None:
    fault = ("moved=power_drill:sofa@10",)
    session, _ = session_in(tmp_path, ["on the sofa"], fault=fault, search="paper")
    outcome = session.run("Take the power_drill from the shelf_lobby")
    assert (outcome.status, outcome.visited) == (MissionStatus.DONE, ("shelf_lobby", "sofa"))
    session.close()
    assert session.folder
    assert replay(session.folder).parting is None


@pytest.mark.parametrize(
    "words",
    [
        "Find the mug, but not the desk",
        "Find the mug but not on the desk",
        "Put the mug in the bedroom but not on the bed",
        "Find the mug in the kitchen, not in the bedroom",
    ],
)
def test_who_leaves_out_a_place_is_told_that_it_cannot_be(words: str) -> None:
    run = run_mission(words, llm=False)
    assert not run.goals
    assert run.outcome.reason.startswith("I cannot leave out places; say where I am to look")
