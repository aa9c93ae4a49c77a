"""What tells the robot to stop, and what only sounds like it."""

import time
from collections.abc import Callable

import pytest
from hypothesis import given
from hypothesis import strategies as st

from executive.events import THE_PERSON, Ended, Inbox, StopRequested
from executive.language.control import Control, control
from executive.language.grammar import EnglishInterpreter
from executive.text import LONGEST, one_line, printable, too_long
from executive.types.results import Answered

PLAIN = ("stop", "halt", "cancel", "abort", "freeze", "wait", "pause", "don't move", "hold it")
MORE = (
    *("emergency stop", "stop it now", "stop right there", "cancel that", "abort mission"),
    *("wait a moment", "hold on", "hang on a second", "never mind", "that's enough", "e-stop"),
    *("I said stop", "I want you to stop", "make it stop", "could you please stop driving?"),
    *("no, stop!", "no no wait", "Bring me the mug. Stop!", "take the mug, no stop"),
    *("you are hitting the cat stop", "stopit", "stooooop", "stpo", "S T O P", "s.t.o.p", "st op"),
    *("\uff33\uff34\uff2f\uff30\uff01", "stóp", "s\u200btop", "\u202estop", "¡stop!", "«halt»"),
    *("\x1b[Astop", "\x1b[200~stop\x1b[201~", "\x1bstop", "don’t move", "停止！", "Arrêtez !"),
    *("Find the mug - stop", "Find the mug \N{EN DASH} stop!", "Find the mug \N{EM DASH}halt"),
    *("Find the mug... stop", "Find the mug \u2026 stop", "Find the mug (stop)"),
    *("Bring the apple STOP", "Bring the apple stop stop", "Find the mug / stop", "s_t_o_p"),
    *("Find the mug, no, wait", "It's OK, that will do", "Find the mug [halt]", "不要动"),
    *("why aren't you stopping?", "Why are you not stopping", "why didn't you stop"),
    *("canel", "cancl", "abrt", "st0p", "5T0P!", "c4ncel", "stoppe", "Stoppen!", "aborting"),
    *("I changed my mind", "Actually, I've changed my mind", "I don't want it anymore"),
    *("I changed my mind about that", "I changed my mind, bring the mug, no, stop"),
    *("Forget the whole thing", "forget about the mission", "Forget it"),
    *(
        "I changed my mind, leave it",
        "Forget the pear and stop",
        "forget the pear stop",
        "never mind that",
    ),
    *("I don't need the mug any more", "that will do", "That'll do.", "thatll do"),
    *("no no no", "No, no, no!", "nonono", "I can't wait, stop", "I can't, wait!"),
    *(
        "¡Para!",
        "pare",
        "Ferma!",
        "hör auf",
        "хватит",
        "Стоп!",
        "やめて",
        "止まってください",
        "멈춰요",
    ),
)
NEVER = (
    *("Bring me the doorstop", "Find the stop sign", "Bring me the door stop, please"),
    *("Hold the mug", "hold on to the mug", "Hang on to the mug", "Get hold of the mug"),
    *("don't stop", "Do not stop!", "Why did you stop?", "Where is the bus stop?", "the door stop"),
    *("at the bus stop", "stop_sign", "freezer", "in the freezer", "the stopwatch", "nonstop"),
    *(
        "top",
        "post",
        "spot",
        "step",
        "the hall",
        "end table",
        "yes",
        "no",
        "I don't know",
        "nothing",
    ),
    *("Don't bring me the apple", "Put that down", "the second", "any", "", "?", "..."),
    *("I can't wait, bring the apple", "I cannot wait to see the mug", "Bring the stop sign"),
    *("BRING ME THE DOOR STOP", "Bring the STOP sign", 'the "stop" sign'),
    *("I changed my mind, bring the mug", "I've changed my mind. Put it on the desk, please"),
    *("Forget the pear", "Oh, forget about my hammer", "Never mind the pear, bring the mug"),
    *("no no", "no no, the mug", "the t-shirt by the bus-stop", "topping", "shopping", "about"),
    *("shelf_4", "shelf 1a", "Bring the mug - the red one", "Find the stop-sign"),
)

politeness = st.sampled_from(["", "please ", "hey robot, ", "OK ", "Oh no! ", "could you ", "and "])
endings = st.sampled_from(
    ["", "!", ".", "!!!", " please", ", please.", " now", " !", "\u2026", "\uff01"]
)
letters = st.sampled_from([str.lower, str.upper, str.title, str.swapcase])


@given(politeness, st.sampled_from(PLAIN), endings, letters)
def test_a_stop_is_heard_in_any_case_punctuation_and_politeness(
    before: str, word: str, after: str, spelled: Callable[[str], str]
) -> None:
    assert control(spelled(before + word + after)) is Control.STOP


@given(st.sampled_from(["stop", "halt", "cancel", "abort", "freeze", "wait"]), st.text(max_size=30))
def test_a_line_that_begins_with_stop_is_one_whatever_follows(word: str, rest: str) -> None:
    assert control(f"{word} {rest}") is Control.STOP


@pytest.mark.parametrize("words", MORE)
def test_a_stop_is_heard_with_slips_and_in_the_middle(words: str) -> None:
    assert control(words) is Control.STOP


@pytest.mark.parametrize("words", NEVER)
def test_names_answers_and_plain_commands_are_no_stop(words: str) -> None:
    assert control(words) is None


@pytest.mark.parametrize(
    "verb", ["find", "look for", "i can't find", "take", "hold on to", "bring", "i'd like", "give"]
)
@pytest.mark.parametrize("thing", ["the door stop", "a stop sign", "the emergency stop, please"])
def test_a_command_about_a_thing_that_is_called_stop_is_a_command(verb: str, thing: str) -> None:
    assert control(f"{verb} {thing}") is None


@pytest.mark.parametrize(
    "words", ["quit", "Exit!", "bye", "please quit now", "OK, bye bye", "quit()"]
)
def test_the_session_is_ended_by_its_own_words(words: str) -> None:
    assert control(words) is Control.QUIT


def test_an_answer_that_says_stop_is_a_stop_whoever_was_asked() -> None:
    inbox = Inbox()
    inbox.end(inbox.open(), Answered("Please stop."))
    assert inbox.take_all() == (StopRequested(THE_PERSON),)


def test_any_other_answer_is_an_answer() -> None:
    inbox = Inbox()
    inbox.end(inbox.open(), Answered("at the bus stop"))
    [event] = inbox.take_all()
    assert isinstance(event, Ended)


# --- reading takes no longer than it takes to be read ---

NASTY = ("!", ",;", "a ", "please ", "find x please ", "hold a ", "no ", "_a", "a'", "\u0301", "ﷺ")
READERS = (
    control,
    EnglishInterpreter().command,
    EnglishInterpreter().declines,
    EnglishInterpreter().agrees,
    EnglishInterpreter().remark,
    EnglishInterpreter().without_slips,
    one_line,
    too_long,
)


@pytest.mark.parametrize("piece", NASTY, ids=ascii)
@pytest.mark.parametrize("reader", READERS, ids=lambda reader: reader.__name__)
def test_the_longest_line_is_read_in_no_time(reader, piece: str) -> None:
    line = f"find {piece * LONGEST}"[:LONGEST]
    took_s = []
    for _ in range(5):
        began = time.thread_time()
        reader(line)
        took_s.append(time.thread_time() - began)
    assert min(took_s) < 0.02


@given(st.text(max_size=2 * LONGEST))
def test_no_line_is_too_strange_to_be_read(line: str) -> None:
    for reader in READERS:
        reader(line)
    assert one_line(line).isprintable() == all(map(str.isprintable, one_line(line)))
    assert "\n" not in one_line(line)
    assert "\x1b" not in one_line(line) + printable(line)


@pytest.mark.parametrize("words", ["x" * (LONGEST + 1), "ﷺ" * 100])
def test_what_is_too_long_is_no_command(words: str) -> None:
    assert too_long(words)
    assert EnglishInterpreter().command(f"find {words}") is None
