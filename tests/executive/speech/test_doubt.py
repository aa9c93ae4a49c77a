"""What is heard and not certain is asked back, and never done without a yes."""

import io

import pytest
from hypothesis import given
from hypothesis import strategies as st

from executive.events import Heard, Inbox, Listened, StopRequested
from executive.language.control import Control, control
from executive.language.grammar import EnglishInterpreter
from executive.speech.doubt import FRESH_S, PATIENCE_S, UNCLEAR, Doubt
from executive.speech.interfaces import Reading
from executive.user import Console

ENGLISH = EnglishInterpreter()


class Talk:
    """A person who is heard while the robot is busy."""

    def __init__(self) -> None:
        self.inbox, self.out, self.time = Inbox(), io.StringIO(), 0.0
        self.person = Console(self.inbox, io.StringIO(), self.out)
        self.person.keep_open(True)
        self.person.tell("I begin.")
        self.doubt = Doubt(self.person, ENGLISH, self.inbox, now=lambda: self.time)

    def hears(self, text: str, *, sure: bool = False, began: float | None = None) -> None:
        self.doubt.hear(Reading("ears", text, 0.5, sure), began=began)

    @property
    def done(self) -> list[str]:
        """What went the way of typed words."""
        events = self.inbox.take_all()
        return [
            "stop" if isinstance(e, StopRequested) else e.words
            for e in events
            if isinstance(e, Heard | StopRequested)
        ]


@pytest.fixture
def talk() -> Talk:
    return Talk()


def test_what_is_certain_goes_the_way_of_typed_words(talk: Talk) -> None:
    talk.hears("bring the mug", sure=True)
    assert talk.done == ["bring the mug"]


def test_what_is_not_certain_is_asked_back_and_not_done(talk: Talk) -> None:
    talk.hears("bring the mug")
    assert "Did you say: bring the mug?" in talk.out.getvalue()
    assert talk.done == []


def test_a_certain_yes_does_it(talk: Talk) -> None:
    talk.hears("bring the mug")
    talk.hears("yes", sure=True)
    assert talk.done == ["bring the mug"]


def test_an_uncertain_yes_does_not(talk: Talk) -> None:
    talk.hears("bring the mug")
    talk.hears("yes")
    assert "Please say yes or no: bring the mug?" in talk.out.getvalue()
    assert talk.done == []


def test_a_typed_yes_does_it_and_answers_nothing_else(talk: Talk) -> None:
    talk.hears("bring the mug")
    talk.person.says("yes")
    assert talk.done == ["bring the mug"]


@pytest.mark.parametrize("no", ["no", "bring the pear"])
def test_a_no_or_another_command_takes_it_back(talk: Talk, no: str) -> None:
    talk.hears("bring the mug")
    talk.hears(no, sure=True)
    assert "bring the mug" not in talk.done
    talk.hears("yes", sure=True)
    assert "bring the mug" not in talk.done


def test_a_yes_that_comes_too_late_does_nothing(talk: Talk) -> None:
    talk.hears("bring the mug")
    talk.time = PATIENCE_S + 1
    talk.hears("yes", sure=True)
    assert "bring the mug" not in talk.done


def test_a_button_answers_only_its_own_question_however_late(talk: Talk) -> None:
    talk.hears("bring the pear")
    first = talk.doubt.asked_back
    talk.hears("bring the mug")
    talk.time = PATIENCE_S + 1
    assert first
    assert not talk.doubt.settle(first.number, agrees=True)
    assert talk.done == []
    assert talk.doubt.settle(first.number + 1, agrees=True)
    assert talk.done == ["bring the mug"]
    assert not talk.doubt.settle(first.number + 1, agrees=True)


def test_who_shows_what_is_asked_back_is_told_when_it_changes(talk: Talk) -> None:
    shown: list[str] = []

    def show() -> None:
        asked = talk.doubt.asked_back
        shown.append(asked.text if asked else "")

    talk.doubt.changed = show
    talk.hears("bring the mug")
    talk.person.says("bring the pear")
    assert shown == ["Did you say: bring the mug?", ""]


def test_to_end_the_session_is_asked_back_too(talk: Talk) -> None:
    talk.hears("quit")
    assert "Did you say: quit?" in talk.out.getvalue()


@pytest.mark.parametrize("answer", ["yes", "no"])
def test_what_was_said_before_something_was_asked_back_is_no_answer_to_it(
    talk: Talk, answer: str
) -> None:
    talk.time = 10.0
    talk.hears("bring the mug")
    talk.hears(answer, sure=True, began=9.0)
    assert talk.done == []
    talk.hears("yes", sure=True, began=11.0)
    assert talk.done == ["bring the mug"]


def test_a_certain_yes_that_was_said_long_ago_answers_nothing_unasked(talk: Talk) -> None:
    talk.time = 10.0
    talk.hears("yes", sure=True, began=9.0 - FRESH_S)
    assert talk.done == []
    assert "Did you say: yes?" in talk.out.getvalue()


@given(st.text(max_size=60) | st.from_regex(r"(yes|no|bring|the mug|bye|[.,!? ])+", fullmatch=True))
def test_of_what_is_not_certain_nothing_but_a_stop_is_done(text: str) -> None:
    talk = Talk()
    talk.hears(text)
    assert talk.done == ["stop"] * (control(text) is Control.STOP)


@pytest.mark.parametrize("sure", [True, False])
def test_a_stop_stops_however_uncertain_it_is(talk: Talk, sure: bool) -> None:
    talk.hears("bring the mug")
    talk.hears("stop", sure=sure)
    assert talk.done == ["stop"]
    talk.hears("yes", sure=True)
    assert "bring the mug" not in talk.done


def test_what_was_not_understood_is_to_be_said_again(talk: Talk) -> None:
    talk.hears("")
    assert UNCLEAR in talk.out.getvalue()


def test_what_was_heard_is_an_event_with_who_heard_it_and_how_surely(talk: Talk) -> None:
    talk.hears("bring the mug")
    assert talk.inbox.take_all() == (Listened("ears", "bring the mug", 0.5, "asked back"),)
