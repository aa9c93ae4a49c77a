from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from executive import Session, load_settings
from executive.app.parts import Parts
from executive.belief import Statement
from executive.records import Planned, Recalled
from executive.replay import replay
from executive.testing.bench import run_mission
from kb.__main__ import main
from kb.experience import Experience
from kb.facts import Fact, FactKind, FactStore

HOUR_S, DAY_S = 3600.0, 86400.0
SEEN, MISSED, SAID, DENIED, TAKEN, PUT, LOOKED = FactKind
CLASSES = {"mug": "kitchenware", "spatula": "kitchenware", "hammer": "tool"}


Told = tuple[FactKind, str, str, float]
"""What, of which thing, at which place, at which hour."""


def learned(facts: Iterable[Told], now_h: float) -> Experience:
    store = FactStore()
    store.load(Fact(kind, thing, place, hour * HOUR_S) for kind, thing, place, hour in facts)
    experience = Experience(store, lambda name: CLASSES.get(name, ""), lambda: now_h * HOUR_S)
    experience.learn()
    return experience


def shares(experience: Experience, thing: str) -> dict[str, float]:
    return {one.place: one.probability for one in experience.belief(thing).places}


def said_by(experience: Experience, thing: str) -> dict[str, Statement]:
    return {said.source: said for said in experience.recalled(thing)}


MORNINGS = [
    fact
    for day in range(14)
    for fact in (
        (SEEN, "mug", "table", day * 24 + 7.5),
        (SEEN, "hammer", "shelf", day * 24 + 7.6),
        (SEEN, "mug", "wagon", day * 24 + 11),
    )
]
"""The mug is on the table for breakfast and on the wagon at eleven; the hammer stays."""


def test_nothing_is_known_of_what_was_never_seen() -> None:
    assert learned([], 0).recalled("mug") == ()


def test_what_was_just_seen_is_there() -> None:
    assert said_by(learned([(SEEN, "mug", "desk", 9)], 9), "mug")["memory"].trust == 0.98


def test_a_sighting_fades() -> None:
    facts = [(SEEN, "mug", "desk", 9.0)]
    worth = [said_by(learned(facts, now_h), "mug")["memory"].trust for now_h in (9, 33, 105)]
    assert worth[0] > worth[1] > worth[2]


def test_it_fades_faster_for_what_is_moved_more_often() -> None:
    experience = learned(MORNINGS, 14 * 24 + 7.6)
    trust = {name: said_by(experience, name)["memory"].trust for name in ("mug", "hammer")}
    assert trust["mug"] < 0.5
    assert trust["hammer"] > 0.9


def test_what_is_seldom_seen_fades_as_its_class_does() -> None:
    few = [(SEEN, "spatula", "rack", 13 * 24 + 11.0), (SEEN, "wrench", "rack", 13 * 24 + 11.0)]
    experience = learned([*MORNINGS, *few], 14 * 24 + 11)
    trust = {name: said_by(experience, name)["memory"].trust for name in ("spatula", "wrench")}
    assert trust["spatula"] < trust["wrench"]


def test_habits_say_where_it_was_taken_at_that_hour() -> None:
    today = [(SEEN, "mug", "table", 14 * 24 + 7.5)]
    at_breakfast = shares(learned([*MORNINGS, *today], 14 * 24 + 7.7), "mug")
    at_eleven = learned([*MORNINGS, *today], 14 * 24 + 11)
    assert at_breakfast["table"] > 0.8
    assert shares(at_eleven, "mug")["wagon"] > 0.5 > shares(at_eleven, "mug")["table"]
    assert said_by(at_eleven, "mug")["habits"].trust > 0.5


def test_what_is_taken_away_and_brought_back_is_learned_from_the_few_times_it_was_seen() -> None:
    facts = [
        fact
        for day in range(21)
        for fact in (
            (SEEN, "mug", "shelf", day * 24 + 8.0),
            *([(SEEN, "mug", "sofa", day * 24 + 16.0)] if day % 5 == 0 else []),
            (SEEN, "mug", "shelf", day * 24 + 20.0),
        )
    ]
    evening = learned(facts, now_h=20 * 24 + 21)
    next_day = learned([*facts, (SEEN, "mug", "shelf", 21 * 24 + 8.0)], now_h=21 * 24 + 16)
    assert shares(evening, "mug")["shelf"] > 0.8
    assert shares(next_day, "mug")["sofa"] > 0.6


def test_where_it_was_not_while_nobody_saw_it_tells_when_it_was_taken() -> None:
    facts = [
        fact
        for day in range(21)
        for fact in (
            (SEEN, "mug", "shelf", day * 24 + 8.0),
            (MISSED, "mug", "shelf", day * 24 + 10.0),
            (SEEN, "mug", "sofa", day * 24 + 20.0),
            (SEEN, "mug", "shelf", day * 24 + 23.9),
        )
    ]
    rate = learned(facts, now_h=21 * 24).rates().of("mug", "shelf")
    assert rate[8:10].sum() > 10 * rate[10:20].sum()


WORKING_DAYS = [
    fact
    for day in range(28)
    for fact in (
        (SEEN, "scissors", "shelf", day * 24 + 8.0),
        (SEEN, "scissors", "shelf" if day % 7 in (2, 3) else "desk", day * 24 + 12.0),
        (SEEN, "scissors", "shelf", day * 24 + 20.0),
    )
]
"""The scissors are on the desk at noon, but not on Saturdays and Sundays; day 0 was a Thursday."""


@pytest.mark.parametrize(("day", "place"), [(28, "desk"), (29, "desk"), (30, "shelf")])
def test_the_weekend_is_learned_apart(day: int, place: str) -> None:
    today = (SEEN, "scissors", "shelf", day * 24 + 8.0)
    assert shares(learned([*WORKING_DAYS, today], day * 24 + 12.5), "scissors")[place] > 0.7


def test_what_is_taken_to_a_place_daily_is_taken_there_from_a_new_one_too() -> None:
    today = (PUT, "scissors", "delivery", 28 * 24 + 8.0)
    assert shares(learned([*WORKING_DAYS, today], 28 * 24 + 12.5), "scissors")["desk"] > 0.5


def test_a_thing_that_was_at_very_many_places_is_followed_all_the_same() -> None:
    facts = [(SEEN, "mug", f"place {hour % 40}", float(hour)) for hour in range(200)]
    said = said_by(learned(facts, now_h=201), "mug")
    assert said["memory"].weights == (("place 39", 1.0),)


def test_a_look_for_something_else_tells_that_it_is_gone() -> None:
    seen = (SEEN, "mug", "desk", 9.0)
    looks = [(SEEN, "hammer", "desk", 10.0), (MISSED, "spatula", "desk", 10.0)]
    assert shares(learned([seen, looks[0]], 10.1), "mug")["desk"] > 0.9
    assert shares(learned([seen, *looks], 10.1), "mug")["desk"] < 0.7


def doubts_the_mug_alone(facts: list[Told], told: Told) -> bool:
    """Whether mug and hammer were surely on the desk, and with what is told only the hammer is."""
    before, after = learned(facts, 10.1), learned([*facts, told], 10.1)
    mug, hammer = shares(after, "mug")["desk"], shares(after, "hammer")["desk"]
    return shares(before, "mug")["desk"] > 0.9 and mug < 0.7 and hammer > 0.9


def test_who_says_that_it_is_not_there_says_so_of_that_thing_alone() -> None:
    facts = [(SEEN, "mug", "desk", 9.0), (SEEN, "hammer", "desk", 9.0)]
    assert doubts_the_mug_alone(facts, (DENIED, "mug", "desk", 10.0))


def test_a_look_at_all_of_a_place_tells_of_what_was_not_seen_whatever_was_found_there() -> None:
    facts = [(SEEN, "mug", "desk", 9.0), (SEEN, "hammer", "desk", 10.0)]
    assert doubts_the_mug_alone(facts, (LOOKED, "everything", "desk", 10.0))


def test_a_look_that_did_see_it_tells_no_such_thing() -> None:
    look = [(SEEN, "mug", "desk", 10.0), (MISSED, "spatula", "desk", 10.0)]
    assert shares(learned([(SEEN, "mug", "desk", 9.0), *look], 10.1), "mug")["desk"] > 0.9


def test_nobody_remembers_where_what_the_robot_took_is() -> None:
    facts = [(SEEN, "mug", "desk", 9.0), (TAKEN, "mug", "desk", 9.1)]
    assert "memory" not in said_by(learned(facts, 9.1), "mug")
    put = learned([*facts, (PUT, "mug", "delivery", 9.2)], 9.2)
    assert said_by(put, "mug")["memory"].weights == (("delivery", 1.0),)


def test_what_the_robot_moved_is_no_habit_of_anybody() -> None:
    carried = [
        fact
        for day in range(10)
        for fact in (
            (PUT, "hammer", "shelf", day * 24 + 9.0),
            (TAKEN, "hammer", "shelf", day * 24 + 10.0),
        )
    ]
    assert learned(carried, 240).rates().of("hammer", "shelf").sum() < 0.5


def test_of_several_places_that_the_person_named_the_first_is_likeliest() -> None:
    facts = [(SAID, "mug", place, 9.0) for place in ("sofa", "bed", "desk")]
    known = shares(learned(facts, 9.0), "mug")
    assert known["desk"] > known["bed"] > known["sofa"] > 0.05


def test_it_goes_on_learning_from_what_was_added() -> None:
    store = FactStore()
    experience = Experience(store, lambda name: "", lambda: 9 * HOUR_S)
    assert experience.recalled("mug") == ()
    store.load([Fact(SEEN, "mug", "desk", 9 * HOUR_S)])
    assert shares(experience, "mug")["desk"] > 0.9


def test_rows_that_are_no_facts_teach_nothing() -> None:
    store = FactStore()
    store.load([Fact("lost", "mug", "desk", 1.0), Fact(SEEN, "mug", "desk", float("inf"))])  # type: ignore[arg-type]
    assert store.since(0, 10) == ((), 2)


@pytest.fixture
def file(tmp_path: Path) -> Path:
    file = tmp_path / "facts.sqlite"
    with_facts = FactStore(file)
    with_facts.load(
        Fact(k, t, {"table": "dining_table"}.get(p, p), h * HOUR_S) for k, t, p, h in MORNINGS
    )
    with_facts.close()
    return file


def test_what_was_learned_is_explained(file: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["facts", "--memory", str(file), "mug"]) == 0
    out = capsys.readouterr().out
    assert "a sighting at " in out
    assert "(memory " in out or "(habits " in out
    assert main(["facts", "--memory", str(file), "--learned"]) == 0
    out = capsys.readouterr().out
    assert "kitchenware          a sighting is worth half after" in out
    assert "UTC" in out


def test_what_nothing_was_learned_of_is_none(file: Path) -> None:
    assert main(["facts", "--memory", str(file), "lamp"]) == 1


class Told:
    def __init__(self, *said: Statement) -> None:
        self.said = said

    def learn(self) -> None: ...

    def recalled(self, name: str) -> tuple[Statement, ...]:
        return self.said


def test_the_search_goes_by_what_was_learned() -> None:
    said = Told(
        Statement("memory", (("sideboard", 1.0),), 0.1),
        Statement("habits", (("coffee_table", 3.0), ("bed", 1.0), ("attic", 1.0)), 0.9),
    )
    run = run_mission(
        "Find the mug", search="plan", llm=False, change=lambda p: replace(p, experience=said)
    )
    assert run.outcome.visited == ("coffee_table",)
    assert run.outcome.source == "habits"
    [recalled] = run.notebook.all(Recalled)
    assert recalled.says == ("memory", "habits", "habits", "habits")
    assert "people may have taken it there" in str(run.notebook.records)


def test_what_was_learned_of_a_place_that_is_gone_makes_no_other_place_likelier() -> None:
    said = Told(Statement("habits", (("desk", 1.0), ("attic", 9.0)), 0.9))
    run = run_mission(
        "Find the mug",
        search="plan",
        llm=False,
        defaults=False,
        change=lambda p: replace(p, experience=said),
    )
    first, *_ = run.notebook.all(Planned)
    assert first.says[first.places.index("desk")].startswith("habits 0.09")


def test_a_mission_goes_on_without_what_cannot_be_recalled() -> None:
    class Broken(Told):
        def recalled(self, name: str) -> tuple[Statement, ...]:
            raise RuntimeError("no disk")

    def change(parts: Parts) -> Parts:
        return replace(parts, experience=Broken())

    assert run_mission("Find the mug", search="plan", llm=False, change=change).outcome.status == (
        "done"
    )


def test_a_mission_with_what_was_learned_replays_without_the_file(
    file: Path, tmp_path: Path
) -> None:
    given: dict[str, Any] = {"world": "fake", "llm": "none", "user": "oracle"}
    settings = load_settings(**given, memory=file, runs=tmp_path / "runs")
    with Session(settings) as session:
        outcome = session.run("Find the mug")
    assert set(outcome.visited) & {"dining_table", "wagon", "coffee_table"}
    file.unlink()
    assert replay(Path(str(outcome.run_dir))).parting is None
