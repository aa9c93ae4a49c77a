"""Put something somewhere: it is there in the end, or it is said where it is instead."""

from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from talking import session_in, session_of, told, without_room

from executive.app.session import Session
from executive.campaign.truth import completed, whereabouts
from executive.events import Inbox
from executive.replay.replaying import replay
from executive.testing.bench import Run, run_mission
from executive.types.commands import CommandKind
from executive.types.goals import DriveTo, Goal, Pick, PutDown
from executive.types.home import DELIVERY, HAND
from executive.types.outcome import MissionStatus
from logs.questions.decision import why_text
from logs.questions.why import why
from logs.recording.reader import Run as Recorded
from sim.fake import FakeWorld

Serve = Callable[..., tuple[Session, FakeWorld]]


@pytest.fixture
def serve(tmp_path: Path) -> Iterator[Serve]:
    """Makes a session whose missions all have to replay as recorded."""
    sessions: list[Session] = []

    def make(*answers: str | None, **settings: object) -> tuple[Session, FakeWorld]:
        session, world = session_in(tmp_path / str(len(sessions)), answers, **settings)
        sessions.append(session)
        return session, world

    yield make
    for session in sessions:
        session.close()
        for run in session.settings.runs.iterdir():
            assert replay(run).parting is None


def put(words: str, **given: object) -> Run:
    return run_mission(words, llm=False, **given)


def saying_once(words: str) -> Callable[[Goal, Inbox], None]:
    """Says it as the robot begins with its first goal."""
    left = [words]

    def during(goal: Goal, inbox: Inbox) -> None:
        if left:
            inbox.hear(left.pop())

    return during


def end_of(run: Run) -> tuple[str, str]:
    """How it ended, and where the thing is."""
    return run.outcome.status, whereabouts(run.outcome.object or "", run.world)


@pytest.mark.parametrize(
    "words",
    [
        "Put the hammer on the desk",
        "Put the hammer on the desk in the bedroom",
        "Bring the hammer to the desk",
        "Take the hammer to the desk",
    ],
)
def test_what_is_to_go_somewhere_is_put_there(words: str) -> None:
    run = put(words)
    assert end_of(run) == (MissionStatus.DONE, "desk")
    assert run.outcome.kind == CommandKind.PUT
    assert run.outcome.reason == "I put the hammer on the desk."


def test_a_campaign_knows_whether_it_is_there() -> None:
    outcome = put("Put the hammer in the bedroom").outcome
    assert completed(outcome, lambda name: "desk")
    assert completed(outcome, lambda name: "bed")
    assert not completed(outcome, lambda name: "sofa")
    assert not completed(outcome, lambda name: HAND)


def test_in_a_room_it_is_put_where_that_is_easiest_and_else_on_other_furniture_there() -> None:
    assert end_of(put("Put the hammer in the bedroom")) == (MissionStatus.DONE, "desk")
    run = put("Put the hammer in the bedroom", fault=without_room("desk"))
    assert end_of(run) == (MissionStatus.DONE, "bookshelf_bedroom")
    shut = {DriveTo("desk"), DriveTo("bookshelf_bedroom")}
    run = put("Put the hammer in the bedroom", fault=lambda goal: "shut" if goal in shut else None)
    assert end_of(run) == (MissionStatus.DONE, "bed")


def test_what_is_brought_to_the_person_is_put_on_the_delivery_table() -> None:
    for words in ("Bring the hammer to me", "Put the hammer here"):
        assert end_of(put(words)) == (MissionStatus.DONE, DELIVERY)


def test_what_is_there_already_stays_there() -> None:
    run = put("Put the hammer on the shelf_lobby")
    assert end_of(run) == (MissionStatus.DONE, "shelf_lobby")
    assert run.outcome.reason == "The hammer is on the shelf in the lobby already."
    assert not any(isinstance(goal, Pick) for goal in run.goals)


def test_what_somebody_else_took_there_does_not_stay_in_the_hand(serve: Serve) -> None:
    session, world = serve(fault=("moved=mug:desk@5",))
    assert session.run("Put the mug on the desk").status == MissionStatus.DONE
    assert (world.held, world.resting_place("mug")) == (None, "desk")


@pytest.mark.parametrize("thing", ["the hammer", "it"])
def test_what_is_in_the_hand_is_not_searched_for(serve: Serve, thing: str) -> None:
    session, world = serve()
    session.run("Take the hammer")
    outcome = session.run(f"Put {thing} on the sofa")
    assert (outcome.status, outcome.visited) == (MissionStatus.DONE, ())
    assert (world.held, world.resting_place("hammer")) == (None, "sofa")


def test_what_is_not_known_by_name_is_put_back_where_the_person_says(serve: Serve) -> None:
    session, world = serve("on the desk")
    world.held = "hammer"
    del world.things["hammer"]
    assert session.run("Put it back").reason == "I put something back on the desk."
    assert world.resting_place("hammer") == "desk"


def test_it_is_not_done_without_room_and_the_thing_stays_in_the_hand(serve: Serve) -> None:
    session, world = serve("I don't know")
    world.fault = without_room("desk")
    outcome = session.run("Put the hammer on the desk")
    assert (outcome.status, world.held) == (MissionStatus.NOT_DONE, "hammer")
    assert outcome.reason == (
        "there is no free spot on the desk, and you could not tell me; I still hold the hammer"
    )


def test_it_is_put_elsewhere_only_where_the_person_says_and_that_is_not_done(serve: Serve) -> None:
    session, world = serve("on the sofa")
    world.fault = without_room("desk")
    outcome = session.run("Put the hammer on the desk")
    assert (outcome.status, world.resting_place("hammer")) == (MissionStatus.NOT_DONE, "sofa")
    assert outcome.reason == (
        "there is no free spot on the desk; I put it on the sofa instead, as you said"
    )


def test_that_there_is_no_way_to_where_the_person_says_is_told_too(serve: Serve) -> None:
    session, world = serve("on the bed")
    shut = {DriveTo("desk"): "the door is shut", DriveTo("bed"): "a chair is in the way"}
    world.fault = shut.get
    outcome = session.run("Put the hammer on the desk")
    assert outcome.reason == (
        "I could not get to the desk: the door is shut; "
        "I could not put it on the bed: a chair is in the way; I still hold the hammer"
    )


def test_a_way_that_is_blocked_is_said(serve: Serve) -> None:
    session, world = serve("no idea")
    world.fault = lambda goal: "the way is blocked" if goal == DriveTo("desk") else None
    outcome = session.run("Put the hammer on the desk")
    assert (outcome.status, world.held) == (MissionStatus.NOT_DONE, "hammer")
    assert outcome.reason.startswith("I could not get to the desk: the way is blocked, and ")


@pytest.mark.parametrize("place", ["Anna", "attic", "Robert in the kitchen"])
def test_who_or_what_is_not_known_is_asked_for_before_anything_is_done(
    serve: Serve, place: str
) -> None:
    session, world = serve("put it on the desk")
    outcome = session.run(f"Bring the hammer to {place}")
    asked = f"I do not know where '{place}' is. Where shall I put the hammer?"
    assert asked in told(session)
    assert (outcome.status, world.resting_place("hammer")) == (MissionStatus.DONE, "desk")


@pytest.mark.parametrize("place", ["under the desk", "next to the desk"])
def test_what_cannot_be_put_so_is_not_put_otherwise(serve: Serve, place: str) -> None:
    session, world = serve("I don't know")
    outcome = session.run(f"Put the hammer {place}")
    assert (outcome.status, world.resting_place("hammer")) == ("not_done", "shelf_lobby")
    assert outcome.reason == (
        f"I can put things on furniture, or in it, but not '{place}', and you could not tell me"
    )


def test_beside_a_thing_is_where_that_is_believed_to_be(serve: Serve) -> None:
    session, world = serve()
    session.run("The mug is on the sofa")
    outcome = session.run("Put the hammer next to the mug")
    assert "As far as I know, the mug is on the sofa." in told(session)
    assert (outcome.status, world.resting_place("hammer")) == (MissionStatus.DONE, "sofa")


def test_beside_one_of_two_things_is_beside_the_one_that_is_found(serve: Serve) -> None:
    session, world = serve()
    outcome = session.run("Put the apple next to the mug or the hammer")
    assert (outcome.status, world.resting_place("apple")) == (MissionStatus.DONE, "coffee_table")


def test_what_it_is_to_be_put_beside_is_found_first(serve: Serve) -> None:
    session, world = serve()
    outcome = session.run("Take the hammer from the shelf in the lobby and put it next to the mug")
    assert "The mug is on the coffee table in the living room." in told(session)
    assert (outcome.status, world.resting_place("hammer")) == (MissionStatus.DONE, "coffee_table")
    assert outcome.reason == "I put the hammer on the coffee table."


def test_beside_what_cannot_be_found_nothing_is_put(serve: Serve) -> None:
    session, world = serve("I don't know")
    outcome = session.run("Put the hammer next to the unicorn")
    assert (outcome.status, world.resting_place("hammer")) == ("not_done", "shelf_lobby")


def test_beside_what_the_robot_holds_it_is_asked_where_to(serve: Serve) -> None:
    session, world = serve("on the desk", "on the desk")
    session.run("Take the mug")
    outcome = session.run("Put the hammer next to the mug")
    assert "I do not know where the mug is. Where shall I put the hammer?" in told(session)
    assert (outcome.status, world.resting_place("hammer")) == (MissionStatus.DONE, "desk")


def test_of_places_to_choose_from_any_will_do() -> None:
    run = put("Put the hammer on the sofa or desk", fault=without_room("desk"))
    assert end_of(run) == (MissionStatus.DONE, "sofa")


def test_nothing_is_done_if_nobody_knows_where_to_put_it(serve: Serve) -> None:
    session, world = serve("I don't know")
    outcome = session.run("Bring the hammer to Anna")
    assert (outcome.status, outcome.visited) == (MissionStatus.NOT_DONE, ())
    assert outcome.reason == "I do not know where 'Anna' is, and you could not tell me"
    assert world.resting_place("hammer") == "shelf_lobby"


def test_a_word_for_several_places_is_asked_about(serve: Serve) -> None:
    session, world = serve("the high one", "the high table")
    outcome = session.run("Put the hammer on the table")
    asked = "Which table do you mean: the high table, the dining table or the coffee table?"
    assert asked in told(session)
    assert (outcome.status, world.resting_place("hammer")) == (MissionStatus.DONE, "high_table")


def test_what_nobody_says_where_to_put_is_asked_for(serve: Serve) -> None:
    session, world = serve("on the bed")
    assert session.run("Put the hammer").status == MissionStatus.DONE
    assert "Where shall I put the hammer?" in told(session)
    assert world.resting_place("hammer") == "bed"


@pytest.mark.parametrize("when", ["drop@1", "drop@32", "drop@35", "drop@40"])
def test_what_falls_on_the_way_is_there_or_said_to_have_fallen(serve: Serve, when: str) -> None:
    session, world = serve(fault=(when,))
    outcome = session.run("Put the hammer on the desk")
    done = outcome.status == MissionStatus.DONE
    assert done == (world.resting_place("hammer") == "desk")
    assert done or "hammer" in outcome.reason


def test_what_was_brought_is_put_back_where_it_was_taken(serve: Serve) -> None:
    session, world = serve()
    session.run("Bring the mug from the coffee table")
    assert world.resting_place("mug") == DELIVERY
    outcome = session.run("Put the mug back")
    assert (outcome.status, outcome.goals) == (MissionStatus.DONE, ("coffee_table",))
    assert outcome.reason == "I put the mug back on the coffee table."
    assert world.resting_place("mug") == "coffee_table"


def test_what_is_in_the_hand_is_put_back_even_if_it_was_on_the_delivery_table_since(
    serve: Serve,
) -> None:
    session, world = serve()
    session.run("Bring the mug from the coffee table")
    session.run("Take the mug")
    assert session.run("Put it back").status == MissionStatus.DONE
    assert world.resting_place("mug") == "coffee_table"


def test_where_it_was_taken_is_known_from_the_memory_of_another_day(
    serve: Serve, tmp_path: Path
) -> None:
    first, _ = serve(memory=tmp_path / "memory.db")
    first.run("Bring the mug from the coffee table")
    second, world = serve(memory=tmp_path / "memory.db")
    world.things["mug"] = DELIVERY
    assert second.run("Put the mug back").status == MissionStatus.DONE
    assert world.resting_place("mug") == "coffee_table"


def test_what_was_not_taken_from_anywhere_goes_where_it_belongs_and_that_is_said(
    serve: Serve,
) -> None:
    session, world = serve(place={"hammer": "sofa"})
    outcome = session.run("Put back the hammer from the sofa")
    assert "I do not know where the hammer was; it belongs on the shelf in the lobby." in told(
        session
    )
    assert (outcome.status, world.resting_place("hammer")) == (MissionStatus.DONE, "shelf_lobby")


def test_why_tells_who_said_where_to_put_it(serve: Serve) -> None:
    session, world = serve("on the sofa")
    world.fault = without_room("desk")
    session.run("Put the hammer from the shelf_lobby on the desk")
    assert session.folder
    text = why_text(why(Recorded(session.folder)))
    for line in (
        "from where: shelf_lobby  [person]",
        "to where: desk  [person]",
        "- where it is to go: there is no free spot on the desk",
        "- elsewhere: I put it on the sofa",
    ):
        assert line in text, text


@pytest.mark.physics
def test_in_physics_things_are_put_where_they_are_to_go_and_back(tmp_path: Path) -> None:
    settings = {"world": "physics", "camera_hz": 0.0, "place": {"apple": "refrigerator"}}
    session = session_of(tmp_path, ["I don't know"], **settings)
    truth = session.embodiment.truth
    assert truth
    for words, thing, place in (
        ("Bring the hammer from the lobby to the bedroom", "hammer", "desk"),
        ("Put the mug from the coffee table on the desk", "mug", "desk"),
        ("Put back the mug from the desk", "mug", "coffee_table"),
        ("Bring the apple from the refrigerator to the sofa", "apple", "sofa"),
    ):
        outcome = session.run(words)
        assert outcome.status == MissionStatus.DONE, outcome.reason
        assert truth.resting_place(thing) == place
        assert session.folder
        assert replay(session.folder).parting is None
    session.close()


@pytest.mark.parametrize("there", ["On the desk", "Now on the desk", "No, onto the desk"])
def test_a_place_after_it_was_put_elsewhere_is_where_it_is_to_go(serve: Serve, there: str) -> None:
    session, world = serve()
    session.run("Put the mug on the sofa")
    assert session.run(there).reason == "I put the mug on the desk."
    assert world.things["mug"] == "desk"


def test_what_is_on_one_place_goes_into_another(serve: Serve) -> None:
    session, world = serve()
    assert session.run("Put everything on the coffee table into the fridge").status == "done"
    assert {world.things["mug"], world.things["pudding_box"]} == {"refrigerator"}


@pytest.mark.parametrize(
    "less",
    [" instead of the desk", " rather than on the desk", ", not on the desk", ", not the desk"],
)
def test_a_goal_less_another_place_is_the_goal(less: str) -> None:
    run = run_mission(f"Put the mug on the sofa{less}", llm=False)
    assert run.outcome.reason == "I put the mug on the sofa."


@pytest.mark.parametrize(
    ("words", "meanwhile"),
    [
        ("Put the mug on the desk", "put it on the sofa, not the desk"),
        ("Put the mug on the desk", "put it on the sofa, not on the desk"),
        ("Put the hammer and the mug on the desk", "put them on the sofa, not the desk"),
        (
            "Put the hammer on the bed and the mug on the desk",
            "put the mug on the sofa, not the desk",
        ),
    ],
)
def test_what_is_to_go_elsewhere_does_not_go_where_it_is_not_meant(
    words: str, meanwhile: str
) -> None:
    run = put(words, during=saying_once(meanwhile))
    assert run.world.things["mug"] == "sofa"
    assert PutDown("desk") not in run.goals


def test_another_thing_that_is_to_go_elsewhere_is_one_more_task() -> None:
    meanwhile = saying_once("put the mug on the sofa, not on the desk")
    run = put("Put the hammer on the desk", during=meanwhile)
    assert (run.world.things["hammer"], run.world.things["mug"]) == ("desk", "sofa")


def test_what_only_one_of_several_leaves_out_is_asked_about() -> None:
    run = put("Bring the apple and the pear, but not the fruit", answers=[None])
    assert run.outcome.status == MissionStatus.NOT_DONE
    assert [task.kind for task in run.outcome.tasks] == [CommandKind.BRING, CommandKind.BRING]


@pytest.mark.parametrize(
    ("words", "things"),
    [
        ("Put everything but the apple on the desk", {"banana", "strawberry", "cracker_box"}),
        ("Put everything on the desk except the fruit", {"cracker_box"}),
    ],
)
def test_everything_is_what_was_just_told(serve: Serve, words: str, things: set[str]) -> None:
    session, world = serve()
    session.run("What is on the dining table?")
    before = {name for name, place in world.things.items() if place == "desk"}
    assert session.run(words).status == "done"
    assert {name for name, place in world.things.items() if place == "desk"} - before == things
