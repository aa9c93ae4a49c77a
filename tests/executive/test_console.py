"""A person at a terminal: stops, answers, and what is said while nobody asks."""

import io
import itertools
import queue
import sys
import time
from collections.abc import Iterator

import pytest
from patience import PATIENCE_S

from executive.config import Settings
from executive.events import THE_PERSON, Ended, Event, Heard, Inbox, StopRequested
from executive.language.commands import NOT_KEPT, WILL_NOT
from executive.text import LONGEST
from executive.types.dialogue import Question, QuestionKind
from executive.types.outcome import MissionStatus, Outcome
from executive.types.results import Answered, Failed
from executive.user import FORGOTTEN, MOST_LINES, NOTHING_TO_STOP, STOPPING, Console

WHERE = Question(QuestionKind.WHERE_IS, "mug", "Where is the mug?")
TOO_LONG = "Sorry: what you said is too long, I read at most 1,000 characters."


class Keyboard(io.StringIO):
    """A terminal, of which a line is read when it was typed."""

    def __init__(self) -> None:
        super().__init__()
        self._lines: queue.SimpleQueue[str] = queue.SimpleQueue()

    def type(self, line: str) -> None:
        self._lines.put(f"{line}\n" if line else "")

    def readline(self, size: int | None = -1) -> str:  # type: ignore[override]
        return self._lines.get()

    def isatty(self) -> bool:
        return True


class Screen(io.StringIO):
    """What was printed, a line at a time."""

    def __init__(self) -> None:
        super().__init__()
        self.lines: queue.SimpleQueue[str] = queue.SimpleQueue()

    def write(self, text: str) -> int:
        if text.strip():
            self.lines.put(text)
        return len(text)

    def next(self) -> str:
        return self.lines.get(timeout=PATIENCE_S)


class Person:
    def __init__(self) -> None:
        self.inbox, self.keys, self.screen = Inbox(), Keyboard(), Screen()
        self.console = Console(self.inbox, self.keys, self.screen)

    def hears(self, line: str, reply: str) -> None:
        self.keys.type(line)
        assert self.screen.next() == reply

    def events(self) -> tuple[Event, ...]:
        self.inbox.wait(PATIENCE_S)
        return self.inbox.take_all()

    def is_asked(self) -> None:
        self.console.ask(WHERE)
        assert self.screen.next() == WHERE.text

    def result(self) -> object:
        [event] = self.events()
        assert isinstance(event, Ended)
        return event.result


@pytest.fixture
def person() -> Iterator[Person]:
    person = Person()
    yield person
    person.keys.type("")


def test_a_stop_is_answered_at_once_while_the_robot_drives(person: Person) -> None:
    person.console.tell("I look for the mug.")
    person.screen.next()
    person.hears("Please, stop!", STOPPING)
    assert person.events() == (StopRequested(THE_PERSON),)


def test_a_stop_instead_of_an_answer_stops(person: Person) -> None:
    person.is_asked()
    person.hears("cancel that", STOPPING)
    assert person.events() == (StopRequested(THE_PERSON),)


def test_what_is_typed_while_nobody_asks_is_heard_and_answers_no_later_question(
    person: Person,
) -> None:
    person.console.tell("I look for the mug.")
    person.screen.next()
    person.keys.type("the banana")
    assert person.events() == (Heard("the banana"),)
    person.is_asked()
    person.keys.type("on the desk")
    assert person.result() == Answered("on the desk")


def test_a_command_may_be_typed_before_the_prompt_is_there(person: Person) -> None:
    person.keys.type("Find the mug")
    person.console.listen()
    assert person.result() == Answered("Find the mug")


def test_what_was_typed_before_the_first_question_does_not_answer_it(person: Person) -> None:
    person.keys.type("yes")
    person.hears("!" * (LONGEST + 1), TOO_LONG)  # so the line before it was read
    person.is_asked()
    person.keys.type("on the desk")
    assert person.result() == Answered("on the desk")


def test_too_long_an_answer_is_refused_and_the_question_stays(person: Person) -> None:
    person.is_asked()
    person.hears("x" * 20_000, TOO_LONG)
    person.hears("  ".join("x" * LONGEST), TOO_LONG)
    person.keys.type("on the desk")
    assert person.result() == Answered("on the desk")


def test_at_the_prompt_there_is_nothing_to_stop(person: Person) -> None:
    request = person.console.listen()
    person.hears("STOP", NOTHING_TO_STOP)
    assert person.inbox.is_open(request)
    assert not person.inbox.has_events


@pytest.mark.parametrize("words", ["Don't go into the bedroom", "Stay out of the kitchen"])
def test_at_the_prompt_what_is_never_to_be_done_is_not_promised(person: Person, words: str) -> None:
    person.console.listen()
    person.hears(words, f"{WILL_NOT}{NOT_KEPT}")
    assert not person.inbox.has_events


@pytest.mark.parametrize("words", ["Don't move", "forget it", "Do not!"])
def test_at_the_prompt_a_stop_in_other_words_is_one(person: Person, words: str) -> None:
    person.console.listen()
    person.hears(words, NOTHING_TO_STOP)


def test_quit_at_the_prompt_ends_the_session(person: Person) -> None:
    person.console.listen()
    person.keys.type("quit")
    assert isinstance(person.result(), Failed)


def test_quit_while_the_robot_drives_stops_it_and_ends_the_session(person: Person) -> None:
    person.console.tell("I look for the mug.")
    person.screen.next()
    person.hears("exit!", STOPPING)
    assert person.events() == (StopRequested(THE_PERSON),)
    person.console.listen()
    assert isinstance(person.result(), Failed)


def test_what_a_key_sends_beside_letters_is_not_kept(person: Person) -> None:
    person.is_asked()
    person.keys.type("\x1b[Aon the\x07 \u202edesk")
    assert person.result() == Answered("on the desk")


# --- not a terminal, but a script ---


def test_a_script_is_kept_in_order_and_a_stop_in_it_forgets_what_waits() -> None:
    inbox, screen = Inbox(), Screen()
    Console(inbox, io.StringIO("Find the mug\non the desk\nstop\n"), screen)
    assert screen.next() == f"{STOPPING} {FORGOTTEN}"
    assert inbox.take_all() == (StopRequested(THE_PERSON),)


def test_quit_in_a_script_is_its_end() -> None:
    inbox = Inbox()
    console = Console(inbox, io.StringIO("Find the mug\nquit\nFind the apple\n"), Screen())
    for expected in (Answered("Find the mug"), Failed("the session was ended")):
        console.listen()
        assert inbox.wait(PATIENCE_S)
        [event] = inbox.take_all()
        assert isinstance(event, Ended)
        assert event.result == expected


def test_bytes_that_are_no_text_do_not_end_the_hearing() -> None:
    inbox = Inbox()
    source = io.TextIOWrapper(io.BytesIO(b"\xff\xfe\nplease stop\n"), encoding="utf-8")
    Console(inbox, source, Screen())
    assert inbox.wait(PATIENCE_S)
    assert StopRequested(THE_PERSON) in inbox.take_all()


def test_a_script_without_end_is_not_read_to_its_end() -> None:
    endless = itertools.repeat("y\n")
    source = io.StringIO()
    source.readline = lambda size=-1: next(endless)  # type: ignore[method-assign,assignment]
    console = Console(Inbox(), source, Screen())
    time.sleep(0.2)
    assert len(console._lines) <= MOST_LINES


class Broken(io.StringIO):
    """A terminal that is gone."""

    def readline(self, size: int | None = -1) -> str:  # type: ignore[override]
        raise OSError(5, "Input/output error")

    def write(self, text: str) -> int:
        raise OSError(5, "Input/output error")


def test_a_terminal_that_is_gone_is_nobody_and_no_error() -> None:
    inbox = Inbox()
    console = Console(inbox, Broken(), Broken())
    console.tell("I look for the mug.")
    console.ask(WHERE)
    assert inbox.wait(PATIENCE_S)
    [event] = inbox.take_all()
    assert isinstance(event, Ended)
    assert event.result == Failed("the input has ended")


def test_without_standard_input_nobody_is_there(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "stdin", None)
    monkeypatch.setattr(sys, "stderr", None)
    inbox = Inbox()
    Console(inbox).ask(WHERE)
    [event] = inbox.take_all()
    assert isinstance(event, Ended)
    assert event.result == Failed("there is nobody to ask")


# --- in a session ---


def run(words: str) -> Outcome:
    from executive.app.session import Session

    settings = Settings(world="fake", llm="none", user="none")
    session = Session(settings, recorded=False, out=io.StringIO())
    try:
        return session.run(words)
    finally:
        session.close()


def test_words_that_say_stop_are_a_mission_that_is_over() -> None:
    outcome = run("please stop")
    assert (outcome.status, outcome.visited) == (MissionStatus.STOPPED, ())


def test_words_that_are_too_long_are_not_understood_at_once() -> None:
    outcome = run("!" * 20_000)
    assert outcome.status == MissionStatus.NOT_UNDERSTOOD
    assert "too long" in outcome.reason


def test_a_command_on_two_lines_is_one_command() -> None:
    outcome = run("Find\n\x1b[31mthe\u202e mug")
    assert (outcome.command, outcome.target) == ("Find the mug", "mug")
