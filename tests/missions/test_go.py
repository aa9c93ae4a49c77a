"""Go somewhere."""

from pathlib import Path

import pytest
from talking import session_in, session_of, told

from executive.replay.replaying import replay
from executive.testing.bench import run_mission
from executive.types.goals import DriveTo
from executive.types.outcome import MissionStatus


@pytest.mark.parametrize(
    ("words", "there", "said"),
    [
        ("Go to the desk", "desk", "I am at the desk."),
        ("Drive to the desk", "desk", "I am at the desk."),
        ("Go next to the desk", "desk", "I am at the desk."),
        ("Go to the kitchen", "cabinet_kitchen", "I am at the cabinet in the kitchen."),
        ("Go to me", "person", "Here I am."),
    ],
)
def test_the_robot_goes_to_furniture_rooms_and_the_person(
    words: str, there: str, said: str
) -> None:
    run = run_mission(words, llm=False)
    assert (run.outcome.status, run.world.at) == (MissionStatus.DONE, there)
    assert run.outcome.reason == said


def test_of_a_room_any_furniture_will_do() -> None:
    run = run_mission(
        "Go to the kitchen",
        llm=False,
        fault=lambda goal: "shut" if goal == DriveTo("cabinet_kitchen") else None,
    )
    assert (run.outcome.status, run.world.at) == (MissionStatus.DONE, "counter_wagon")


def test_all_of_a_room_that_could_not_be_reached_is_told() -> None:
    doors = {DriveTo(place): "it is shut" for place in ("shelf_lobby", "sideboard")}
    shut = run_mission("Go to the lobby", llm=False, fault=doors.get)
    assert shut.outcome.reason == (
        "I could not get to the shelf in the lobby and the sideboard: it is shut"
    )


@pytest.mark.physics
def test_in_physics_it_gets_there(tmp_path: Path) -> None:
    session = session_of(tmp_path, world="physics", camera_hz=0.0)
    for place in ("desk", "person", "kitchen"):
        assert session.run(f"Go to {place}").status == MissionStatus.DONE
        assert session.folder
        assert replay(session.folder).parting is None
    session.close()


def test_a_place_that_is_not_known_is_asked_for(tmp_path: Path) -> None:
    session, world = session_in(tmp_path, ["to the bed"])
    assert session.run("Go to Anna").status == MissionStatus.DONE
    assert "I do not know where 'Anna' is. Where shall I go?" in told(session)
    assert world.at == "bed"
    session.close()
    assert session.folder
    assert replay(session.folder).parting is None


def test_what_it_holds_goes_with_it_and_why_it_could_not_go_is_said(tmp_path: Path) -> None:
    session, world = session_in(tmp_path)
    session.run("Take the hammer")
    world.fault = lambda goal: "the way is blocked" if goal == DriveTo("bed") else None
    outcome = session.run("Go to the bed")
    assert (outcome.status, world.held) == (MissionStatus.NOT_DONE, "hammer")
    assert outcome.reason == "I could not get to the bed: the way is blocked"
    session.close()
    assert session.folder
    assert replay(session.folder).parting is None


def test_where_the_robot_was_just_sent_it_puts_down_what_it_holds() -> None:
    run = run_mission("Take the scissors, go to the sofa and put them down", llm=False)
    assert (run.outcome.status, run.world.resting_place("scissors")) == (MissionStatus.DONE, "sofa")
    run = run_mission("Take the scissors, go to the sofa, come here and put them down", llm=False)
    assert run.world.resting_place("scissors") == "delivery"


def test_that_it_was_sent_there_counts_in_the_next_mission(tmp_path: Path) -> None:
    session, world = session_in(tmp_path)
    for words in ("Take the mug", "Go to the sofa", "Put it down"):
        assert session.run(words).status == MissionStatus.DONE
    assert world.resting_place("mug") == "sofa"
    session.close()
    assert session.folder
    assert replay(session.folder).parting is None


def test_the_next_search_is_planned_from_where_the_robot_was_sent(tmp_path: Path) -> None:
    session = session_of(tmp_path, defaults=False, place={"mug": "desk"})
    session.run("Go to the bed")
    assert session.run("Find the mug").visited[0] == "bed"
    session.close()
    assert session.folder
    assert replay(session.folder).parting is None
