"""Tasks that were said in no order are done in the one that takes the fewest expected seconds."""

from executive.app.parts import Parts
from executive.testing.bench import Run, run_mission
from executive.types.goals import DriveTo
from executive.types.home import PERSON
from executive.types.outcome import MissionStatus
from kb.facts import FactStore


def things(run: Run) -> list[str | None]:
    return [task.object for task in run.outcome.tasks]


def seen(**places: str) -> FactStore:
    facts = FactStore()
    for name, place in places.items():
        facts.saw([name], place)
    return facts


def test_of_things_named_in_one_breath_the_nearest_comes_first() -> None:
    facts = seen(pear="shelf_lobby", apple="sofa")
    place = {"pear": "shelf_lobby", "apple": "sofa"}
    run = run_mission("Find the pear and the apple", llm=False, facts=facts, place=place)
    assert things(run) == ["apple", "pear"]


def test_an_order_that_was_said_is_kept() -> None:
    facts = seen(pear="shelf_lobby", apple="sofa")
    run = run_mission("Find the pear, then find the apple", llm=False, facts=facts)
    assert things(run) == ["pear", "apple"]


def test_how_near_a_thing_is_is_said_by_the_ways_of_the_robot() -> None:
    def behind_a_locked_door(parts: Parts) -> Parts:
        crow = parts.robot.seconds
        parts.robot.seconds = (  # type: ignore[method-assign]
            lambda start, place: crow(start, place) + 60 * ("sofa" in (start, place))
        )
        return parts

    place = {"pear": "shelf_lobby", "apple": "sofa"}
    run = run_mission(
        "Find the pear and the apple",
        llm=False,
        facts=seen(**place),
        place=place,
        change=behind_a_locked_door,
    )
    assert things(run) == ["pear", "apple"]


def test_what_is_surely_near_comes_before_what_may_be_anywhere() -> None:
    known = seen(mug="coffee_table")
    run = run_mission("Find the tennis ball and the mug", llm=False, defaults=False, facts=known)
    assert things(run) == ["mug", "tennis_ball"]
    known = seen(tennis_ball="bed")
    run = run_mission("Find the tennis ball and the mug", llm=False, defaults=False, facts=known)
    assert things(run) == ["tennis_ball", "mug"]


def test_as_many_as_are_enough_are_those_that_take_least() -> None:
    place = {"apple": "shelf_lobby", "banana": "sofa", "pear": "coffee_table"}
    run = run_mission("Bring two fruits", llm=False, facts=seen(**place), place=place)
    brought = {part.object for part in run.outcome.tasks[0].parts}
    assert brought == {"banana", "pear"}


def test_what_is_in_the_hand_already_is_put_away_first() -> None:
    words = "Take the pear. Then put the apple and the pear on the sofa."
    run = run_mission(words, llm=False, facts=seen(pear="high_table", apple="dining_table"))
    assert things(run) == ["pear", "pear", "apple"]
    assert run.outcome.tasks[1].status == MissionStatus.DONE


def test_where_it_looks_around_it_goes_by_the_ways_too() -> None:
    def far(parts: Parts) -> Parts:
        crow = parts.robot.seconds
        parts.robot.seconds = (  # type: ignore[method-assign]
            lambda start, place: crow(start, place) + 60 * (place == "counter_wagon")
        )
        return parts

    run = run_mission("How many tools are in the kitchen?", llm=False, change=far)
    assert run.outcome.visited[-1] == "counter_wagon"
    assert set(run.outcome.visited) > {"high_table"}


def test_what_was_found_is_told_on_the_way_if_there_is_more_to_do() -> None:
    run = run_mission("Find the mug and the pear. What is on the desk?", llm=False)
    returns = [goal for goal in run.goals if goal == DriveTo(PERSON)]
    assert len(returns) == 1
    assert run.goals[-1] == DriveTo(PERSON)


def test_if_enough_were_found_the_robot_comes_back() -> None:
    run = run_mission("Find two fruits", llm=False)
    assert run.goals[-1] == DriveTo(PERSON)
    assert run.outcome.status == MissionStatus.DONE
