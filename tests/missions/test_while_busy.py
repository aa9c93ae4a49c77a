"""What is said while the robot is at something is answered at once, and the tree goes by it."""

import io
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest
from interrupting import Interrupting
from talking import session_in, told

from executive.app.parts import Parts
from executive.app.session import Session
from executive.config import load_settings
from executive.events import Heard, Inbox
from executive.replay.replaying import replay
from executive.testing.bench import Run, run_mission
from executive.types.goals import DriveTo, Goal, LookAt, Pick, PutDown
from executive.types.outcome import MissionStatus
from executive.user import Oracle
from kb.facts import FactStore
from logs.questions.decision import why_text
from logs.questions.why import why
from logs.recording.reader import Run as Recorded

DONE, NOT_DONE = MissionStatus.DONE, MissionStatus.NOT_DONE


def saying(words: str, at: int) -> Callable[[Goal, Inbox], None]:
    """Says it as the robot begins with this goal, counted from 1."""
    begun: list[Goal] = []

    def during(goal: Goal, inbox: Inbox) -> None:
        begun.append(goal)
        if len(begun) == at:
            inbox.hear(words)

    return during


def run(words: str, heard: str, at: int = 1) -> Run:
    facts = FactStore.believing({})
    return run_mission(words, llm=False, during=saying(heard, at), facts=facts)


def answers(mission: Run) -> list[str]:
    assert isinstance(mission.user, Oracle)
    return mission.user.told


def tasks(mission: Run) -> list[tuple[str, str | None, str]]:
    return [(task.kind, task.object, task.status) for task in mission.outcome.tasks]


@pytest.mark.parametrize("at", [1, 2, 3, 4])
def test_a_correction_takes_the_place_of_the_task_at_any_moment(at: int) -> None:
    mission = run("Bring the hammer", "No, the power drill", at)
    assert tasks(mission) == [("bring", "power_drill", DONE)]
    assert "All right: I bring the power drill instead." in answers(mission)
    assert mission.world.resting_place("power_drill") == "delivery"
    assert mission.world.resting_place("hammer") == "shelf_lobby"


def test_who_changed_their_mind_has_the_new_wish_done_and_no_other() -> None:
    mission = run("Bring the hammer", "I changed my mind, bring the mug")
    assert tasks(mission) == [("bring", "mug", DONE)]


@pytest.mark.parametrize("words", ["Forget the mug", "Never mind the mug", "Forget about the mug"])
def test_what_is_to_be_forgotten_is_not_done_and_the_rest_is(words: str) -> None:
    mission = run("Bring the hammer, then the mug", words)
    assert [(kind, status) for kind, _, status in tasks(mission)] == [
        ("bring", NOT_DONE),
        ("bring", DONE),
    ]
    assert mission.world.resting_place("hammer") == "delivery"
    assert mission.world.resting_place("mug") != "delivery"


@pytest.mark.parametrize(
    "words", ["Forget the rest", "Never mind the rest", "Skip everything else"]
)
@pytest.mark.parametrize(
    "asked", ["Bring the hammer, then the mug", "Bring the hammer and the mug"]
)
def test_who_has_the_rest_forgotten_still_wants_what_is_at_hand(asked: str, words: str) -> None:
    mission = run(asked, words)
    resting = {thing: mission.world.resting_place(thing) for thing in ("hammer", "mug")}
    assert sorted(status for _, _, status in tasks(mission)) == [DONE, NOT_DONE]
    assert [*resting.values()].count("delivery") == 1


def test_of_a_task_in_parts_the_rest_is_what_was_not_begun() -> None:
    mission = run("Bring all the fruit", "forget the rest")
    assert mission.outcome.status == NOT_DONE
    assert mission.outcome.reason.startswith("I brought one of six: ")


def test_where_nothing_waits_there_is_no_rest() -> None:
    mission = run("Bring the hammer", "forget the rest")
    assert "There is nothing else that I was to do." in answers(mission)
    assert tasks(mission) == [("bring", "hammer", DONE)]


def test_forgetting_what_nobody_knows_ends_all() -> None:
    mission = run("Bring the hammer, then the mug", "Forget the coffee")
    assert {status for _, _, status in tasks(mission)} == {NOT_DONE}
    assert mission.world.resting_place("hammer") == "shelf_lobby"


@pytest.mark.parametrize(
    ("words", "brought"),
    [
        ("only the mug", {"mug"}),
        ("just the hammer, please", {"hammer"}),
        ("no, just the mug", {"mug"}),
        ("only the pear", {"pear"}),
        ("forget all but the mug", {"mug"}),
        ("skip everything except the hammer", {"hammer"}),
        ("do not bring anything but the mug", {"mug"}),
        ("no, all but the mug", {"hammer"}),
        ("no, everything but the hammer", {"mug"}),
    ],
)
def test_only_this_is_nothing_else(words: str, brought: set[str]) -> None:
    mission = run("Bring the hammer, then the mug", words)
    things = ("hammer", "mug", "pear")
    assert {x for x in things if mission.world.resting_place(x) == "delivery"} == brought


@pytest.mark.parametrize("words", ["only the pear", "just the pear, please", "no, only the pear"])
@pytest.mark.parametrize("wanted", ["Bring two fruits", "Bring all the fruits"])
def test_only_this_of_several_is_not_all_of_them(wanted: str, words: str) -> None:
    mission = run(wanted, words)
    brought = [x for x, at in mission.world.things.items() if at == "delivery"]
    assert brought == ["pear"]


@pytest.mark.parametrize("again", ["Bring the mug", "bring me the mug, please", "And the mug"])
def test_what_is_asked_for_twice_is_done_once(again: str) -> None:
    mission = run("Bring the mug", again)
    assert "I drive to the coffee table, to bring the mug." in answers(mission)
    assert tasks(mission) == [("bring", "mug", DONE)]


def test_what_waits_and_is_asked_for_again_is_done_once() -> None:
    mission = run("Bring the hammer, then the mug", "bring the mug")
    assert tasks(mission) == [("bring", "hammer", DONE), ("bring", "mug", DONE)]


def test_what_was_put_back_meanwhile_is_brought_again() -> None:
    mission = run("Bring the mug, then put it back", "Bring the mug")
    assert [kind for kind, _, _ in tasks(mission)] == ["bring", "put_back", "bring"]
    assert mission.world.resting_place("mug") == "delivery"


@pytest.mark.parametrize(
    ("words", "left_out"),
    [
        ("forget the apple and the banana", {"apple", "banana"}),
        ("forget all the fruit but the pear and the orange", {"apple", "banana", "peach"}),
    ],
)
@pytest.mark.parametrize("at", [1, 6])
def test_some_of_all_are_forgotten_and_the_others_are_brought(
    words: str, left_out: set[str], at: int
) -> None:
    mission = run("Bring all the fruit", words, at)
    brought = {x for x, place in mission.world.things.items() if place == "delivery"}
    assert not left_out - {"apple"} & brought  # the apple was there by then, or in the hand
    assert {"orange", "pear"} <= brought


@pytest.mark.parametrize("words", ["leave the mug", "not the mug", "leave the mug there"])
@pytest.mark.parametrize("at", [1, 2, 3])
def test_what_is_to_be_left_is_not_cleared_away(words: str, at: int) -> None:
    during = saying(words, at)
    place = {"mug": "desk", "apple": "desk"}
    mission = run_mission("Clear the desk", llm=False, during=during, place=place)
    assert mission.world.resting_place("mug") == "desk"
    assert mission.world.resting_place("apple") != "desk"


def test_what_is_to_be_left_is_not_brought_afterwards_either() -> None:
    during = saying("not the mug", 1)
    place = {"mug": "desk", "apple": "desk"}
    mission = run_mission(
        "Clear the desk, then bring the mug", llm=False, during=during, place=place
    )
    assert mission.world.resting_place("mug") == "desk"
    assert mission.world.resting_place("apple") != "desk"


def test_of_all_but_one_the_others_are_brought() -> None:
    mission = run("Bring all the tools", "not the hammer")
    assert mission.world.resting_place("hammer") == "shelf_lobby"
    assert mission.world.resting_place("power_drill") == "delivery"


@pytest.mark.parametrize(
    "words", ["to the desk", "No, to the desk", "Put them on the desk instead"]
)
def test_another_place_is_that_of_all_that_was_asked_for_in_one_breath(words: str) -> None:
    mission = run("Bring the mug and the hammer", words)
    assert mission.world.resting_place("mug") == "desk"
    assert mission.world.resting_place("hammer") == "desk"


def test_another_place_is_not_that_of_what_has_one_of_its_own() -> None:
    mission = run("Put the mug on the sofa and the hammer on the bed", "no, to the desk")
    places = {mission.world.resting_place("mug"), mission.world.resting_place("hammer")}
    assert "desk" in places
    assert len(places) == 2


def test_both_are_those_of_one_breath() -> None:
    mission = run("Bring the mug and the hammer", "Put both on the desk")
    assert mission.world.resting_place("mug") == "desk"
    assert mission.world.resting_place("hammer") == "desk"


@pytest.mark.parametrize("words", ["not on the sofa", "anywhere but on the sofa"])
def test_where_it_is_not_to_go_is_asked_about(words: str) -> None:
    during = saying(words, 1)
    mission = run_mission("Put the hammer on the sofa", llm=False, during=during, answers=["desk"])
    assert mission.world.resting_place("hammer") == "desk"


@pytest.mark.parametrize("words", ["Forget both", "Forget them", "Do not bring them"])
def test_both_are_taken_back(words: str) -> None:
    mission = run("Bring the hammer, then the mug", words)
    assert {status for _, _, status in tasks(mission)} == {NOT_DONE}
    assert mission.world.resting_place("hammer") == "shelf_lobby"


def test_who_names_some_of_three_again_means_these() -> None:
    mission = run("Bring the hammer, the mug and the pear", "No, the mug and the pear")
    assert mission.world.resting_place("hammer") == "shelf_lobby"
    assert mission.world.resting_place("mug") == "delivery"
    assert mission.world.resting_place("pear") == "delivery"


@pytest.mark.parametrize("words", ["What if it is not there?", "It is not heavy"])
def test_what_is_told_or_asked_takes_nothing_back(words: str) -> None:
    assert tasks(run("Bring the hammer", words)) == [("bring", "hammer", DONE)]


def test_what_is_to_be_done_first_is_not_done_twice() -> None:
    mission = run("Bring the hammer, then the mug, then the pear", "Bring the pear first")
    assert [name for _, name, _ in tasks(mission)].count("pear") == 1


@pytest.mark.parametrize(
    ("words", "brought"),
    [
        ("If you can't find it, bring the mug", "hammer"),
        ("If it isn't on the shelf, bring the mug", "hammer"),
        ("If it isn't on the desk, bring the mug", "mug"),
    ],
)
def test_what_to_do_if_it_fails_is_no_further_wish(words: str, brought: str) -> None:
    mission = run("Bring the hammer", words)
    things = ("hammer", "mug")
    assert [x for x in things if mission.world.resting_place(x) == "delivery"] == [brought]


@pytest.mark.physics
def test_what_was_half_taken_in_physics_is_put_away_first(tmp_path: Path) -> None:
    inbox, clocks = Inbox(), []

    def change(parts: Parts) -> Parts:
        clocks.append(Interrupting(parts.clock, inbox, 24.1, Heard("No, the power drill")))
        return replace(parts, clock=clocks[0])

    settings = load_settings(
        world="physics", llm="none", user="none", camera_hz=0.0, detector="simulated", runs=tmp_path
    )
    with Session(settings, inbox=inbox, change=change, out=io.StringIO()) as session:
        outcome = session.run("Bring the hammer")
        held = session.world.resting_place("hammer") if session.world else None
    assert clocks[0].interrupted
    assert (outcome.status, outcome.object) == (DONE, "power_drill"), outcome.reason
    assert held is not None


def test_a_correction_counts_from_where_the_robot_is() -> None:
    mission = run("Find the hammer", "no, the power drill", at=2)
    drives = [goal for goal in mission.goals if isinstance(goal, DriveTo)]
    assert drives == [DriveTo("shelf_lobby"), DriveTo("shelf_lobby"), DriveTo("person")]


@pytest.mark.parametrize(
    ("words", "heard", "place"),
    [
        ("Put the hammer on the sofa", "No, on the desk", "desk"),
        ("Put the hammer on the sofa", "to the bed instead", "bed"),
        ("Put the hammer on the sofa", "no, bring it to me", "delivery"),
        ("Bring the hammer", "put it on the sofa instead", "sofa"),
        ("Bring the mug", "not the mug but the hammer", "delivery"),
        ("Bring the mug", "the hammer, not the mug", "delivery"),
    ],
)
def test_a_place_or_the_deed_may_be_corrected(words: str, heard: str, place: str) -> None:
    mission = run(words, heard)
    assert (mission.outcome.status, mission.world.resting_place("hammer")) == (DONE, place)


@pytest.mark.parametrize("heard", ["Bring the power drill", "And the power drill, too"])
def test_a_further_wish_is_done_afterwards_and_told_so(heard: str) -> None:
    mission = run("Bring the hammer", heard)
    assert tasks(mission) == [("bring", "hammer", DONE), ("bring", "power_drill", DONE)]
    assert "All right: I bring the power drill afterwards." in answers(mission)


@pytest.mark.parametrize(
    ("heard", "wish"),
    [
        ("Is the mug on the desk, too?", "check whether the mug is on the desk"),
        ("What is on the sofa?", "tell what is on the sofa"),
        ("Count the fruit in the kitchen", "count fruit in the kitchen"),
        ("Clear the desk", "clear the desk"),
        ("Find the mug in the bedroom", "find the mug in the bedroom"),
        ("Bring the mug later", "bring the mug"),
    ],
)
def test_what_is_to_be_done_afterwards_is_said_in_whole_sentences(heard: str, wish: str) -> None:
    assert f"All right: I {wish} afterwards." in answers(run("Bring the hammer", heard))


@pytest.mark.parametrize(
    ("heard", "answer"),
    [
        ("What are you doing?", "I drive to the shelf in the lobby, to bring the hammer."),
        ("What do you hold?", "My hand is empty."),
        ("Thank you", "You are welcome."),
        ("The mug is on the desk", "Thank you: I remember that the mug is on the desk."),
        ("Jump over it", "I cannot jump."),
        (
            "Do not touch the mug",
            "Then I will not. I do not keep that in mind: what you ask for later counts.",
        ),
        (
            "blue skies",
            "I do not understand 'blue skies'. "
            "I drive to the shelf in the lobby, to bring the hammer.",
        ),
    ],
)
def test_anything_else_is_answered_and_the_robot_goes_on(heard: str, answer: str) -> None:
    mission = run("Bring the hammer", heard)
    assert answer in answers(mission)
    assert tasks(mission) == [("bring", "hammer", DONE)]
    plain = run_mission("Bring the hammer", llm=False)
    assert list(map(type, mission.goals)) == list(map(type, plain.goals))


@pytest.mark.parametrize("heard", ["leave the pear alone", "Don't bring the pear", "not the pear"])
def test_a_task_that_waits_is_taken_back_before_it_begins(heard: str) -> None:
    mission = run("Bring the hammer, then bring the pear", heard)
    assert tasks(mission) == [("bring", None, NOT_DONE), ("bring", "hammer", DONE)]
    assert "Then I do not bring the pear." in answers(mission)
    assert mission.world.resting_place("pear") != "delivery"


def test_of_several_things_one_is_left_out_that_was_not_begun() -> None:
    mission = run("Bring all the fruit", "do not bring the pear")
    [whole] = mission.outcome.tasks
    assert {part.object or part.target for part in whole.parts if part.status != DONE} == {"pear"}


def test_a_class_is_asked_for_without_what_is_refused() -> None:
    mission = run("Bring the hammer, then bring a fruit", "don't bring the pear")
    assert [one for _, one, _ in tasks(mission)] != ["hammer", "pear"]


@pytest.mark.parametrize(
    ("heard", "status"),
    [
        ("don't bring anything", NOT_DONE),
        ("bring nothing", NOT_DONE),
        ("I need nothing else", DONE),
    ],
)
def test_nothing_at_all_is_nothing_of_all(heard: str, status: MissionStatus) -> None:
    mission = run("Bring the hammer, then bring the pear", heard)
    assert {ended for _, _, ended in tasks(mission)} == {status}


@pytest.mark.parametrize(
    "heard",
    [
        "don't bring the hammer, bring the power drill",
        "bring the power drill and don't touch the hammer",
        "leave the hammer alone and bring the power drill",
    ],
)
def test_what_is_to_be_left_alone_is_corrected(heard: str) -> None:
    mission = run("Bring the hammer", heard)
    assert tasks(mission) == [("bring", "power_drill", DONE)]
    assert mission.world.resting_place("hammer") == "shelf_lobby"


@pytest.mark.parametrize(
    "heard",
    [
        "take care not to bring the hammer",
        "nobody needs the hammer",
        "I told you not to bring it",
        "do_not_bring_the hammer",
        "bring the hammer nicht",
        "fetch the hammer? no!",
    ],
)
def test_a_negation_that_is_not_read_takes_back_what_it_names(heard: str) -> None:
    mission = run("Bring the hammer", heard)
    assert "Then I do not bring the hammer." in answers(mission)
    assert not any(isinstance(goal, Pick) for goal in mission.goals)


def test_a_negation_about_nothing_that_is_to_be_done_does_not_end_it_and_it_is_told_so() -> None:
    mission = run("Bring the hammer", "take care not to fall")
    assert any(text.startswith("I hear 'not', and do not") for text in answers(mission))
    assert tasks(mission) == [("bring", "hammer", DONE)]


@pytest.mark.parametrize("heard", ["Do not bring it", "don't bring the hammer"])
def test_what_is_taken_back_is_not_done(heard: str) -> None:
    mission = run("Bring the hammer", heard)
    assert tasks(mission) == [("bring", "hammer", NOT_DONE)]
    assert mission.outcome.reason == "you took it back"
    assert not any(isinstance(goal, Pick | PutDown) for goal in mission.goals)


@pytest.mark.parametrize(
    ("heard", "kinds", "told"),
    [
        ("No, the hammer", [("bring", "hammer", DONE)], "I bring the hammer instead."),
        ("Do not bring them", [("bring", None, NOT_DONE)], "Then I do not bring"),
    ],
)
def test_what_is_done_in_parts_is_corrected_as_a_whole(
    heard: str, kinds: list[tuple[str, str | None, str]], told: str
) -> None:
    mission = run("Bring two fruits", heard)
    assert [(kind, status) for kind, _, status in tasks(mission)] == [
        (kind, status) for kind, _, status in kinds
    ]
    assert any(told in answer for answer in answers(mission))
    assert mission.world.held is None


def test_the_others_are_done_if_one_is_taken_back() -> None:
    mission = run("Bring the hammer. Then find the power drill.", "Do not bring it")
    assert tasks(mission) == [("bring", "hammer", NOT_DONE), ("find", "power_drill", DONE)]


def test_where_the_thing_is_sends_the_robot_there(tmp_path: Path) -> None:
    session, world = session_in(tmp_path, place={"hammer": "sofa"})
    start, began = session.robot.start, []

    def start_and_say(goal: Goal) -> int:
        began.append(goal)
        if len(began) == 1:
            session.inbox.hear("It is on the sofa")
        return start(goal)

    session.robot.start = start_and_say  # type: ignore[method-assign]
    outcome = session.run("Bring the hammer")
    assert (outcome.status, outcome.visited) == (DONE, ("sofa",))
    assert "Thank you: I remember that the hammer is on the sofa." in told(session)
    session.close()
    assert session.folder
    assert replay(session.folder).parting is None


def test_why_tells_what_was_heard_and_what_was_given_up_for_it(tmp_path: Path) -> None:
    session, _ = session_in(tmp_path)
    start = session.robot.start

    def start_and_say(goal: Goal) -> int:
        if goal == LookAt("shelf_lobby"):
            session.inbox.hear("No, the scissors from the desk")
        return start(goal)

    session.robot.start = start_and_say  # type: ignore[method-assign]
    session.run("Bring the hammer")
    session.close()
    assert session.folder
    text = why_text(why(Recorded(session.folder)))
    heard = "heard 'No, the scissors from the desk': All right: I bring the scissors"
    assert heard in text, text
    assert "look at shelf_lobby: given up  [person]" in text, text
    assert "look at desk: seen there  [eyes]" in text, text


def test_what_comes_too_late_is_kept_for_the_next(tmp_path: Path) -> None:
    session, _ = session_in(tmp_path)
    tell = session.parts.user.tell

    def tell_and_hear(text: str) -> None:
        tell(text)
        if text.startswith("Here is"):
            session.inbox.hear("And the power drill")

    session.parts.user.tell = tell_and_hear  # type: ignore[method-assign]
    session.run("Bring the hammer")
    assert list(session.heard) == ["And the power drill"]
    session.close()


@pytest.mark.parametrize("words", ["Bring the hammer", "Bring the power drill and the hammer"])
def test_what_is_to_be_left_is_not_brought(words: str) -> None:
    mission = run(words, "No, leave the hammer")
    assert "Then I do not bring the hammer." in answers(mission)
    assert mission.world.resting_place("hammer") == "shelf_lobby"


def test_another_thing_to_be_put_beside_takes_the_place_of_the_first() -> None:
    mission = run("Put the pear next to the mug", "No, next to the hammer")
    assert "All right: I put the pear next to the hammer instead." in answers(mission)
    assert mission.world.resting_place("pear") == "shelf_lobby"


def test_how_many_it_is_to_be_instead_is_told() -> None:
    mission = run("Bring two fruits", "No, three fruits")
    assert "All right: I bring three fruits instead." in answers(mission)
    assert mission.outcome.reason.startswith("I brought all three: ")


@pytest.mark.parametrize("heard", ["to the kitchen", "No, to the kitchen"])
def test_another_place_for_what_is_brought_is_where_it_is_put(heard: str) -> None:
    mission = run("Bring the hammer", heard)
    assert tasks(mission) == [("put", "hammer", DONE)]
    assert mission.world.resting_place("hammer") == "cabinet_kitchen"


def test_what_is_to_go_to_the_person_instead_is_brought() -> None:
    mission = run("Put the hammer on the desk", "No, to me")
    assert tasks(mission) == [("bring", "hammer", DONE)]
    assert mission.world.resting_place("hammer") == "delivery"


@pytest.mark.parametrize(
    ("heard", "place"), [("on the sofa", "sofa"), ("it is on the sofa", "desk")]
)
def test_a_place_is_where_to_unless_it_is_said_that_it_is_there(heard: str, place: str) -> None:
    mission = run("Put the hammer on the desk", heard)
    assert mission.world.resting_place("hammer") == place


@pytest.mark.parametrize("heard", ["Make it one", "No, one"])
def test_one_instead_of_two_is_one_of_the_same_kind(heard: str) -> None:
    mission = run("Bring two tools", heard)
    assert [task for task in tasks(mission) if task[2] == DONE] == tasks(mission)
    assert len(tasks(mission)) == 1


def test_of_several_that_will_do_one_may_be_left_out() -> None:
    mission = run("Bring two fruits", "Not the apple")
    assert mission.outcome.status == DONE
    assert "All right: I bring two fruits but not the apple instead." in answers(mission)
    assert mission.world.resting_place("apple") == "dining_table"


@pytest.mark.parametrize(
    "heard",
    ["Bring the power drill instead of the hammer", "Bring the power drill, not the hammer"],
)
def test_what_is_wanted_instead_takes_the_place_of_the_task(heard: str) -> None:
    mission = run("Bring the hammer", heard)
    assert tasks(mission) == [("bring", "power_drill", DONE)]


def test_where_furniture_stands_is_answered_at_once() -> None:
    mission = run("Bring the hammer", "Where is the sofa?")
    assert "The sofa is in the living room." in answers(mission)
    assert tasks(mission) == [("bring", "hammer", DONE)]


@pytest.mark.parametrize("heard", ["Why?", "Why are you going there?", "Are you busy?"])
def test_who_asks_why_is_told_what_it_is_for(heard: str) -> None:
    mission = run("Bring the hammer", heard)
    assert any("to bring the hammer" in answer for answer in answers(mission))


def test_it_does_not_say_that_it_will_not_and_goes_on() -> None:
    mission = run("Bring the hammer", "Don't worry")
    assert not any("I will not" in answer for answer in answers(mission))


def test_a_deed_that_begins_with_and_is_done_next() -> None:
    mission = run("Find the mug", "And bring it to me")
    assert [task[:2] for task in tasks(mission)] == [("find", "mug"), ("bring", "mug")]


def test_what_waits_is_done_first_if_its_name_is_said_so() -> None:
    mission = run("Bring the hammer, then the apple, then the mug", "The mug first, please")
    assert [name for _, name, _ in tasks(mission)] == ["mug", "hammer", "apple"]


def test_what_is_done_already_is_not_begun_anew_if_it_is_to_be_first() -> None:
    mission = run("Bring the hammer, then the apple", "The hammer first")
    assert sum(isinstance(goal, DriveTo) for goal in mission.goals) == 4


@pytest.mark.parametrize("words", ["Bring the apple, the pear and the orange", "Bring the fruits"])
@pytest.mark.parametrize("heard", ["Only two", "just two of them, please"])
def test_of_several_only_so_many_are_brought(words: str, heard: str) -> None:
    mission = run(words, heard)
    assert len([at for at in mission.world.things.values() if at == "delivery"]) == 2


def test_of_those_that_are_brought_already_there_are_enough() -> None:
    mission = run("Bring all the fruit", "Only one", 8)
    assert (mission.outcome.status, mission.outcome.reason) == (
        DONE,
        "Here is the apple from the dining table.",
    )


@pytest.mark.parametrize(
    "words", ["Bring the apple, then the pear", "Bring the pear, then the apple"]
)
def test_another_place_is_for_all_but_what_is_not_meant(words: str) -> None:
    mission = run(words, "To the desk, but not the pear")
    assert mission.world.resting_place("apple") == "desk"
    assert mission.world.resting_place("pear") == "high_table"


def test_another_place_is_for_the_rest_of_a_kind() -> None:
    mission = run("Bring all the fruit", "To the sofa, but not the pear")
    assert mission.world.resting_place("pear") == "high_table"
    assert list(mission.world.things.values()).count("sofa") == 5


def test_what_is_told_of_a_place_takes_nothing_back() -> None:
    mission = run("Bring the hammer", "It isn't on the shelf")
    assert tasks(mission) == [("bring", "hammer", DONE)]


def test_what_is_meant_instead_is_not_lost() -> None:
    mission = run("Bring the hammer", "Not the hammer, I meant the wrench")
    assert tasks(mission) == [("bring", "adjustable_wrench", DONE)]


def test_what_is_named_beside_what_is_taken_back_is_told() -> None:
    mission = run("Bring the hammer", "Don't bring the hammer now but maybe the pear later")
    said = "Then I do not bring the hammer. What is to be done with the pear I do not understand."
    assert said in answers(mission)


def test_what_waits_may_be_to_go_elsewhere_and_the_rest_is_done_as_before() -> None:
    mission = run("Bring the apple and the pear", "No, the pear to the desk")
    assert mission.world.resting_place("apple") == "delivery"
    assert mission.world.resting_place("pear") == "desk"


def test_a_place_to_go_to_is_not_struck_out_by_other_things() -> None:
    mission = run("Bring the hammer, then go to the kitchen", "No, bring the apple and the pear")
    assert [task[0] for task in tasks(mission)] == ["bring", "bring", "go"]


def test_what_is_carried_is_put_down_at_once_if_that_is_said() -> None:
    mission = run("Bring the hammer", "Drop it", 4)
    assert tasks(mission) == [("put_down", "hammer", DONE)]


def brought(mission: Run) -> list[str]:
    """What is with the person now, in the order in which it was brought."""
    return [name for _, name, status in tasks(mission) if name and status == DONE]


@pytest.mark.parametrize(
    "words",
    [
        "first the mug",
        "First bring the mug",
        "but first bring the mug",
        "Before that, bring the mug",
    ],
)
def test_what_is_wanted_first_is_done_first(words: str) -> None:
    mission = run("Bring the hammer", words)
    assert brought(mission) == ["mug", "hammer"]
    assert "All right: I bring the mug first." in answers(mission)


@pytest.mark.parametrize(
    ("words", "left"),
    [
        ("forget the other two", ["mug"]),
        ("forget the others", ["mug"]),
        ("not the last one", ["mug", "pear"]),
        ("skip the first one", ["pear", "hammer"]),
        ("don't bring the second one", ["mug", "hammer"]),
        ("forget the other three", ["mug", "pear", "hammer"]),
    ],
)
def test_those_that_are_not_wanted_may_be_told_by_their_place(words: str, left: list[str]) -> None:
    mission = run("Bring the mug, then the pear, then the hammer", words)
    assert brought(mission) == left


def test_both_of_three_are_neither_two_of_them_nor_all() -> None:
    mission = run("Bring the mug, the pear and the hammer", "put both of them on the desk")
    assert sorted(brought(mission)) == ["hammer", "mug", "pear"]
    assert any("'both of them'" in said for said in answers(mission))


@pytest.mark.parametrize(
    "words",
    ["The hammer is not on the shelf", "my hammer isn't there", "The hammer was never there"],
)
def test_what_is_told_of_a_thing_takes_nothing_back(words: str) -> None:
    assert brought(run("Bring the hammer", words)) == ["hammer"]


def test_what_is_no_longer_needed_is_taken_back() -> None:
    assert brought(run("Bring the hammer", "The hammer is not needed")) == []


@pytest.mark.parametrize(
    "words", ["Don't bring it to me, put it on the sofa", "Don't bring it, take it to the sofa"]
)
def test_not_to_the_person_but_elsewhere(words: str) -> None:
    mission = run("Bring the hammer", words)
    assert mission.world.resting_place("hammer") == "sofa"
    assert tasks(mission) == [("put", "hammer", DONE)]


def test_what_is_wanted_instead_is_asked_for_if_it_is_not_clear() -> None:
    mission = run("Bring the hammer", "don't bring it, find it")
    assert brought(mission) == []
    assert any(said.endswith("Say once more what I am to do instead.") for said in answers(mission))


@pytest.mark.parametrize("words", ["on the sofa, not the desk", "to the sofa, not on the desk"])
def test_another_place_may_be_told_beside_the_wrong_one(words: str) -> None:
    mission = run("Put the hammer on the desk", words)
    assert mission.world.resting_place("hammer") == "sofa"


@pytest.mark.parametrize("words", ["I'd prefer the mug", "Actually, I'd rather have the mug"])
def test_what_is_preferred_is_done_instead(words: str) -> None:
    assert brought(run("Bring the hammer", words)) == ["mug"]


@pytest.mark.parametrize(
    "words", ["Have you found it yet?", "How long will it take?", "Where are you going?"]
)
def test_how_far_it_is_is_told(words: str) -> None:
    mission = run("Bring the hammer", words)
    assert "I drive to the shelf in the lobby, to bring the hammer." in answers(mission)


@pytest.mark.parametrize(
    "words", ["oh and the mug", "While you're at it, bring the mug", "Great! And also the mug"]
)
def test_something_more_may_be_wished_in_passing(words: str) -> None:
    assert brought(run("Bring the hammer", words)) == ["hammer", "mug"]


def test_what_is_left_on_a_place_that_is_cleared_is_told_as_it_is() -> None:
    mission = run("Clear the coffee table", "but leave the mug")
    assert mission.world.resting_place("mug") == "coffee_table"
    at = mission.world.resting_place("pudding_box")
    assert at != "coffee_table"
    assert "coffee table" not in mission.outcome.reason
    assert not any("do not understand" in said for said in answers(mission))


def test_what_is_left_and_what_is_brought_are_not_the_same() -> None:
    mission = run("Clear the coffee table", "but leave the mug and bring me the pear")
    assert mission.world.resting_place("mug") == "coffee_table"
    assert mission.world.resting_place("pear") == "delivery"


def test_where_two_things_are_may_be_told_at_once() -> None:
    mission = run("Bring the hammer", "The hammer is on the sofa and the mug is on the bed")
    told_so = [said for said in answers(mission) if said.startswith("Thank you")]
    assert len(told_so) == 1
    assert "the hammer is on the sofa" in told_so[0]
    assert "the mug is on the bed" in told_so[0]


def test_the_robot_turns_away_from_where_the_thing_is_said_not_to_be() -> None:
    facts, during = FactStore(), saying("The hammer is not on the shelf, it's on the sofa", 1)
    mission = run_mission("Bring the hammer", llm=False, during=during, facts=facts, search="plan")
    assert mission.outcome.visited[0] == "sofa"


@pytest.mark.parametrize("words", ["It is not on the coffee table", "it's not there"])
@pytest.mark.parametrize("asked", ["Find the mug", "Find the mug on the coffee table"])
def test_it_looks_everywhere_else_first_when_the_thing_is_not_where_it_goes(
    asked: str, words: str
) -> None:
    facts, during = FactStore(), saying(words, 1)
    mission = run_mission(asked, llm=False, during=during, facts=facts, search="plan")
    assert "Thank you: I remember that the mug is not on the coffee table." in answers(mission)
    assert mission.outcome.status == DONE
    assert mission.outcome.visited[0] != "coffee_table"
    assert len(mission.outcome.visited) > 1


def test_it_goes_on_where_the_thing_may_still_be() -> None:
    facts, during = FactStore(), saying("The mug is not on the bed", 1)
    mission = run_mission("Find the mug", llm=False, during=during, facts=facts, search="plan")
    drives = [goal for goal in mission.goals if isinstance(goal, DriveTo)]
    assert [goal.place for goal in drives] == ["coffee_table", "person"]


@pytest.mark.parametrize("just", ["just ", "only ", ""])
def test_not_this_but_that_takes_back_this_alone(just: str) -> None:
    mission = run("Bring the hammer and the mug", f"not the hammer, {just}the mug")
    assert brought(mission) == ["mug"]


def test_what_is_to_be_first_has_to_be_named() -> None:
    mission = run("Bring the mug, then the hammer", "first the last one")
    assert brought(mission) == ["mug", "hammer"]
    assert any(said.startswith("I do not understand") for said in answers(mission))


@pytest.mark.parametrize("words", ["No no, to the sofa", "No, no, to the sofa"])
def test_who_says_no_twice_means_it(words: str) -> None:
    assert run("Bring the hammer", words).world.resting_place("hammer") == "sofa"


def test_all_but_so_many_takes_nothing_back() -> None:
    mission = run("Bring all the tools", "all but two")
    assert mission.outcome.status == DONE
    assert any(said.startswith("I hear 'but'") for said in answers(mission))


def test_for_whom_one_more_is_to_be_is_not_lost() -> None:
    mission = run("Bring the hammer", "and one for Anna")
    assert "All right: I bring hammer for anna afterwards." in answers(mission)
