"""Several things in one task, one of several, deeds on a condition, and all that is somewhere."""

from fnmatch import fnmatch
from pathlib import Path

import pytest
from replays import recorded

from executive.campaign.truth import completed
from executive.events import Inbox, StopRequested
from executive.replay.replaying import replay
from executive.testing.bench import Run, run_mission
from executive.types.goals import DriveTo, Goal, Pick, PutDown
from executive.types.outcome import MissionStatus
from executive.user import Oracle, Scripted
from kb.facts import FactStore
from logs.recording.reader import Run as Recorded

DONE, NOT_DONE = MissionStatus.DONE, MissionStatus.NOT_DONE
GONE = ("moved=strawberry:bed@5",)


def run(words: str, **more: object) -> Run:
    return run_mission(words, llm=False, facts=FactStore(), **more)  # type: ignore[arg-type]


def on(run: Run, place: str) -> set[str]:
    return {name for name, at in run.world.things.items() if at == place}


def truly_done(run: Run) -> bool:
    return completed(run.outcome, lambda name: run.world.resting_place(name) or "")


def test_as_many_as_were_asked_for_are_brought() -> None:
    two = run("Bring two fruits")
    assert two.outcome.reason == "I brought both: the apple and the banana."
    assert (two.outcome.status, on(two, "delivery")) == (DONE, {"apple", "banana"})
    assert truly_done(two)


def test_fewer_than_were_asked_for_are_told_and_are_not_done() -> None:
    two = run("Bring two apples")
    assert (two.outcome.status, on(two, "delivery")) == (NOT_DONE, {"apple"})
    assert two.outcome.reason == "I brought one of two: the apple; I know of no more."


def test_one_that_fails_is_made_up_for_by_another_of_its_kind() -> None:
    def stuck(goal: Goal) -> str | None:
        return "it is locked" if goal == DriveTo("dining_table") else None

    two = run("Bring two fruits", fault=stuck)
    assert two.outcome.status == DONE
    assert len(on(two, "delivery")) == 2


def test_all_of_a_kind_are_brought_but_for_those_that_are_left_out() -> None:
    all_ = run("Bring all the fruit but the pear")
    assert on(all_, "delivery") == {"apple", "banana", "orange", "peach", "strawberry"}
    assert (all_.outcome.status, len(all_.outcome.tasks), len(all_.outcome.tasks[0].parts)) == (
        DONE,
        1,
        5,
    )


def test_all_that_is_seen_at_a_place_is_meant_if_one_is_named() -> None:
    here = run("Put everything from the coffee table on the sofa")
    assert (on(here, "sofa"), on(here, "coffee_table")) == ({"mug", "pudding_box"}, set())


@pytest.mark.parametrize(
    "words",
    [
        "Put everything on the coffee table on the sofa",
        "Put everything that is on the coffee table on the sofa",
    ],
)
def test_of_two_places_of_everything_the_first_is_where_it_is(words: str) -> None:
    here = run(words)
    assert (on(here, "sofa"), on(here, "coffee_table")) == ({"mug", "pudding_box"}, set())


def asked(run: Run) -> list[str]:
    assert isinstance(run.user, Scripted)
    return [question.text for question in run.user.asked]


@pytest.mark.parametrize(
    ("words", "number"),
    [
        ("Bring everything", 22),
        ("Bring all things but the apple", 21),
        ("Put everything on the sofa", 22),
        ("Put everything back", 22),
    ],
)
def test_whether_all_that_there_is_is_meant_is_asked(words: str, number: int) -> None:
    refused = run(words, answers=["no"])
    assert asked(refused) == [f"Do you mean all {number} things that I know, wherever they are?"]
    assert (refused.outcome.status, refused.goals) == (NOT_DONE, [])


@pytest.mark.parametrize("answer", ["the mug and the pear", "no, only the mug and the pear"])
def test_instead_of_all_that_there_is_some_may_be_named(answer: str) -> None:
    some = run("Bring everything", answers=[answer], search="plan")
    assert (some.outcome.status, on(some, "delivery")) == (DONE, {"mug", "pear"})


@pytest.mark.parametrize("answer", ["yes", "all of them"])
def test_all_that_there_is_is_brought_if_it_is_meant(answer: str) -> None:
    all_ = run("Bring everything", answers=[answer], search="plan")
    assert (all_.outcome.status, len(on(all_, "delivery"))) == (DONE, 22)


def test_where_several_things_are_to_go_is_asked_once() -> None:
    fruits = run("Put the fruits", answers=["on the sofa"], search="plan")
    assert asked(fruits) == ["Where shall I put them?"]
    assert (fruits.outcome.status, len(on(fruits, "sofa"))) == (DONE, 6)


def test_what_is_to_be_cleared_has_a_place_or_a_name() -> None:
    cleared = run("Clear everything", answers=[])
    assert (asked(cleared), cleared.goals) == ([], [])
    assert "only at a place" in cleared.outcome.reason


def test_all_of_those_that_were_offered_may_be_meant_after_a_no() -> None:
    all_ = run("Bring a fruit", answers=["no, all of them"], search="plan")
    assert (all_.outcome.status, len(on(all_, "delivery"))) == (DONE, 6)


@pytest.mark.parametrize("words", ["Bring either the mug or the pear", "Bring the pear or the mug"])
def test_of_two_things_of_which_one_is_enough_the_nearest_is_brought(words: str) -> None:
    one = run(words)
    assert (one.outcome.status, on(one, "delivery")) == (DONE, {"mug"})


def test_if_one_of_two_things_fails_the_other_is_brought() -> None:
    one = run("Bring the unicorn or the mug")
    assert (one.outcome.status, on(one, "delivery")) == (DONE, {"mug"})


@pytest.mark.parametrize("words", ["Take two fruits", "Take the apple and the pear"])
def test_one_hand_takes_one_thing(words: str) -> None:
    two = run(words)
    assert two.outcome.status == NOT_DONE
    assert two.outcome.reason == "I took one of two: the apple; I can hold one thing at a time."


@pytest.mark.parametrize(
    ("words", "brought"),
    [
        ("Bring the mug from the coffee table if there is one, otherwise the pear", "mug"),
        ("Bring the mug from the desk if there is one, otherwise the pear", "pear"),
        ("Bring a unicorn if there is one, otherwise the pear", "pear"),
        ("If there is a fruit on the dining table, bring it, otherwise bring the mug", "apple"),
        ("If there is a tool on the dining table, bring it, otherwise bring the mug", "mug"),
        ("If the mug is on the coffee table, bring the pear", "pear"),
    ],
)
def test_on_a_condition_it_is_this_or_that(words: str, brought: str) -> None:
    either = run(words)
    assert (either.outcome.status, on(either, "delivery")) == (DONE, {brought})


def test_if_there_is_none_and_nothing_else_is_asked_for_nothing_is_done() -> None:
    none = run("If there is a tool on the dining table, bring it")
    assert none.outcome.status == DONE
    assert none.outcome.reason == "No, I see no tool on the dining table."
    assert none.world.things == none.world.home.placement


def test_any_that_is_there_will_do_for_one_of_a_kind_at_a_place() -> None:
    one = run("Bring a fruit from the dining table")
    assert (one.outcome.object, one.outcome.inquiries) == ("apple", 0)


def test_of_several_that_are_there_a_certain_one_is_asked_for() -> None:
    one = run("Bring the fruit from the dining table", answers=["the banana"])
    assert on(one, "delivery") == {"banana"}
    [asked] = one.user.asked  # type: ignore[attr-defined]
    assert asked.options == ("apple", "banana", "strawberry")


def test_of_everything_that_is_put_back_it_is_what_the_robot_took() -> None:
    back = run("Put the hammer on the desk. Put the pear on the sofa. Then put everything back.")
    assert back.world.things == back.world.home.placement
    assert back.outcome.tasks[-1].reason == (
        "I put back both: the pear on the high table and the hammer on the shelf in the lobby."
    )


def test_what_was_there_already_is_not_said_to_be_moved() -> None:
    put = run(
        "Put the tools on the sofa. Then put all the tools on the sofa.",
        place={"hammer": "sofa"},
        search="plan",
    )
    first, second = put.outcome.tasks
    assert fnmatch(first.reason, "I put two of three on the sofa: *; the hammer was there already.")
    assert fnmatch(second.reason, "The *, the * and the * were there already.")


def test_what_is_cleared_away_goes_to_nothing_that_is_cleared() -> None:
    places = {"apple": "counter_wagon", "mug": "high_table"}
    clear = run("Clear the kitchen", place=places)
    kitchen = {p.name for p in clear.world.home.furniture if p.room == "kitchen"}
    assert set(places.values()) <= kitchen
    assert clear.outcome.status == DONE
    assert not any(clear.world.things[name] in kitchen for name in places)


def test_which_of_several_tables_is_to_be_cleared_is_asked() -> None:
    one = run("Clear the table", answers=["the second one"])
    [asked] = one.user.asked  # type: ignore[attr-defined]
    assert asked.options == ("high_table", "dining_table", "coffee_table")
    assert set(one.outcome.visited) == {"dining_table"}
    none = run("Clear the table", answers=["I don't know"])
    assert (none.outcome.status, none.outcome.visited) == (NOT_DONE, ())
    both = run("Clear the table", answers=["the high table or the coffee table"])
    assert (both.outcome.inquiries, on(both, "coffee_table") | on(both, "high_table")) == (1, set())


@pytest.mark.parametrize("words", ["Clear all the tables", "Clear the kitchen"])
def test_of_a_room_or_of_all_tables_it_is_not_asked(words: str) -> None:
    assert len(run(words, answers=["on the desk"] * 9).outcome.visited) > 1


def test_which_is_the_largest_is_not_said_of_things_that_look_alike() -> None:
    alike = run("What is the largest object on the dining table?")
    assert alike.outcome.status == NOT_DONE
    assert alike.outcome.reason.endswith("I cannot tell by looking which is the largest")


def test_of_what_was_not_done_each_is_named_with_its_reason() -> None:
    def misses(goal: Goal) -> str | None:
        held = isinstance(goal, Pick) and goal.detection.label == "apple"
        return "my hand slipped" if held else None

    def no_room(goal: Goal) -> str | None:
        return "there is no room" if isinstance(goal, PutDown) and goal.place == "desk" else None

    one = run("Put all the fruit from the dining table on the sofa", fault=misses)
    assert one.outcome.reason == (
        "I put two of three on the sofa: the banana and the strawberry; "
        "not the apple: my hand slipped."
    )
    none = run("Clear the coffee table to the desk", fault=no_room, answers=["I don't know"] * 2)
    assert none.outcome.reason == (
        "I cleared away none of two on the desk; "
        "not the mug: I could not put it on the desk: there is no room, and you could not tell me; "
        "not the pudding box: I could not put it on the desk: there is no room, "
        "and you could not tell me; "
        "I still hold the pudding box."
    )


def test_what_had_no_room_on_the_delivery_table_is_told_with_where_it_is() -> None:
    left = iter([None])

    def full(goal: Goal) -> str | None:
        at_the_person = isinstance(goal, PutDown) and goal.place == "delivery"
        return next(left, "there is no room") if at_the_person else None

    two = run("Bring the two fruits from the high table", fault=full)
    assert two.outcome.status == NOT_DONE
    assert two.outcome.reason == (
        "I brought one of two: the peach; not the pear: I put the pear on the coffee table; "
        "I could not put it on the delivery table: there is no room."
    )


@pytest.mark.parametrize("words", ["Bring all the fruit from the kitchen", "Clear the kitchen"])
def test_it_is_not_all_if_not_all_was_seen(words: str) -> None:
    def blocked(goal: Goal) -> str | None:
        return "the way is blocked" if goal == DriveTo("high_table") else None

    some = run(words, fault=blocked)
    assert some.outcome.status == NOT_DONE
    assert "; I could not get to the high table: the way is blocked" in some.outcome.reason


@pytest.mark.parametrize("search", ["plan", "paper"])
@pytest.mark.parametrize("words", ["Bring all the fruit from the dining table", "Clear the table"])
def test_what_is_taken_away_from_there_meanwhile_is_not_looked_for_elsewhere(
    words: str, search: str
) -> None:
    some = run(words.replace("the table", "the dining table"), search=search, mishaps=GONE)
    assert (some.outcome.status, set(some.outcome.visited)) == (NOT_DONE, {"dining_table"})
    assert "not the strawberry: I did not find the strawberry on the" in some.outcome.reason
    assert on(some, "bed") == {"strawberry"}


def test_another_one_that_is_there_makes_up_for_it() -> None:
    two = run("Bring two fruits from the dining table", mishaps=("moved=banana:bed@5",))
    assert (two.outcome.status, on(two, "delivery")) == (DONE, {"apple", "strawberry"})


def test_where_all_of_them_are_to_go_is_asked_once_and_before_anything_is_done() -> None:
    words = "Take all the fruit from the dining table to the moon"
    asked = run(words, answers=["I don't know"])
    assert (asked.outcome.status, asked.outcome.inquiries, asked.goals) == (NOT_DONE, 1, [])
    told = run(words, answers=["on the sofa"])
    assert (told.outcome.status, told.outcome.inquiries) == (DONE, 1)
    assert on(told, "sofa") == {"apple", "banana", "strawberry"}


def test_furniture_is_cleared_of_all_that_is_seen_on_it() -> None:
    table = run("Clear the coffee table")
    assert (table.outcome.status, on(table, "coffee_table")) == (DONE, set())
    assert table.outcome.reason == (
        "I cleared away both: the mug and the pudding box on the dining table."
    )
    assert truly_done(table)


def test_as_many_are_cleared_away_as_were_asked_for() -> None:
    two = run("Clear two fruits from the dining table")
    assert (two.outcome.status, on(two, "dining_table")) == (DONE, {"strawberry", "cracker_box"})
    three = run("Clear three things from the coffee table")
    assert three.outcome.status == NOT_DONE
    assert three.outcome.reason.endswith("on the dining table; I know of no more.")


def test_of_what_is_cleared_it_is_told_where_it_is_now_though_something_is_left() -> None:
    table = run("Clear the dining table, but leave the banana")
    assert table.outcome.reason == (
        "I cleared away all three: the apple and the strawberry on the high table "
        "and the cracker box in the cabinet in the kitchen."
    )
    assert table.outcome.visited == ("dining_table",) * 3


def test_what_belongs_nowhere_else_goes_to_one_place_that_is_told() -> None:
    shelf = run("Clear the shelf in the lobby")
    assert {"hammer", "power_drill", "tennis_ball"} <= on(shelf, "sideboard")
    assert shelf.outcome.inquiries == 0
    assert isinstance(shelf.user, Oracle)
    [told] = [said for said in shelf.user.told if said.startswith("I know no other place")]
    assert told.endswith(" belong; I put them on the sideboard.")


@pytest.mark.parametrize("words", ["Clear the table in the living room", "Clear the dining table"])
def test_a_table_is_a_place_to_be_cleared_wherever_it_is(words: str) -> None:
    table = run(words, answers=["the dining table"])
    assert (table.outcome.status, on(table, "dining_table")) == (DONE, set())


def test_things_that_are_to_be_cleared_go_where_they_belong() -> None:
    tools = run("Clear the tools", place={"hammer": "desk", "power_drill": "sofa"})
    assert {"hammer", "power_drill"} <= on(tools, "shelf_lobby")


def test_of_a_table_only_what_is_named_is_cleared() -> None:
    fruits = run("Clear the fruits from the coffee table", place={"apple": "coffee_table"})
    assert on(fruits, "coffee_table") == {"mug", "pudding_box"}


def test_after_a_stop_the_whole_is_told_with_what_was_done_of_it() -> None:
    def stop(goal: Goal, inbox: Inbox) -> None:
        if goal == DriveTo("shelf_lobby"):
            inbox.post(StopRequested("the person"))

    tools = run("Bring all the tools and the mug", during=stop)
    stopped = MissionStatus.STOPPED
    [mug, whole] = tools.outcome.tasks
    assert (mug.status, whole.status, whole.target) == (DONE, stopped, "tools")
    ends = [(part.target, part.status) for part in whole.parts]
    assert ends[0] == ("adjustable_wrench", DONE)
    assert sorted(ends[1:]) == [("hammer", stopped), ("power_drill", stopped)]
    assert whole.visited == ("sideboard",)


def test_a_recording_has_the_parts_and_replays(tmp_path: Path) -> None:
    folder = recorded(tmp_path, "Bring two fruits and find the mug", llm=False)
    outcome = Recorded(folder).outcome()
    assert outcome
    assert [len(task.parts) for task in outcome.tasks] == [2, 0]
    assert replay(folder).parting is None


def test_a_question_of_where_the_fruits_are_tells_of_all() -> None:
    fruits = run("Where are the fruits?")
    assert fruits.outcome.status == DONE
    assert fruits.outcome.reason.startswith("I found all six: the apple, the banana and ")


def test_a_name_in_the_plural_is_one_thing() -> None:
    scissors = run("Where are the scissors?")
    assert scissors.outcome.reason == "The scissors are on the desk in the bedroom."


@pytest.mark.parametrize(
    ("words", "brought"),
    [
        ("Is there an apple on the dining table? If so, bring it", {"apple"}),
        ("Is the apple on the desk? If so, bring it, otherwise bring a pear", {"pear"}),
        ("Is the mug on the desk? If not, bring the pear", {"pear"}),
        ("Is the apple on the dining table? If not, bring the pear", set()),
        ("Is the mug there? If so, bring it", {"mug"}),
    ],
)
def test_what_is_asked_decides_what_is_done(words: str, brought: set[str]) -> None:
    asked = run(words)
    assert (asked.outcome.status, on(asked, "delivery")) == (DONE, brought)


def test_the_fruits_from_a_table_are_all_that_are_there() -> None:
    fruits = run("Put the fruits from the dining table on the desk")
    assert on(fruits, "desk") >= {"apple", "banana", "strawberry"}


def test_one_of_the_fruits_from_a_table_is_any_that_is_there() -> None:
    one = run("Bring me one of the fruits from the dining table")
    assert (one.outcome.status, on(one, "delivery")) == (DONE, {"apple"})


def test_where_the_robot_saw_a_thing_nobody_has_said_it_is() -> None:
    table = run("Clear the coffee table")
    assert isinstance(table.user, Oracle)
    assert "I look for the mug on the coffee table: I remember it there." in table.user.told
    assert not any("as you said" in said for said in table.user.told)


@pytest.mark.parametrize(("place", "put"), [("dining table", True), ("desk", False)])
def test_a_condition_holds_for_what_is_to_be_put_beside_something(place: str, put: bool) -> None:
    apple = run(f"If the apple is on the {place}, put it next to the mug")
    assert ("apple" in on(apple, "coffee_table")) is put


def test_what_was_just_seen_is_what_is_brought_of_a_kind() -> None:
    places = {"apple": "bed", "pear": "bed", "hammer": "bed"}
    both = run("What is on the bed? Bring the fruits", place=places)
    assert (both.outcome.status, on(both, "delivery")) == (DONE, {"apple", "pear"})


def test_a_kind_of_which_nothing_was_just_seen_is_looked_for() -> None:
    scissors = run("What is on the bed? Bring the scissors", place={"mug": "bed"})
    assert on(scissors, "delivery") == {"scissors"}


@pytest.mark.parametrize("search", ["plan", "paper"])
def test_what_else_is_to_be_done_if_it_is_not_found_is_done_only_then(search: str) -> None:
    words = "Bring the mug. If you cannot find it, bring the pear"
    found = run(words, search=search)
    assert (found.outcome.status, on(found, "delivery")) == (DONE, {"mug"})
    answers = ["I don't know", "on the high table"]
    shut = {DriveTo("coffee_table"): "the way is blocked"}
    other = run(words, search=search, answers=answers, fault=shut.get)
    assert (other.outcome.status, on(other, "delivery")) == (DONE, {"pear"})


def test_what_has_no_name_but_a_colour_is_asked_about_in_plain_words() -> None:
    red = run("Bring me something red", answers=[])
    assert asked(red)[0].startswith("Which do you mean: the apple, the strawberry,")
