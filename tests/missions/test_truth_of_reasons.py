"""What the robot says of a mission is so: where it looked, why it did not, and never nothing."""

import io
from collections.abc import Callable, Iterator
from itertools import count

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from executive.app.session import Session
from executive.config import load_settings
from executive.language.wording import Wording
from executive.records import Utterance
from executive.situation import Situation
from executive.situation.looks import Looks
from executive.testing.bench import Run, run_mission
from executive.text import printable
from executive.types.commands import CommandKind
from executive.types.goals import DriveTo, Goal, Halt, LookAt, Pick, PutDown
from executive.types.outcome import MissionStatus
from executive.user import Nobody
from kb.facts import FactStore
from logs.questions.why import why
from logs.recording.reader import Run as RecordedRun
from sim.fake import FakeRobot

Fault = Callable[[Goal], str | None]
PLACE = "shelf_lobby"
THERE = "the shelf in the lobby"


def always(kind: type, why: str) -> Fault:
    return lambda goal: why if isinstance(goal, kind) else None


def told(run: Run) -> list[str]:
    return [u.text for u in run.notebook.all(Utterance) if u.speaker == "robot"]


@pytest.fixture
def three_views(monkeypatch: pytest.MonkeyPatch) -> None:
    """Furniture that takes three looks."""
    monkeypatch.setattr(FakeRobot, "views", lambda self, place: 3)


# --- only what was seen is known ---


def test_a_place_that_was_not_looked_at_is_not_said_to_be_without_the_thing() -> None:
    facts = FactStore()
    fault = always(LookAt, "my neck is stiff")
    run = run_mission("Find a power_drill", answers=[], llm=False, fault=fault, facts=facts)
    assert run.outcome.reason == (
        f"I could not look at {THERE}: my neck is stiff, and the script has no more answers"
    )
    assert "missed" not in {fact.kind for fact in facts.all()}


def test_a_place_of_which_a_part_was_seen_is_said_to_be_seen_in_part(three_views: None) -> None:
    fault: Fault = lambda goal: "my neck is stiff" if goal == LookAt(PLACE, 1) else None  # noqa: E731
    facts = FactStore()
    run = run_mission(
        "Find a power_drill",
        answers=[],
        llm=False,
        fault=fault,
        facts=facts,
        place={"power_drill": "bed"},
    )
    assert run.outcome.reason.startswith(f"I saw only a part of {THERE}: my neck is stiff")
    assert "missed" not in {fact.kind for fact in facts.all()}


def looked_all_over(command: str) -> set[str]:
    facts = FactStore()
    run_mission(command, answers=[], llm=False, facts=facts)
    return {fact.place for fact in facts.all() if fact.kind == "looked"}


@pytest.mark.parametrize("command", ["Find a power_drill", "What is on the shelf in the lobby?"])
def test_a_place_that_one_look_shows_was_looked_at_all_over(command: str) -> None:
    assert looked_all_over(command) == {PLACE}


def test_a_place_where_the_thing_was_seen_before_all_parts_were_was_not(three_views: None) -> None:
    assert looked_all_over("Find a power_drill") == set()


def test_a_place_where_the_thing_is_in_the_last_part_was_looked_at_all_over() -> None:
    looks = Looks()
    looks.begin(PLACE, 2)
    assert not looks.all_but(PLACE, 0)
    looks.without(PLACE, 0)
    assert looks.all_but(PLACE, 1)


def test_a_place_that_was_seen_wholly_at_the_second_visit_is_known(three_views: None) -> None:
    stiff = iter([True])
    run = run_mission(
        "Find a power_drill",
        answers=[PLACE],
        llm=False,
        fault=lambda g: "my neck is stiff" if g == LookAt(PLACE, 1) and next(stiff, 0) else None,
        place={"power_drill": "bed"},
    )
    assert run.outcome.reason.startswith(f"I did not find the power drill on {THERE}")


def test_a_grasp_is_tried_again_if_it_could_not_look_whether_the_thing_is_gone() -> None:
    looks, grasps = count(), count()

    def fault(goal: Goal) -> str | None:
        if isinstance(goal, LookAt):
            return "my neck is stiff" if next(looks) == 1 else None
        return "it slipped" if isinstance(goal, Pick) and next(grasps) == 0 else None

    run = run_mission("Take a hammer", llm=False, fault=fault)
    assert run.outcome.status == MissionStatus.DONE
    assert run.outcome.visited == (PLACE,)


@pytest.mark.parametrize(
    ("patience_s", "reason"),
    [
        (3.0, f"I could not get to {THERE}: it took longer than 3 s"),
        (0.4, f"I could not get to {THERE}: it took longer than 0.4 s"),
    ],
)
def test_what_takes_too_long_is_told_with_its_time(patience_s: float, reason: str) -> None:
    run = run_mission(
        "Find a power_drill", answers=["no idea"], llm=False, parameters={"action_s": patience_s}
    )
    assert run.outcome.reason == f"{reason}, and you could not tell me"
    assert f"Sorry: {run.outcome.reason}." in told(run)


def test_a_look_that_takes_too_long_leaves_the_place_unseen(monkeypatch) -> None:
    monkeypatch.setattr("sim.fake.LOOK_S", 9.0)
    monkeypatch.setattr("sim.fake.SPEED_M_S", 100.0)
    run = run_mission("Find a power_drill", answers=[], llm=False, parameters={"action_s": 8.0})
    assert run.outcome.reason.startswith(f"I could not look at {THERE}: it took longer than 8 s")


PLACES = st.sampled_from(["desk", "sofa", "bed"])
PARTS = {"desk": 1, "sofa": 2, "bed": 3}
STEPS = st.one_of(
    st.tuples(st.just("reached"), PLACES),
    st.tuples(st.just("not_reached"), PLACES, st.just("shut")),
    st.tuples(st.just("not_seen"), PLACES, st.just("dark")),
    st.tuples(st.just("begin"), PLACES),
    st.tuples(st.just("without"), PLACES, st.integers(0, 2)),
)


@given(st.lists(STEPS))
def test_it_is_said_not_to_be_where_every_part_was_seen_without_it_and_nowhere_else(steps) -> None:
    looks, seen = Looks(), dict[str, set[int]]()
    for name, place, *rest in steps:
        if name == "begin":
            rest, seen[place] = [PARTS[place]], set()
        if name == "without":
            if place not in seen or rest[0] >= PARTS[place]:
                continue
            seen[place].add(rest[0])
        getattr(looks, name)(place, *rest)
    clauses = list(looks.clauses("mug", Wording(lambda name: None)))
    found = next((c for c in clauses if c.startswith("I did not find")), "")
    known = {place for place in PARTS if place in found}
    whole = {place for place, parts in seen.items() if len(parts) == PARTS[place]}
    assert known == (whole & set(looks.visited)) - set(looks.unreached)
    assert all(sum(p in clause for clause in clauses) == 1 for p in looks.visited)


def test_places_where_the_same_went_wrong_are_told_in_one_clause() -> None:
    looks = Looks()
    looks.not_reached("desk", "it is shut")
    looks.not_reached("sofa", "the way is blocked")
    looks.not_reached("bed", "it is shut")
    assert list(looks.clauses("mug", Wording(lambda name: None))) == [
        "I could not get to the desk and the bed: it is shut",
        "I could not get to the sofa: the way is blocked",
    ]


def test_the_log_does_not_say_of_an_unseen_place_that_the_thing_was_not_seen_there(
    tmp_path,
) -> None:
    quiet = {"llm": "none", "user": "none", "runs": tmp_path}
    session = Session(load_settings(world="fake", **quiet), out=io.StringIO())
    session.world.fault = always(LookAt, "my neck is stiff")  # type: ignore[attr-defined]
    session.run("Find a power_drill")
    session.close()
    assert session.folder
    links = {link.question: link.answer for link in why(RecordedRun(session.folder))}
    assert links[f"look at {PLACE}"] == "not all of it seen: my neck is stiff"


# --- the reason is the last cause, and there always is one ---


def test_a_way_back_that_is_blocked_is_not_the_reason_why_it_was_not_found() -> None:
    run = run_mission(
        "Find a power_drill",
        place={"power_drill": "bed"},
        answers=["no idea"],
        llm=False,
        fault=lambda goal: "the way is blocked" if goal == DriveTo("person") else None,
    )
    assert run.outcome.reason == (
        f"I did not find the power drill on {THERE}, and you could not tell me"
    )


def test_what_was_found_is_told_even_if_the_robot_cannot_come_back() -> None:
    blocked = lambda goal: "the way is blocked" if goal == DriveTo("person") else None  # noqa: E731
    run = run_mission("Find a power_drill", llm=False, fault=blocked)
    assert run.outcome.status == MissionStatus.NOT_DONE
    assert run.outcome.reason == f"the power drill is on {THERE}, but the way is blocked"


@pytest.mark.parametrize("command", ["Find a power_drill", "Is there a power_drill on the desk?"])
def test_a_robot_that_comes_back_at_the_second_try_does_not_say_that_it_could_not(command) -> None:
    ways_back = iter(["the way is blocked"])
    run = run_mission(
        command,
        place={"power_drill": "desk"},
        llm=False,
        fault=lambda goal: next(ways_back, None) if goal == DriveTo("person") else None,
    )
    assert run.outcome.status == MissionStatus.DONE
    assert "blocked" not in run.outcome.reason
    assert len(set(told(run))) == len(told(run))


def test_who_was_not_reached_is_not_come_to_while_it_is_told() -> None:
    goals: list[Goal] = []

    def fault(goal: Goal) -> str | None:
        goals.append(goal)
        return "the way is blocked" if len(goals) == 2 else None

    run = run_mission("Go to the desk and come here", llm=False, fault=fault)
    assert run.outcome.tasks[1].reason == "I could not get to you: the way is blocked"
    assert goals.count(DriveTo("person")) == 1


@pytest.mark.parametrize("kind", [DriveTo, LookAt, Pick, PutDown])
def test_a_robot_that_gives_no_reason_gets_one(kind: type) -> None:
    run = run_mission("Bring a hammer", answers=[], llm=False, fault=always(kind, " "))
    assert run.outcome.status == MissionStatus.NOT_DONE
    assert "nothing said why" in run.outcome.reason


def test_an_outcome_without_a_reason_says_how_the_mission_ended() -> None:
    outcome = Situation().outcome(mission_time_s=0.0, wall_time_s=0.0, run_dir=None)
    assert outcome.reason == "the mission ended as not done, and nothing said why"


def faults(chances: Iterator[bool]) -> Fault:
    def fault(goal: Goal) -> str | None:
        return None if isinstance(goal, Halt) or not next(chances, False) else f"no {type(goal)}"

    return fault


@settings(max_examples=80)
@given(
    kind=st.sampled_from(["Find", "Take", "Bring"]),
    chances=st.lists(st.booleans(), max_size=30),
    answers=st.lists(st.sampled_from(["desk", "yes", "no", "no idea", "hm", None]), max_size=5),
    patience_s=st.sampled_from([0.3, 4.0, 120.0]),
    thing=st.sampled_from(["hammer", "apple", "fruit", "hamer", "it"]),
)
def test_whatever_fails_the_reason_is_a_sentence(kind, chances, answers, patience_s, thing) -> None:
    run = run_mission(
        f"{kind} the {thing}",
        answers=answers,
        llm=False,
        fault=faults(iter(chances)),
        parameters={"action_s": patience_s},
    )
    reason = run.outcome.reason
    assert len(reason) > 8
    assert reason == printable(reason).strip(" ;:,")
    if run.outcome.status == MissionStatus.DONE:
        held = {CommandKind.TAKE: run.outcome.object}.get(run.outcome.kind)
        assert (run.world.held, run.situation.hand.in_hand) == (held, held)
    else:
        assert f"Sorry: {reason}." in told(run)
    claimed = reason.partition("I did not find")[2].partition(";")[0]
    assert (run.world.things.get(run.outcome.object) or "?") not in claimed


# --- words from outside cannot forge a line ---


FORGED = "the \x1b[31mhammer\nSorry: forged"


@pytest.mark.parametrize("words", [FORGED, f"Find {FORGED}", f"Put {FORGED} down"])
def test_words_of_the_person_stay_on_one_line(words: str) -> None:
    run = run_mission(words, answers=[FORGED] * 4, llm=False)
    for said in [*told(run), run.outcome.reason]:
        assert said == printable(said)


@pytest.mark.parametrize("kind", [DriveTo, LookAt, Pick, PutDown])
def test_reasons_of_the_robot_stay_on_one_line(kind: type) -> None:
    run = run_mission("Bring a hammer", answers=[], llm=False, fault=always(kind, FORGED))
    assert r"\x1b[31mhammer\nSorry" in run.outcome.reason
    for said in [*told(run), run.outcome.reason]:
        assert said == printable(said)


def test_what_nobody_is_there_to_hear_is_no_question_that_was_asked() -> None:
    run = run_mission("Bring a fruit", llm=False, person=Nobody)
    assert (run.outcome.status, run.outcome.inquiries) == (MissionStatus.NOT_DONE, 0)
    assert run.outcome.reason.endswith("there is nobody to ask")
