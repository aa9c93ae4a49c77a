"""The contract of every User. An adapter's tests subclass `UserContract`.

Provide a fixture `user_bench` that yields a fresh `UserBench`.
"""

from collections.abc import Callable
from dataclasses import dataclass

import pytest

from executive.events import Ended, Event, Inbox, StopRequested
from executive.interfaces.dialogue import User
from executive.testing.contracts.requests import is_silent, next_event
from executive.types.dialogue import Question, QuestionKind
from executive.types.results import Answered, Failed

WHERE = Question(QuestionKind.WHERE_IS, "mug", "Where is the mug?")
QUESTIONS = (
    WHERE,
    Question(QuestionKind.WHICH_OBJECT, "fruit", "Which fruit?", ("apple", "pear")),
    Question(QuestionKind.CONFIRM, "mug", "Do you mean the mug?", ("mug",)),
    Question(QuestionKind.WHERE_TO_PUT, "mug", "Where shall I put the mug?"),
)
ODD = ("", "\x1b[2J\r\n", "\udcff \N{SNOWMAN}", "word " * 5000)


def _own_choice(words: str) -> None:
    """Do nothing: the user chooses the answer."""


@dataclass
class UserBench:
    """A user, and the inbox where questions end.

    Attributes:
        user: the user under test.
        inbox: the inbox of the user.
        will_say: sets the next answer, for users with a script.
        says: gives the answer now, for users who listen to a person.
    """

    user: User
    inbox: Inbox
    will_say: Callable[[str], None] = _own_choice
    says: Callable[[str], None] = _own_choice

    @property
    def repeats(self) -> bool:
        """Whether the test can choose the answer: the user follows a script, or a person."""
        return self.will_say is not _own_choice or self.says is not _own_choice

    def ask(self, question: Question, answer: str = "on the desk") -> Event | None:
        """Ask a question, give this answer, and wait for the event."""
        self.will_say(answer)
        self.user.ask(question)
        self.says(answer)
        return next_event(self.inbox)


class UserContract:
    """Each method tests one requirement of `User`."""

    @pytest.mark.parametrize("question", QUESTIONS, ids=lambda question: question.kind)
    def test_a_question_of_any_kind_is_answered_or_fails_in_words(
        self, user_bench: UserBench, question: Question
    ) -> None:
        event = user_bench.ask(question)
        assert isinstance(event, Ended)
        match event.result:
            case Answered(text):
                assert text == "on the desk" or not user_bench.repeats
            case Failed(reason):
                assert reason
                assert not user_bench.repeats
            case other:
                raise AssertionError(f"{other} is no answer")

    def test_every_question_has_its_own_number_and_ends_once(self, user_bench: UserBench) -> None:
        first, second = user_bench.ask(WHERE), user_bench.ask(WHERE)
        assert isinstance(first, Ended)
        assert isinstance(second, Ended)
        assert first.request != second.request
        assert is_silent(user_bench.inbox)

    def test_an_answer_that_says_stop_is_a_stop(self, user_bench: UserBench) -> None:
        event = user_bench.ask(WHERE, "stop")
        assert isinstance(event, StopRequested) or not user_bench.repeats

    def test_a_withdrawn_question_gets_no_answer(self, user_bench: UserBench) -> None:
        user_bench.will_say("on the bed")
        user_bench.user.cancel(user_bench.user.ask(WHERE))
        assert is_silent(user_bench.inbox)
        event = user_bench.ask(WHERE)
        assert isinstance(event, Ended)
        assert event.result == Answered("on the desk") or not user_bench.repeats

    def test_withdrawing_what_has_ended_or_never_was_does_nothing(
        self, user_bench: UserBench
    ) -> None:
        event = user_bench.ask(WHERE)
        assert isinstance(event, Ended)
        user_bench.user.cancel(event.request)
        user_bench.user.cancel(event.request + 1000)
        assert isinstance(user_bench.ask(WHERE), Ended)

    def test_what_is_told_needs_no_answer(self, user_bench: UserBench) -> None:
        user_bench.user.tell("I bring the mug.")
        assert is_silent(user_bench.inbox)

    @pytest.mark.parametrize("text", ODD, ids=["empty", "control", "no text", "long"])
    def test_no_text_is_too_odd_to_be_said(self, user_bench: UserBench, text: str) -> None:
        user_bench.user.tell(text)
        question = Question(QuestionKind.WHERE_IS, text, text, (text,))
        assert isinstance(user_bench.ask(question), Ended)
