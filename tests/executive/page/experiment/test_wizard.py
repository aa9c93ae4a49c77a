"""An experimenter steps in: it is done, it stands in the recording, and a replay is the same."""

import json
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path
from typing import Any

import pytest
from paging import Robot, heard, notice, robot, step_in, their_token, told

from executive.events import Intervened
from executive.page.experiment.wizard import AS_BEFORE
from executive.page.gate import Gate
from executive.page.page import Page
from executive.records import Intervention
from executive.replay import replay
from executive.types.outcome import Outcome
from logs.recording.reader import Run

ANNA = "Anna"


@pytest.fixture
def stepped(tmp_path: Path) -> Iterator[Robot]:
    with robot(tmp_path, recorded=True, experimenter=True, world="paging:in_real_time") as made:
        heard(made.page, "doing", state="ready")
        yield made


def next_held(page: Page) -> int:
    """The number of the words that are held next."""
    with closing(told(page, token=their_token(page), path="/experiment/events")) as reading:
        for one in reading:
            if one.name == "words" and one.value["held"]:
                return int(one.value["held"][0]["number"])
    raise AssertionError("nothing is held")


def interventions(outcome: Outcome) -> list[tuple[str, str, str, str]]:
    """As recorded, once as events and once by themselves; and the replay is tick for tick so."""
    run = Run(Path(outcome.run_dir or ""))
    events = [at.value for at in run.events() if isinstance(at.value, Intervened)]
    told = [at.value for at in run.records(Intervention)]
    assert [(e.by, e.deed, e.was, e.became) for e in events] == [
        (t.by, t.deed, t.was, t.became) for t in told
    ]
    assert replay(run.path).parting is None
    return [(t.by, t.deed, t.was, t.became) for t in told]


def test_a_question_is_answered_in_the_persons_stead(stepped: Robot) -> None:
    stepped.page.says("Find a fruit")
    question = notice(stepped.page, "question", kind="which_object")
    step_in(stepped.page, "answer", question=question["id"], words="peach")
    question = notice(stepped.page, "question", kind="where_is")
    step_in(stepped.page, "answer", question=question["id"], words="high_table")
    outcome = stepped.ended(1)
    assert (outcome.status, outcome.object) == ("done", "peach")
    (_, _, asked, peach), (by, deed, _, place) = interventions(outcome)
    assert asked.startswith("Which fruit do you mean")
    assert (by, deed, peach, place) == (ANNA, "answer", "peach", "high_table")


def test_what_is_over_is_not_answered(stepped: Robot) -> None:
    stepped.page.says("Find a fruit")
    question = notice(stepped.page, "question", kind="which_object")
    stepped.page.says("peach")
    notice(stepped.page, "question", kind="where_is")
    told = step_in(stepped.page, "answer", status=404, question=question["id"], words="banana")
    assert "over" in told["error"]


def test_words_that_are_held_are_said_otherwise_or_never(stepped: Robot) -> None:
    page = stepped.page
    step_in(page, "hold", on=True)
    page.says("Find the peach")
    question = notice(
        page, "words", holds=True, held=[{"number": 1, "text": "Where is the peach?"}]
    )
    assert json.loads(next(c.json for c in page.board.since(0) if c.name == "question")) is None
    step_in(page, "words", number=question["held"][0]["number"], words="Where did you put it?")
    assert heard(page, "question", kind="where_is")["text"] == "Where did you put it?"
    assert heard(page, "said", who="robot")["text"] == "Where did you put it?"
    page.says("high_table")
    step_in(page, "words", number=next_held(page), words="")
    step_in(page, "hold", on=False)
    outcome = stepped.ended(1)
    deeds = [(deed, was, became) for _, deed, was, became in interventions(outcome)]
    assert deeds[0] == ("hold", AS_BEFORE, "on")
    assert deeds[1] == ("words", "Where is the peach?", "Where did you put it?")
    assert deeds[2][0] == "words"
    assert deeds[2][2] == ""
    said = [json.loads(c.json)["text"] for c in page.board.since(0) if c.name == "said"]
    assert deeds[2][1] not in said


def test_a_question_that_is_held_and_answered_in_their_stead_is_said_no_more(
    stepped: Robot,
) -> None:
    page = stepped.page
    step_in(page, "hold", on=True)
    page.says("Find the peach")
    asked = "Where is the peach?"
    notice(page, "words", holds=True, held=[{"number": 1, "text": asked}])
    with closing(told(page, token=their_token(page), path="/experiment/events")) as reading:
        waits = next(one.value for one in reading if one.name == "question" and one.value)
    step_in(page, "answer", question=waits["id"], words="high_table")
    outcome = stepped.ended(1)
    step_in(page, "hold", on=False)
    assert outcome.status == "done"
    said = [json.loads(c.json)["text"] for c in page.board.since(0) if c.name == "said"]
    assert "high table" in said
    assert asked not in said
    deeds = [(deed, was, became) for _, deed, was, became in interventions(outcome)]
    assert deeds[1:3] == [("answer", asked, "high_table"), ("words", asked, "")]


def test_a_sentence_that_was_once_not_said_is_heard_when_it_is_said_again() -> None:
    heard: list[str] = []
    gate = Gate(lambda entry: heard.append(entry["text"]))
    gate.holds = True
    gate.say({"text": "Where?"})
    gate.let_go(1, "")
    assert gate.as_said("Where?") is None
    gate.holds = False
    gate.say({"text": "Where?"})
    assert gate.as_said("Where?") == "Where?"
    assert heard == ["Where?"]


def test_what_was_held_is_said_in_order_when_nothing_is_held_any_more(stepped: Robot) -> None:
    page = stepped.page
    step_in(page, "hold", on=True)
    page.says("Find the peach at the high_table")
    stepped.ended(1)
    assert not any('"robot"' in one.json for one in page.board.since(0) if one.name == "said")
    held = [one["text"] for one in notice(page, "words", holds=True)["held"]]
    step_in(page, "hold", on=False)
    said = [json.loads(c.json) for c in page.board.since(0) if c.name == "said"]
    assert [one["text"] for one in said if one["who"] == "robot"] == held
    assert len(held) > 1


def test_a_stop_is_answered_although_words_are_held(stepped: Robot) -> None:
    step_in(stepped.page, "hold", on=True)
    stepped.page.says("Find a fruit")
    notice(stepped.page, "question", kind="which_object")
    step_in(stepped.page, "stop")
    assert heard(stepped.page, "said", who="robot")["text"].startswith("Stopping.")
    outcome = stepped.ended(1)
    assert (outcome.status, outcome.reason) == ("stopped", f"stopped by the experimenter {ANNA}")
    assert interventions(outcome)[-1] == (ANNA, "stop", "", "")


def test_the_robot_is_sent_elsewhere_on_its_way(stepped: Robot) -> None:
    stepped.page.says("Find the peach at the sofa")
    heard(stepped.page, "doing", activity="driving")
    step_in(stepped.page, "place", place="high_table")
    outcome = stepped.ended(1)
    assert outcome.status == "done"
    assert outcome.visited == ("high_table",)
    assert outcome.location == "high_table"
    assert interventions(outcome) == [(ANNA, "place", "sofa", "high_table")]


def test_a_robot_that_does_not_search_is_sent_nowhere(stepped: Robot) -> None:
    assert "over" in step_in(stepped.page, "place", status=404, place="sofa")["error"]
    assert "no such place" in step_in(stepped.page, "place", status=404, place="moon")["error"]


def test_where_it_would_look_waits_and_another_place_takes_its_place(stepped: Robot) -> None:
    page = stepped.page
    step_in(page, "hold_place", on=True)
    page.says("Find the peach at the sofa")
    held = {"to": "look", "place": "sofa", "among": []}
    notice(page, "choice", holds=True, held=held)
    assert heard(page, "doing", activity="thinking")
    assert "no such place" in step_in(page, "place", status=404, place="moon")["error"]
    step_in(page, "place", place="high_table")
    outcome = stepped.ended(1)
    assert (outcome.status, outcome.visited) == ("done", ("high_table",))
    assert interventions(outcome) == [
        (ANNA, "hold_place", AS_BEFORE, "on"),
        (ANNA, "place", "sofa", "high_table"),
    ]


def test_where_it_would_look_is_let_go_with_all_that_come(stepped: Robot) -> None:
    page = stepped.page
    step_in(page, "hold_place", on=True)
    page.says("Find the peach at the sofa")
    notice(page, "choice", held={"to": "look", "place": "sofa", "among": []})
    step_in(page, "hold_place", on=False)
    heard(page, "question", kind="where_is")
    page.says("high_table")
    outcome = stepped.ended(1)
    assert outcome.visited == ("sofa", "high_table")
    assert [deed for _, deed, _, _ in interventions(outcome)] == ["hold_place", "hold_place"]


def test_a_place_that_the_person_does_not_want_is_refused(stepped: Robot) -> None:
    page = stepped.page
    page.says("Take the peach at the high_table")
    stepped.ended(1)
    step_in(page, "hold_place", on=True)
    page.says("Put it on the sofa or the desk")
    notice(page, "choice", held={"to": "put", "place": "desk", "among": ["desk", "sofa"]})
    told = step_in(page, "place", status=404, place="bed")["error"]
    assert "desk or sofa" in told
    step_in(page, "place", place="sofa")
    outcome = stepped.ended(2)
    assert (outcome.status, outcome.tasks[0].put_at) == ("done", "sofa")
    interventions(outcome)


def test_a_stop_is_done_while_a_choice_waits_and_the_next_mission_waits_too(
    stepped: Robot,
) -> None:
    page = stepped.page
    step_in(page, "hold_place", on=True)
    for count in (1, 2):
        page.says("Find the peach at the sofa")
        notice(page, "choice", held={"to": "look", "place": "sofa", "among": []})
        page.stops()
        outcome = stepped.ended(count)
        assert (outcome.status, outcome.visited) == ("stopped", ())
        assert interventions(outcome) == [(ANNA, "hold_place", AS_BEFORE, "on")]
        notice(page, "choice", holds=True, held=None)


def test_what_nobody_is_there_to_let_go_is_let_go(
    stepped: Robot, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("executive.page.experiment.wizard.LEFT_S", 0.0)
    page = stepped.page
    step_in(page, "hold_place", on=True)
    page.says("Find the peach at the sofa")
    notice(page, "choice", held={"to": "look", "place": "sofa", "among": []})  # and is closed
    heard(page, "question", kind="where_is")
    page.stops()
    (_, let_go) = interventions(stepped.ended(1))
    assert let_go == (ANNA, "hold_place", "no page of an experimenter is open any more", "off")


@pytest.mark.parametrize(
    "sent",
    [
        {},
        {"deed": "fly"},
        {"deed": "answer", "question": "1", "words": "peach"},
        {"deed": "words", "number": 99, "words": "Hello"},
        {"deed": ["hold"]},
    ],
)
def test_what_is_no_deed_is_refused(stepped: Robot, sent: dict[str, Any]) -> None:
    step_in(stepped.page, sent.pop("deed", ""), status=404, **sent)


def test_who_it_was_is_one_line_of_few_letters(stepped: Robot) -> None:
    stepped.page.says("Find a fruit")
    question = notice(stepped.page, "question", kind="which_object")["id"]
    by = "<b>A\x1b\n" + "n" * 200
    step_in(stepped.page, "answer", question=question, words="peach", by=by)
    notice(stepped.page, "question", kind="where_is")
    stepped.page.stops()
    ((who, *_),) = interventions(stepped.ended(1))
    assert who.isprintable()
    assert len(who) == 60
