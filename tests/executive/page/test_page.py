"""What the person sends reaches the robot, and what it does reaches the pages."""

import json
import time
from collections.abc import Iterator
from contextlib import closing
from itertools import islice
from pathlib import Path

import pytest
from paging import Robot, ask, heard, page_alone, post, robot, told
from patience import PATIENCE_S, until_still

from executive.events import Inbox
from executive.page.board import Board
from executive.page.person import PagePerson
from executive.page.site import MOST_BYTES


@pytest.fixture
def talking(tmp_path: Path) -> Iterator[Robot]:
    with robot(tmp_path) as made:
        heard(made.page, "doing", state="ready")
        yield made


def test_a_command_is_carried_out_and_its_answers_are_taken(talking: Robot) -> None:
    post(talking.page, "/say", {"words": "Find a fruit"})
    question = heard(talking.page, "question", kind="which_object")
    assert "peach" in question["options"]
    post(talking.page, "/say", {"words": "peach"})
    heard(talking.page, "question", kind="where_is")
    post(talking.page, "/say", {"words": "high_table"})
    assert heard(talking.page, "outcome")["status"] == "done"
    heard(talking.page, "doing", state="ready")
    assert talking.outcomes[0].object == "peach"


def test_what_is_chosen_answers_its_own_question_and_no_other(talking: Robot) -> None:
    post(talking.page, "/say", {"words": "Find a fruit"})
    first = heard(talking.page, "question", kind="which_object")["id"]
    assert post(talking.page, "/say", {"words": "peach", "question": first}) == 200
    second = heard(talking.page, "question", kind="where_is")["id"]
    assert post(talking.page, "/say", {"words": "sofa", "question": first}) == 409
    assert heard(talking.page, "question")["id"] == second
    assert not any("sofa" in one.json for one in talking.page.board.since(0) if one.name == "said")


def test_who_is_listened_to_is_busy_as_soon_as_they_spoke() -> None:
    person = PagePerson(inbox := Inbox(), board := Board())
    person.listen()
    person.says("Find a fruit")
    assert inbox.wait(PATIENCE_S)
    assert {one.name: json.loads(one.json) for one in board.since(0)}["doing"] == {"state": "busy"}


def test_the_stop_button_stops_a_mission_and_no_more(talking: Robot) -> None:
    post(talking.page, "/say", {"words": "Find a fruit"})
    heard(talking.page, "question", kind="which_object")
    assert post(talking.page, "/stop", {}) == 200
    assert heard(talking.page, "outcome")["status"] == "stopped"
    assert heard(talking.page, "doing", state="ready")
    assert talking.outcomes[0].reason == "stopped by the person"


def test_a_stop_that_is_sent_again_was_pressed_once(talking: Robot) -> None:
    for press in (0.1, 0.1, 0.2):
        assert post(talking.page, "/stop", {"press": press}) == 200
    stops = [one for one in talking.page.board.since(0) if '"stop":true' in one.json]
    assert len(stops) == 2


def test_at_rest_there_is_nothing_to_stop(talking: Robot) -> None:
    post(talking.page, "/stop", {})
    assert heard(talking.page, "said", who="robot")["text"].startswith("There is nothing to stop")
    assert not talking.outcomes


def test_each_sentence_in_a_mission_says_why(tmp_path: Path) -> None:
    with robot(tmp_path, recorded=True) as made:
        heard(made.page, "doing", state="ready")
        post(made.page, "/say", {"words": "Find a fruit"})
        heard(made.page, "question")
        said = heard(made.page, "said", who="robot")
        answer = ask(made.page, "/why", run=said["run"], time_s=said["time_s"])
        chain = json.loads(answer.body)
    assert chain[0]["question"] == "known object"
    assert chain[-2] == {
        "time_s": 0.0,
        "question": "understand",
        "answer": "find fruit",
        "source": "person",
        "by": chain[-2]["by"],
        "alternatives": [],
    }
    assert chain[-1]["answer"] == "'Find a fruit'"


@pytest.mark.parametrize("run", ["", "..", "../..", "/etc", "nothing", "a/b"])
def test_only_runs_of_the_robot_are_asked(talking: Robot, run: str) -> None:
    assert ask(talking.page, "/why", run=run, time_s="0").status == 404


@pytest.mark.parametrize("time_s", ["", "soon"])
def test_a_time_that_is_none_is_refused(talking: Robot, time_s: str) -> None:
    assert ask(talking.page, "/why", run="x", time_s=time_s).status == 404


HOSTILE = [b"", b"{}", b"[]", b'{"words": 3}', b"\xff", b"[" * 8000, b'{"words": ["a"]}']


@pytest.mark.parametrize("body", HOSTILE)
def test_what_is_no_text_is_refused(talking: Robot, body: bytes) -> None:
    assert ask(talking.page, "/say", method="POST", body=body).status == 413


def test_a_million_letters_are_refused_unread(talking: Robot) -> None:
    body = json.dumps({"words": "a" * 1_000_000}).encode()
    assert ask(talking.page, "/say", method="POST", body=body).status == 413


def test_more_than_the_robot_reads_is_answered_so_and_keeps_the_question(talking: Robot) -> None:
    post(talking.page, "/say", {"words": "Find a fruit"})
    heard(talking.page, "question", kind="which_object")
    assert post(talking.page, "/say", {"words": "a" * (MOST_BYTES - 100)}) == 200
    sorry = "Sorry: what you said is too long, I read at most 1,000 characters."
    assert heard(talking.page, "said", text=sorry)
    assert heard(talking.page, "question", kind="which_object")


ODD = ["\x1b[2J\x00\r\nstop it \u202e", "<img src=x onerror=alert(1)>", "\ud800", "a\u2028b"]


@pytest.mark.parametrize("words", ODD)
def test_odd_words_are_shown_on_one_line_and_hurt_nobody(talking: Robot, words: str) -> None:
    assert post(talking.page, "/say", {"words": words}) == 200
    shown = heard(talking.page, "said", who="person")["text"]
    assert shown.isprintable()


def test_who_comes_back_is_told_only_what_is_new(talking: Robot) -> None:
    board = talking.page.board
    known = f"{board.name}-{board.since(0)[-1].number}"
    post(talking.page, "/say", {"words": "hello"})
    with closing(told(talking.page, headers={"last-event-id": known})) as page:
        assert next(page).name == "said"


@pytest.mark.parametrize("known", ["other-7", "nonsense", "-", "other-999999999999"])
def test_who_comes_from_an_earlier_robot_forgets_what_it_showed(talking: Robot, known: str) -> None:
    with closing(told(talking.page, headers={"last-event-id": known})) as page:
        assert next(page).name == "fresh"


def test_two_pages_are_told_the_same(talking: Robot) -> None:
    with closing(told(talking.page)) as one, closing(told(talking.page)) as other:
        post(talking.page, "/say", {"words": "hello"})
        conversations = [
            [t.value for t in islice((t for t in page if t.name == "said"), 2)]
            for page in (one, other)
        ]
    assert conversations[0] == conversations[1]


def test_a_page_that_is_closed_is_no_answer_and_no_stop(talking: Robot) -> None:
    post(talking.page, "/say", {"words": "Find a fruit"})
    heard(talking.page, "question")
    reading = told(talking.page)
    next(reading)
    reading.close()
    assert heard(talking.page, "question", kind="which_object")
    assert not talking.outcomes


def test_while_nothing_happens_nothing_is_ticked_and_nothing_told(talking: Robot) -> None:
    post(talking.page, "/say", {"words": "Find a fruit"})
    heard(talking.page, "question")
    before = until_still(lambda: talking.page.board.since(0)[-1].number, for_s=0.3)
    time.sleep(0.5)
    assert talking.page.board.since(0)[-1].number == before


def test_pages_are_told_when_the_robot_has_ended() -> None:
    with page_alone() as page:
        reading = told(page)
        assert next(reading).name == "fresh"
    assert [one for one in reading if one.name == "doing"][-1].value == {"state": "over"}
