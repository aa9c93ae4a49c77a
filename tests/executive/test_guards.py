"""Nothing that robot, perception, person or model raise gets through: it is a failure in words."""

from collections.abc import Callable
from typing import Any

import pytest

from executive.errors import ExecutiveError
from executive.events import Ended, Inbox
from executive.guards import (
    LONGEST,
    WHOLE,
    GuardedModel,
    GuardedPerception,
    GuardedRecorder,
    GuardedRobot,
    GuardedUser,
    in_words,
)
from executive.records import Note
from executive.testing.bench import Notebook
from executive.types.dialogue import Question, QuestionKind
from executive.types.goals import DriveTo, Halt, LookAt, PutDown
from executive.types.llm import ChatRequest, RankRequest, Usage
from executive.types.results import Answered, Failed, Replied

ASKED = Question(QuestionKind.WHERE_IS, "mug", "Where is the mug?")
CHAT = ChatRequest("general_pos", ())
RANK = RankRequest("rank", (), (), (), ())


class Broken:
    """Raises whatever it is asked for."""

    def __getattr__(self, name: str) -> Any:
        raise ConnectionError("driver gone")


class HalfBroken(Broken):
    """Opens a request before it raises."""

    def __init__(self, inbox: Inbox, numbers: int = 1) -> None:
        self.inbox = inbox
        self.numbers = numbers
        self.called_off: list[int] = []

    def start(self, goal: object) -> int:
        for _ in range(self.numbers):
            self.inbox.open(real=True)
        raise ConnectionError("driver gone")

    def cancel(self, request: int) -> None:
        self.called_off.append(request)


def ends(inbox: Inbox) -> list[Any]:
    return [event.result for event in inbox.take_all() if isinstance(event, Ended)]


@pytest.fixture
def inbox() -> Inbox:
    return Inbox()


@pytest.fixture
def notebook() -> Notebook:
    return Notebook()


@pytest.mark.parametrize(
    ("guard", "ask", "says"),
    [
        (GuardedRobot, lambda robot: robot.start(DriveTo("desk")), "my base failed"),
        (GuardedRobot, lambda robot: robot.start(LookAt("desk", 0)), "my head failed"),
        (GuardedRobot, lambda robot: robot.start(PutDown("desk")), "my arm failed"),
        (GuardedPerception, lambda perception: perception.see(), "my camera failed"),
        (GuardedUser, lambda user: user.ask(ASKED), "I cannot ask you"),
        (GuardedModel, lambda model: model.chat(CHAT), "my language model failed"),
        (GuardedModel, lambda model: model.rank(RANK), "my language model failed"),
    ],
)
def test_what_raises_when_it_is_asked_is_a_request_that_failed_in_words(
    guard: Callable[..., Any],
    ask: Callable[[Any], int],
    says: str,
    inbox: Inbox,
    notebook: Notebook,
) -> None:
    request = ask(guard(Broken(), inbox, notebook))
    (event,) = inbox.take_all()
    assert isinstance(event, Ended)
    assert event.request == request
    assert event.result == Failed(f"{says}: ConnectionError: driver gone")
    assert "Traceback" in notebook.all(Note)[0].text
    assert not inbox.awaits_anything


@pytest.mark.parametrize("guard", [GuardedRobot, GuardedPerception, GuardedUser, GuardedModel])
def test_what_raises_when_it_is_called_off_is_called_off_all_the_same(
    guard: Callable[..., Any], inbox: Inbox, notebook: Notebook
) -> None:
    request = inbox.open(real=True)
    guard(Broken(), inbox, notebook).cancel(request)
    assert not inbox.awaits_anything
    assert notebook.all(Note)[0].level == "error"


def test_a_request_that_was_half_started_is_called_off_and_keeps_its_number(
    inbox: Inbox, notebook: Notebook
) -> None:
    robot = HalfBroken(inbox)
    assert GuardedRobot(robot, inbox, notebook).start(Halt()) == 1
    assert robot.called_off == [1]
    assert isinstance(ends(inbox)[0], Failed)
    assert inbox.last == 1


def test_no_request_is_left_of_several_half_started(inbox: Inbox, notebook: Notebook) -> None:
    GuardedRobot(HalfBroken(inbox, numbers=3), inbox, notebook).start(Halt())  # type: ignore[arg-type]
    assert len(ends(inbox)) == 1
    assert not inbox.awaits_anything


@pytest.mark.parametrize("number", [None, 7, "one", [1]])
def test_what_gives_no_number_of_a_request_has_failed(
    number: object, inbox: Inbox, notebook: Notebook
) -> None:
    class Vague(Broken):
        def see(self) -> Any:
            return number

    request = GuardedPerception(Vague(), inbox, notebook).see()
    assert inbox.is_open(request)
    assert ends(inbox)[0].reason.startswith("my camera failed: TypeError: ")


def test_what_only_tells_something_is_missed_by_nobody(inbox: Inbox, notebook: Notebook) -> None:
    robot, model = (guard(Broken(), inbox, notebook) for guard in (GuardedRobot, GuardedModel))
    GuardedUser(Broken(), inbox, notebook).tell("Here is the mug.")
    model.prepare(CHAT)
    model.close()
    assert (robot.holding, robot.views("desk")) == (None, 1)
    assert (model.can_rank, model.context_tokens, model.count_tokens("äh")) == (False, 0, 3)
    assert len(notebook.all(Note)) == 8


def test_a_signal_gets_through(inbox: Inbox, notebook: Notebook) -> None:
    class Interrupted:
        def tell(self, text: str) -> None:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        GuardedUser(Interrupted(), inbox, notebook).tell("Hello")  # type: ignore[arg-type]


def test_a_recorder_that_raises_costs_a_record(notebook: Notebook) -> None:
    GuardedRecorder(Broken()).record(Note("info", "lost"))


class Unspeakable(Exception):
    def __str__(self) -> str:
        raise RuntimeError


@pytest.mark.parametrize(
    ("error", "words"),
    [
        (ConnectionError("driver gone"), "ConnectionError: driver gone"),
        (ExecutiveError("the model file is broken"), "the model file is broken"),
        (KeyError(), "KeyError"),
        (OSError(" "), "OSError"),
        (Unspeakable(), "Unspeakable"),
        (ValueError("\x1b[2J\n\ud800"), r"ValueError: \x1b[2J\n\ud800"),
    ],
)
def test_an_exception_is_a_clause_on_one_line(error: Exception, words: str) -> None:
    assert in_words(error) == words


def test_a_long_story_is_cut() -> None:
    assert len(in_words(ValueError("x" * 3000))) == LONGEST


def test_a_sentence_of_ours_is_told_to_its_end() -> None:
    told = f"{'it is wrong, ' * 20}write it so"
    assert in_words(ExecutiveError(told)) == told
    assert len(in_words(ExecutiveError("x" * 3000))) == WHOLE


@pytest.mark.parametrize("result", [None, "done", 3, Exception("no")])
def test_an_end_that_is_no_result_is_a_failure(result: Any, inbox: Inbox) -> None:
    inbox.end(inbox.open(), result)
    assert "which is no result" in ends(inbox)[0].reason


@pytest.mark.parametrize(
    "result",
    [Failed("\ud800"), Answered("\ud800"), Replied(CHAT, "\ud800", Usage())],
)
def test_texts_that_no_log_could_hold_are_made_fit(result: Any, inbox: Inbox) -> None:
    inbox.end(inbox.open(), result)
    (end,) = ends(inbox)
    assert (getattr(end, "reason", "") or getattr(end, "text", "")) == "\N{REPLACEMENT CHARACTER}"
