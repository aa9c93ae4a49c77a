"""The person at the console, and who stands in for one."""

import io
from collections.abc import Callable

import pytest
from patience import PATIENCE_S

from executive.events import Ended, Event, Inbox, StopRequested
from executive.types.dialogue import Question, QuestionKind
from executive.types.results import Answered, Failed
from executive.user import Console, Nobody, Oracle

WHERE = Question(QuestionKind.WHERE_IS, "mug", "Where is the mug?")
WHICH = Question(QuestionKind.WHICH_OBJECT, "fruit", "Which fruit?", ("apple", "pear", "kiwi"))


def asked(make: Callable[[Inbox], Console | Oracle | Nobody], question: Question) -> Event:
    inbox = Inbox()
    user = make(inbox)
    user.ask(question)
    assert inbox.wait(PATIENCE_S)
    [event] = inbox.take_all()
    return event


def result(event: Event) -> object:
    assert isinstance(event, Ended)
    return event.result


def console(text: str) -> Callable[[Inbox], Console]:
    return lambda inbox: Console(inbox, io.StringIO(text), io.StringIO())


def test_the_next_line_is_the_answer() -> None:
    assert result(asked(console("\n on the desk \nmore\n"), WHERE)) == Answered("on the desk")


def test_bytes_that_are_no_text_can_be_written_down() -> None:
    assert result(asked(console("\udcff desk\n"), WHERE)) == Answered(
        "\N{REPLACEMENT CHARACTER} desk"
    )


def test_the_end_of_input_is_no_answer() -> None:
    assert result(asked(console(""), WHERE)) == Failed("the input has ended")


def test_stop_is_heard_without_a_question() -> None:
    inbox = Inbox()
    Console(inbox, io.StringIO("Stop\n"), io.StringIO())
    assert inbox.wait(PATIENCE_S)
    assert inbox.take_all() == (StopRequested("the person"),)


def test_lines_typed_ahead_are_kept_in_order() -> None:
    inbox = Inbox()
    user = Console(inbox, io.StringIO("one\ntwo\n"), io.StringIO())
    for expected in ("one", "two"):
        user.listen()
        assert inbox.wait(PATIENCE_S)
        [event] = inbox.take_all()
        assert result(event) == Answered(expected)


def test_the_oracle_tells_the_truth() -> None:
    places = {"mug": "desk", "pear": "sofa"}
    assert result(asked(lambda i: Oracle(i, places.get), WHERE)) == Answered("desk")


def test_the_oracle_means_a_thing_that_is_there() -> None:
    places = {"mug": "desk", "pear": "sofa"}
    assert result(asked(lambda i: Oracle(i, places.get), WHICH)) == Answered("pear")


@pytest.mark.parametrize(("options", "answer"), [(("apple", "pear"), "yes"), (("kiwi",), "no")])
def test_the_oracle_agrees_to_what_is_there(options: tuple[str, ...], answer: str) -> None:
    places = {"mug": "desk", "pear": "sofa"}
    question = Question(QuestionKind.CONFIRM, "it", "Do you mean it?", options)
    assert result(asked(lambda i: Oracle(i, places.get), question)) == Answered(answer)


def test_the_oracle_does_not_invent() -> None:
    answer = result(asked(lambda i: Oracle(i, lambda name: None), WHERE))
    assert answer == Answered("I don't know")


def test_nobody_cannot_be_asked() -> None:
    assert result(asked(Nobody, WHERE)) == Failed("there is nobody to ask")
