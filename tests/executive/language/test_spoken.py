"""What "it", "there", "another" and "again" stand for, by what was spoken of before."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from executive.language.grammar import EnglishInterpreter
from executive.language.meaning import Request, Task
from executive.language.pronouns import resolved
from executive.language.spoken import NOTHING, Spoken, after
from executive.types.commands import CommandKind

read = EnglishInterpreter()
FRUIT = Spoken(("apple", "pear"), "fruit", "coffee_table")


def command(words: str, spoken: Spoken = FRUIT, *, holds: bool = False) -> str:
    """The command in a line."""
    [[made]] = read.commands(words, spoken, holds=holds)
    places = (made.source and f"from {made.source}", made.goal and f"to {made.goal}")
    names = (made.kind.replace("_", " "), made.target, *places)
    return " ".join(filter(None, names)) + "".join(f", not {one}" for one in made.exceptions)


@pytest.mark.parametrize(
    ("words", "meant"),
    [
        ("Bring it", "bring pear"),
        ("Give me that one", "bring pear"),
        ("Bring another one", "bring fruit, not apple, not pear"),
        ("Bring another pear", "bring pear, not apple, not pear"),
        ("Take the mug from there", "take mug from coffee_table"),
        ("Put the mug there", "put mug to coffee_table"),
        ("Put it on the desk", "put pear to desk"),
        ("Put it back", "put back pear"),
        ("Go there", "go to coffee_table"),
        ("Find the mug and bring it", "bring mug"),
    ],
)
def test_a_word_stands_for_what_was_spoken_of_last(words: str, meant: str) -> None:
    assert command(words) == meant


@pytest.mark.parametrize("words", ["Put it on the desk", "Put it down"])
def test_what_is_in_the_hand_is_what_is_put_somewhere(words: str) -> None:
    assert command(words, holds=True).split(" to ")[0].endswith("it")


@pytest.mark.parametrize(
    ("words", "goal"),
    [
        ("Put the mug on the desk, then put the hammer there", "desk"),
        ("Put the mug down and put the hammer next to it", "next to mug"),
    ],
)
def test_what_was_named_in_the_same_breath_comes_first(words: str, goal: str) -> None:
    [*_, [last]] = read.commands(words, FRUIT)
    assert (last.target, last.goal) == ("hammer", goal)


def test_them_are_all_that_were_spoken_of() -> None:
    said = resolved(read.read("Bring them"), FRUIT)
    assert isinstance(said, Request)
    assert said.tasks[0].things
    assert [thing.words for thing in said.tasks[0].things.members] == ["apple", "pear"]


def test_again_is_what_was_asked_for_last_with_its_names() -> None:
    bring = resolved(read.read("Bring it"), FRUIT)
    spoken = after(bring, FRUIT, things=("pear",))
    assert command("Do that again", spoken) == "bring pear"


@pytest.mark.parametrize("words", ["Again", "Bring another one", "Put the mug there"])
def test_nothing_is_guessed_if_nothing_was_spoken_of(words: str) -> None:
    assert read.remark(words) or command(words, NOTHING) == words.lower()


names = st.text(min_size=1, max_size=8)


@given(st.builds(Spoken, st.lists(names, max_size=3).map(tuple), names, names))
def test_a_recording_keeps_all_of_it(spoken: Spoken) -> None:
    words = after(read.read("If there is an apple on the desk, bring it, otherwise a pear"), spoken)
    assert Spoken.from_json(words.to_json()) == words


def test_a_recording_from_before_may_keep_more_than_is_kept_today() -> None:
    before = '{"called":"mug","request":{"tasks":[{"verb":"bring"}],"too":true}}'
    assert Spoken.from_json(before).request == Request((Task(CommandKind.BRING),))


@pytest.mark.parametrize(
    ("words", "target"),
    [
        ("Take the mug if it is on the desk", "mug"),
        ("If there is a mug on the desk, bring it", "mug"),
        ("Is the mug on the desk? If so, bring it", "mug"),
        ("Is there a mug on the desk? If so, bring me one", "mug"),
    ],
)
def test_it_in_a_condition_is_what_the_same_sentence_names(words: str, target: str) -> None:
    [[made]] = read.commands(words, FRUIT)
    assert made.target == target
    assert not made.sought or made.sought.target == target


def asked_before(words: str) -> Spoken:
    return after(read.read(words), NOTHING)


def test_if_so_is_about_the_question_before() -> None:
    [[made]] = read.commands("If so, bring me one", asked_before("Is there a mug on the desk?"))
    assert (made.kind, made.target, made.conditional) == ("bring", "mug", True)
    assert made.sought
    assert made.sought.source == "desk"


def test_if_not_is_about_the_question_before() -> None:
    [[made]] = read.commands("If not, bring the pear", asked_before("Is the mug on the desk?"))
    assert (made.kind, made.target) == ("check", "mug")
    assert made.unless
    assert made.unless.target == "pear"


def test_if_so_after_no_question_is_not_done() -> None:
    assert not read.commands("If so, bring me one", FRUIT)
    assert "depends" in read.remark("If so, bring me one", FRUIT)


@pytest.mark.parametrize("words", ["No, five", "I mean five", "Make it five"])
def test_another_number_is_of_the_same_things(words: str) -> None:
    [[made]] = read.commands(words, asked_before("Bring two tools"))
    assert (made.kind, made.target, made.number) == ("bring", "tools", 5)


def test_what_was_brought_and_is_to_go_elsewhere_is_put_there() -> None:
    [[made]] = read.commands("No, to the kitchen", asked_before("Bring the mug"))
    assert (made.kind, made.target, made.goal) == ("put", "mug", "kitchen")


@pytest.mark.parametrize(
    ("asked", "then", "meant"),
    [
        ("What is on the desk?", "Bring the mug from there", "bring mug from desk"),
        ("Is there an apple?", "Bring it", "bring apple"),
        ("Is the mug on the desk?", "Bring it", "bring mug"),
        ("How many tools are there?", "Bring one", "bring tools"),
    ],
)
def test_what_was_asked_about_is_what_was_spoken_of(asked: str, then: str, meant: str) -> None:
    assert command(then, asked_before(asked)) == meant


@pytest.mark.parametrize(
    "words",
    [
        "Find the mug and the apple and put one on the desk and the other on the sofa",
        "Bring the mug and the apple, then put the apple on the desk and the other one on the sofa",
    ],
)
def test_the_other_of_two_is_that_which_was_not_named_since(words: str) -> None:
    [*_, apple, mug] = [one for group in read.commands(words) for one in group]
    assert (apple.target, apple.goal, mug.target, mug.goal) == ("apple", "desk", "mug", "sofa")


def test_things_with_a_then_between_them_are_in_order_and_others_in_any() -> None:
    assert len(read.commands("Bring the hammer, then the apple, then the mug")) == 3
    assert len(read.commands("Bring the hammer, the apple and the mug")) == 1


def test_both_of_one_that_was_spoken_of_are_two() -> None:
    [[both]] = read.commands("Bring both", Spoken(("pear",), "pear"))
    assert (both.target, both.number) == ("pear", 2)
