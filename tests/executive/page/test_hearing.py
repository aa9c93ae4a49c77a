"""What a page's recogniser sends is bounded, and made into what ears make."""

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from paging import Robot, ask, heard, page_alone, post, robot

from executive.language.grammar import EnglishInterpreter
from executive.page.hearing import Alternative, Hearing, alternatives_in, stop_in
from executive.page.study.page import StudyPage
from executive.text import LONGEST

HEARING = Hearing(("mug", "sugar box", "sofa"), EnglishInterpreter().agrees)


@pytest.fixture
def talking(tmp_path: Path) -> Iterator[Robot]:
    with robot(tmp_path) as made:
        heard(made.page, "doing", state="ready")
        yield made


def spoken(*words: str, confidence: Any = 0.9, final: bool = True) -> dict[str, Any]:
    """What a page sends."""
    alternatives = [{"words": one, "confidence": confidence} for one in words]
    return {"alternatives": alternatives, "utterance": words[0], "final": final}


def read(*words: str, confidence: float = 0.9) -> tuple[str, bool]:
    reading = HEARING.reading([Alternative(one, confidence) for one in words])
    return reading.text, reading.sure


def test_what_speaks_of_what_there_is_comes_before_what_is_likelier() -> None:
    assert read("bring the mud", "bring the muck", "Bring the mug.") == ("Bring the mug.", False)
    assert read("bring the smug", "sing") == ("bring the smug", False)


def test_only_a_yes_or_a_no_without_doubt_is_certain() -> None:
    assert read("Yes.", "yes please") == ("Yes.", True)
    assert read("bring the mug") == ("bring the mug", False)
    assert read("yes", "less") == ("yes", False)
    assert read("yes", "no") == ("yes", False)
    assert read("yes", confidence=0.0) == ("yes", False)


def test_a_stop_is_heard_in_each_alternative() -> None:
    assert stop_in([Alternative("shop", 0.8), Alternative("stop", 0.1)]) == ("stop", 0.1)
    assert stop_in([Alternative("find the stop sign", 0.8)]) is None


@pytest.mark.parametrize("confidence", [-1, 2, "high", None, float("nan"), float("inf")])
def test_a_confidence_that_is_none_is_refused(confidence: object) -> None:
    assert alternatives_in(spoken("mug", confidence=confidence)) == ()


def test_what_is_too_long_or_too_much_is_refused() -> None:
    assert alternatives_in(spoken("a" * LONGEST))
    assert not alternatives_in(spoken("a" * (LONGEST + 1)))
    assert not alternatives_in(spoken(*"abcdef"))


HOSTILE = [b"", b"[]", b'{"alternatives": 3}', b'{"alternatives": ["stop"]}', b"[" * 8000]


@pytest.mark.parametrize("body", HOSTILE)
@pytest.mark.parametrize("path", ["/heard", "/settle"])
def test_what_is_nothing_that_a_page_sends_is_refused(
    talking: Robot, path: str, body: bytes
) -> None:
    assert ask(talking.page, path, method="POST", body=body).status == 413


@pytest.mark.parametrize("path", ["/heard", "/settle"])
def test_another_page_and_one_without_the_token_are_not_heard(talking: Robot, path: str) -> None:
    sent = spoken("stop")
    assert post(talking.page, path, sent, token="another") == 403
    assert post(talking.page, path, sent, headers={"origin": "http://elsewhere"}) == 403


def test_odd_words_are_asked_back_on_one_line(talking: Robot) -> None:
    post(talking.page, "/heard", spoken("\x1b[2J<b>\r\nbring\u202e the \ud800mug"))
    asked = heard(talking.page, "asked_back")
    assert asked["text"].isprintable()


def test_what_is_heard_is_never_done_unasked(talking: Robot) -> None:
    for words in ("Find the peach", "quit", "What can you do?"):
        assert post(talking.page, "/heard", spoken(words)) == 200
        assert heard(talking.page, "asked_back", words=words)
    assert not talking.outcomes
    assert not talking.over.is_set()


def test_what_is_not_final_is_not_taken_in(talking: Robot) -> None:
    assert post(talking.page, "/heard", spoken("Find the peach", final=False)) == 200
    assert not [c for c in talking.page.board.since(0) if c.name == "said"]


def test_one_utterance_stops_once(talking: Robot) -> None:
    for words in ("stop", "stop it"):
        sent = {**spoken(words, final=False), "utterance": "1"}
        answered = ask(talking.page, "/heard", method="POST", body=json.dumps(sent).encode())
        assert json.loads(answered.body) == {"became": "stopped"}
    heard(talking.page, "said", who="robot")
    said = [json.loads(c.json) for c in talking.page.board.since(0) if c.name == "said"]
    assert [one["text"] for one in said if one["who"] == "person"] == ["stop"]


def test_before_the_robot_is_ready_only_a_stop_is_heard() -> None:
    with page_alone() as page:
        assert page.hears([Alternative("find the mug", 0.9)], "1", final=True) == "not ready"
        assert page.hears([Alternative("stop", 0.9)], "2", final=False) == "stopped"


def test_a_study_listens_only_if_its_file_says_so() -> None:
    with StudyPage() as page:
        assert post(page, "/heard", spoken("stop"), token=page.url.split("=")[1]) == 409
