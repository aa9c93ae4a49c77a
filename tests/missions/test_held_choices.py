"""An experimenter holds what the robot chooses: it waits, and goes on where they say."""

import io
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pytest
from talking import without_room

from executive.app.session import Session
from executive.config import load_settings
from executive.events import OFF, ON, Deed, Event, Heard, Inbox, Intervened, StopRequested
from executive.records import Record, Tick
from executive.replay import replay
from executive.testing.bench import run_mission
from executive.types.goals import DriveTo
from executive.types.home import DELIVERY
from executive.types.outcome import MissionStatus, Outcome
from executive.user import Scripted
from kb.facts import FactStore
from logs.recorder import Stamp
from logs.recording.reader import Run
from sim.fake import FakeWorld

DONE = MissionStatus.DONE
ANNA = "Anna"
HOLD = Intervened(ANNA, Deed.HOLD_PLACE, "", ON)
LET_GO = Intervened(ANNA, Deed.HOLD_PLACE, "", OFF)
PLAN = {"search": "plan"}
PAPER = {"search": "paper"}


def send(place: str) -> Intervened:
    return Intervened(ANNA, Deed.PLACE, "", place)


@dataclass
class Experimenter:
    """Implements Sink: does one deed after the other, each time that a choice waits."""

    inbox: Inbox
    deeds: list[Event]
    held: list[dict[str, Any]] = field(default_factory=list)
    live = False

    def write(self, stamp: Stamp, record: Record) -> None:
        """Look whether one does."""
        if isinstance(record, Tick) and (choice := record.situation["held_choice"]):
            self.held.append(choice)
            self.inbox.post(self.deeds.pop(0) if self.deeds else StopRequested("nobody"))

    def flush(self) -> None:
        """Nothing is kept back."""

    def close(self) -> None:
        """The mission is over."""


@dataclass
class Held:
    """A mission in which choices were held from the start."""

    outcome: Outcome
    world: FakeWorld
    choices: list[dict[str, Any]]
    said: list[str]


@pytest.fixture
def runs(tmp_path: Path) -> Iterator[Path]:
    """Where missions are recorded: each of them has to replay tick for tick."""
    yield tmp_path
    made = list(tmp_path.iterdir())
    assert made
    for run in made:
        assert replay(run).parting is None


def held(runs: Path, words: str, *deeds: Event, no_room: str = "", **settings: Any) -> Held:
    inbox = Inbox()
    anna = Experimenter(inbox, list(deeds))
    chosen = load_settings(**{"world": "fake", "llm": "none", "runs": runs, **PLAN, **settings})
    user, words_said = Scripted(inbox, ["desk", "yes"]), io.StringIO()
    with Session(chosen, inbox=inbox, user=user, out=words_said, sinks=[anna]) as session:
        world = session.embodiment.truth
        assert isinstance(world, FakeWorld)
        if no_room:
            world.fault = without_room(no_room)
        session.standing = lambda: [HOLD]
        outcome = session.run(words)
    assert not anna.deeds
    return Held(outcome, world, anna.held, user.told)


@pytest.mark.parametrize("search", ["plan", "paper"])
def test_what_is_let_go_is_done_as_it_was_chosen(runs: Path, search: str) -> None:
    mission = held(runs, "Find the hammer on the desk", LET_GO, search=search)
    assert mission.choices[0]["place"] == "desk"
    assert mission.outcome.visited[0] == "desk"


@pytest.mark.parametrize("search", ["plan", "paper"])
def test_another_place_is_looked_at_instead_and_the_rest_goes_on(runs: Path, search: str) -> None:
    words = "Find the hammer on the desk"
    mission = held(runs, words, send("shelf_lobby"), search=search)
    assert (mission.outcome.status, mission.outcome.visited) == (DONE, ("shelf_lobby",))
    assert mission.outcome.source == "experimenter"


def test_each_choice_waits_as_long_as_they_are_held(runs: Path) -> None:
    mission = held(runs, "Find the hammer", send("sofa"), send("bed"), send("shelf_lobby"))
    assert mission.outcome.visited == ("sofa", "bed", "shelf_lobby")
    assert len({choice["place"] for choice in mission.choices}) == 1


def test_the_person_is_not_told_who_chose(runs: Path) -> None:
    mission = held(runs, "Find the hammer", send("sofa"), send("shelf_lobby"))
    assert not any("experimenter" in said for said in mission.said)
    assert any("on the sofa" in said for said in mission.said)


def test_a_place_that_is_none_here_is_not_gone_to(runs: Path) -> None:
    mission = held(runs, "Find the hammer on the desk", send("moon"), LET_GO)
    assert "moon" not in mission.outcome.visited
    assert mission.outcome.visited[0] == "desk"
    assert len(mission.choices) == 2


def test_a_stop_is_done_while_a_choice_waits(runs: Path) -> None:
    mission = held(runs, "Find the hammer", StopRequested("Anna"))
    assert mission.outcome.status == MissionStatus.STOPPED
    assert not mission.outcome.visited


def test_what_the_person_takes_back_waits_no_more(runs: Path) -> None:
    mission = held(runs, "Find the hammer", Heard("leave the hammer alone"))
    assert mission.outcome.status == MissionStatus.NOT_DONE
    assert not mission.outcome.visited


def test_of_the_places_that_the_person_named_another_one_may_be_chosen(runs: Path) -> None:
    words = "Put the peach on the desk or the bed"
    mission = held(runs, words, send("high_table"), send("bed"))
    assert mission.choices[1] == {"to": "put", "place": "desk", "among": ["desk", "bed"]}
    assert mission.world.resting_place("peach") == "bed"


def test_where_the_person_did_not_say_a_thing_is_not_put(runs: Path) -> None:
    words = "Put the peach on the desk or the bed"
    mission = held(runs, words, send("high_table"), send("sofa"), LET_GO)
    assert (mission.outcome.status, mission.world.resting_place("peach")) == (DONE, "desk")


def test_one_place_is_no_choice(runs: Path) -> None:
    mission = held(runs, "Put the peach on the desk", send("high_table"))
    assert [choice["to"] for choice in mission.choices] == ["look"]


def test_where_another_place_has_no_room_the_one_that_was_chosen_is_tried(runs: Path) -> None:
    words = "Put the peach on the desk or the bed"
    mission = held(runs, words, send("high_table"), send("bed"), no_room="bed")
    assert (mission.outcome.status, mission.world.resting_place("peach")) == (DONE, "desk")


def test_where_the_robot_gets_rid_of_a_thing_may_be_any_furniture(runs: Path) -> None:
    words = "Bring the peach"
    mission = held(runs, words, send("high_table"), send("sofa"), no_room=DELIVERY)
    assert mission.choices[1]["to"] == "put"
    assert mission.world.resting_place("peach") == "sofa"


def test_what_nobody_lets_go_is_let_go_in_the_end(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("trees.held.HELD_S", 0.0)
    facts = FactStore.believing({"hammer": ["shelf_lobby"]})
    mission = run_mission("Find the hammer", llm=False, search="plan", first=[HOLD], facts=facts)
    assert mission.goals[0] == DriveTo("shelf_lobby")
    assert mission.ticks[-1].situation["holds_places"]


def test_each_intervention_is_in_the_recording_with_who_did_it(runs: Path) -> None:
    mission = held(runs, "Find the hammer on the desk", send("shelf_lobby"))
    run = Run(Path(mission.outcome.run_dir or ""))
    deeds = [at.value for at in run.events() if isinstance(at.value, Intervened)]
    assert deeds == [HOLD, send("shelf_lobby")]
