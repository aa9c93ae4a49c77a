"""A full table, a full hand: where things are put down then, and what the robot says of it."""

import io
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from executive.app.parts import near_person
from executive.app.session import Session
from executive.config import load_settings
from executive.events import Inbox
from executive.language.grammar import EnglishInterpreter
from executive.replay.replaying import replay
from executive.testing.bench import four_rooms
from executive.types.commands import HELD, CommandKind
from executive.types.goals import DriveTo, Goal, PutDown
from executive.types.home import DELIVERY, SOMETHING
from executive.types.outcome import MissionStatus
from executive.user import Scripted
from sim.fake import FakeWorld

FULL = "there is no free spot on the delivery table"
HAMMERS_PLACE = four_rooms().placement["hammer"]
NEAR = ("coffee_table", "sofa", "dining_table")

Serve = Callable[..., tuple[Session, FakeWorld]]


@pytest.fixture
def serve(tmp_path: Path) -> Iterator[Serve]:
    """Makes a session in which these places have no room, with a person who answers so."""
    sessions: list[Session] = []

    def make(answers: Iterable[str | None], *full: str) -> tuple[Session, FakeWorld]:
        inbox = Inbox()
        settings = load_settings(world="fake", llm="none", runs=tmp_path)
        session = Session(settings, inbox=inbox, user=Scripted(inbox, answers), out=io.StringIO())
        sessions.append(session)
        assert isinstance(session.world, FakeWorld)
        session.world.fault = lambda goal: fault(goal, full)
        return session, session.world

    yield make
    for session in sessions:
        if session.folder:
            for run in session.folder.parent.iterdir():
                assert replay(run).parting is None
        session.close()


def fault(goal: Goal, full: tuple[str, ...]) -> str | None:
    no_room = isinstance(goal, PutDown) and goal.place in full
    return f"there is no free spot on the {goal.place}" if no_room else None


def test_a_full_delivery_table_is_no_dead_end(serve: Serve) -> None:
    session, world = serve([], DELIVERY)
    outcome = session.run("Bring the hammer")
    assert outcome.status == MissionStatus.NOT_DONE
    assert outcome.reason == (
        f"I put the hammer on the coffee table; I could not put it on the delivery table: {FULL}"
    )
    assert (world.held, world.resting_place("hammer")) == (None, "coffee_table")
    assert session.run("Take the power_drill").status == MissionStatus.DONE


def test_the_next_furniture_is_tried_if_the_nearest_is_full_or_out_of_reach(serve: Serve) -> None:
    session, world = serve([])
    shut = DriveTo("sofa")
    world.fault = lambda g: "shut" if g == shut else fault(g, (DELIVERY, "coffee_table"))
    assert session.run("Bring the hammer").status == MissionStatus.NOT_DONE
    assert world.resting_place("hammer") == "dining_table"


def test_the_person_is_asked_where_to_put_it_if_all_that_is_near_is_full(serve: Serve) -> None:
    session, world = serve(["in the pantry", "on the desk"], DELIVERY, *NEAR)
    outcome = session.run("Bring the hammer")
    assert (outcome.status, outcome.inquiries) == (MissionStatus.NOT_DONE, 2)
    assert world.resting_place("hammer") == "desk"
    assert outcome.reason.startswith("I put the hammer on the desk; ")
    assert isinstance(session.parts.user, Scripted)
    first, second = session.parts.user.asked
    assert first.text == (
        f"I could not put it on the delivery table: {FULL}; "
        "nor on the coffee table, the sofa or the dining table. Where shall I put the hammer?"
    )
    assert second.text.startswith("I know no such place. Where shall I put the hammer? I know: ")


def test_who_can_get_nowhere_says_so_when_it_asks_and_when_it_gives_up(serve: Serve) -> None:
    session, world = serve([])
    session.run("Take the hammer")
    world.fault = lambda goal: "the door is shut" if isinstance(goal, DriveTo) else None
    outcome = session.run("Put it down")
    assert isinstance(session.parts.user, Scripted)
    (question,) = session.parts.user.asked
    nowhere = (
        "I could not put it on the delivery table: the door is shut; "
        "nor on the coffee table, the sofa or the dining table"
    )
    assert question.text == f"{nowhere}. Where shall I put the hammer?"
    assert outcome.reason.startswith(f"{nowhere}, and ")


def test_what_finds_no_room_stays_in_the_hand_and_can_be_brought_later(serve: Serve) -> None:
    session, world = serve([], DELIVERY, *NEAR)
    outcome = session.run("Bring the hammer")
    assert outcome.status == MissionStatus.NOT_DONE
    assert outcome.reason.endswith("the script has no more answers; I still hold the hammer")
    assert world.held == "hammer"
    world.fault = lambda goal: None
    assert session.run("Bring the hammer").status == MissionStatus.DONE
    assert world.resting_place("hammer") == DELIVERY


def test_what_falls_on_the_way_to_other_furniture_is_said_to_have_fallen(tmp_path: Path) -> None:
    settings = load_settings(
        world="fake", llm="none", user="none", runs=tmp_path, fault=("drop@32",)
    )
    session = Session(settings, out=io.StringIO(), recorded=False)
    assert isinstance(session.world, FakeWorld)
    session.world.fault = lambda goal: fault(goal, (DELIVERY, "coffee_table"))
    outcome = session.run("Bring the hammer")
    session.close()
    assert (outcome.status, session.world.held) == (MissionStatus.NOT_DONE, None)
    assert outcome.reason.startswith("the hammer fell from my hand")


@pytest.mark.parametrize("words", ["Put it down", "Empty your hand", "Put down the hammer"])
def test_the_hand_is_emptied_on_request(serve: Serve, words: str) -> None:
    session, world = serve([])
    session.run("Take the hammer")
    outcome = session.run(words)
    assert (outcome.status, outcome.kind) == (MissionStatus.DONE, CommandKind.PUT_DOWN)
    assert outcome.reason == "I put the hammer on the delivery table."
    assert (world.held, world.resting_place("hammer")) == (None, DELIVERY)
    assert session.run("Find the hammer").location == DELIVERY


def test_nothing_is_put_down_that_is_not_in_the_hand(serve: Serve) -> None:
    session, world = serve([])
    assert session.run("Put it down").reason == "my hand is empty"
    session.run("Take the hammer")
    assert session.run("Put the mug down").reason == "my hand holds the hammer, not the mug"
    assert world.held == "hammer"


def test_a_hand_that_cannot_be_emptied_is_said_to_be_full(serve: Serve) -> None:
    session, world = serve([], DELIVERY, *NEAR)
    session.run("Take the hammer")
    outcome = session.run("Put it down")
    assert outcome.status == MissionStatus.NOT_DONE
    assert outcome.reason.endswith("I still hold the hammer")
    assert world.held == "hammer"


def test_what_is_not_known_by_name_is_put_down_all_the_same(serve: Serve) -> None:
    session, world = serve(["yes"])
    world.held = "hammer"
    del world.things["hammer"]
    outcome = session.run("Put that down")
    assert (outcome.status, outcome.reason) == (
        MissionStatus.DONE,
        f"I put {SOMETHING} on the delivery table.",
    )
    assert world.resting_place("hammer") == DELIVERY


@pytest.mark.parametrize("words", ["Take the power_drill", "Bring the power_drill"])
def test_what_is_held_is_put_back_for_another_thing(serve: Serve, words: str) -> None:
    session, world = serve([])
    place = world.resting_place("hammer")
    session.run("Take the hammer")
    outcome = session.run(words)
    assert (outcome.status, outcome.object) == (MissionStatus.DONE, "power_drill")
    assert world.resting_place("hammer") == place
    assert outcome.visited == ("shelf_lobby",)


def test_what_is_held_is_put_down_by_the_person_if_it_has_no_room_where_it_was(
    serve: Serve,
) -> None:
    session, world = serve([], HAMMERS_PLACE, DELIVERY)
    session.run("Take the hammer")
    session.run("Bring the power_drill")
    assert world.resting_place("hammer") == "coffee_table"
    assert world.held is None


def test_a_full_hand_without_room_for_what_it_holds_says_so(serve: Serve) -> None:
    session, world = serve(["I don't know"], HAMMERS_PLACE, DELIVERY, *NEAR)
    session.run("Take the hammer")
    outcome = session.run("Bring the power_drill")
    assert (outcome.status, world.held) == (MissionStatus.NOT_DONE, "hammer")
    assert outcome.reason.endswith("and you could not tell me; I still hold the hammer")


def test_the_furniture_by_the_person_is_that_of_the_room_first_and_then_the_nearest() -> None:
    assert near_person(four_rooms())[:4] == (*NEAR, "desk")


@pytest.mark.parametrize(
    ("words", "thing"),
    [
        ("Put it down.", HELD),
        ("please put that down now", HELD),
        ("Could you put down the thing, please?", HELD),
        ("Put down what you hold", HELD),
        ("Empty your hand!", HELD),
        ("drop it", HELD),
        ("Let go of it", HELD),
        ("let go", HELD),
        ("put the mug down", "mug"),
        ("Set down the sugar box, please", "sugar box"),
        ("Drop the hammer", "hammer"),
    ],
)
def test_reads_a_request_to_empty_the_hand(words: str, thing: str) -> None:
    command = EnglishInterpreter().command(words)
    assert command is not None
    assert (command.kind, command.target) == (CommandKind.PUT_DOWN, thing)


@pytest.mark.parametrize(
    "words",
    [
        "put",
        "put the mug on the desk",
        "put the mug down on the desk",
        "drop",
        "put it back",
        "set",
    ],
)
def test_what_asks_for_more_than_an_empty_hand_is_not_read_as_that(words: str) -> None:
    command = EnglishInterpreter().command(words)
    assert command is None or command.kind != CommandKind.PUT_DOWN


@given(st.text() | st.from_regex(r"(put|drop|please|down|the| )*"))
def test_what_is_to_be_put_down_is_never_nothing(words: str) -> None:
    command = EnglishInterpreter().command(words)
    assert command is None or command.target.strip()
