"""A negation never becomes a deed, whoever reads it."""

import random
from itertools import product

import pytest
from hypothesis import given
from hypothesis import strategies as st

from executive.language.grammar import EnglishInterpreter

DEEDS = ("bring me", "take", "find", "touch", "put down", "fetch", "pick up", "move", "go near")
THINGS = ("the hammer", "a mug", "my scissors", "any fruit", "the sugar_box", "it", "two apples")
FORMS = (
    "don't {deed} {thing}",
    "dont {deed} {thing}",
    "DO NOT {deed} {thing}!",
    "do_not_{deed}_{thing}",
    "never {deed} {thing}, please",
    "please don’t {deed} {thing} from the desk",
    "robot, do not {deed} {thing}, and bring the apple",
    "no, don't {deed} {thing}",
    "okay, don't {deed} {thing}",
    "do not not {deed} {thing}",
    "never don't {deed} {thing}",
    "could you please not {deed} {thing}",
    "you must not {deed} {thing}",
    "you aren't allowed to {deed} {thing}",
    "I don't want you to {deed} {thing}",
    "I'd rather you didn't {deed} {thing}",
    "I told you not to {deed} {thing}",
    "rather not {deed} {thing}",
    "better not {deed} {thing}",
    "no need to {deed} {thing}",
    "under no circumstances {deed} {thing}",
    "if you can, don't {deed} {thing}",
    "bring the mug without {thing}",
    "leave {thing} alone",
    "leave {thing} where it is",
    "let {thing} be",
    "hands off {thing}",
    "hold off from {thing}",
    "keep away from {thing}",
    "refrain from taking {thing}",
    "forget about {thing}",
    "cancel {thing}",
    "I no longer need {thing}",
    "I don't need {thing} any more",
    "no {thing}",
    "not {thing}",
    "nobody wants {thing}",
    "take not {thing}",
    "{deed} {thing}, or rather not",
    "{deed} {thing} - no, don't",
    "{deed} {thing}? no",
    "do n't {deed} {thing}",
    "don t {deed} {thing}",
    "don´t {deed} {thing}",
    'don"t {deed} {thing}',
    "you mustnt {deed} {thing}",
    "you aint to {deed} {thing}",
    "donot {deed} {thing}",
    "dnt {deed} {thing}",
    "nevr {deed} {thing}",
    "d o n o t {deed} {thing}",
    "do ｎｏｔ {deed} {thing}",
    "quit holding {thing}",
    "cease to {deed} {thing}",
    "it is wrong to {deed} {thing}",
    "steer clear of {thing}",
    "let {thing} lie",
    "{thing} may stay where it is",
)
EVERY = [f.format(deed=d, thing=t) for f, d, t in product(FORMS, DEEDS, THINGS)]
read = EnglishInterpreter()


@pytest.mark.parametrize("words", random.Random(14).sample(EVERY, 500))
def test_a_negation_is_no_command_and_nobody_else_may_make_one_of_it(words: str) -> None:
    assert not read.commands(words)
    assert not read.without_slips(words)
    assert read.remark(words)


MIXED = (
    "bring {right}, not {wrong}",
    "bring {right} and not {wrong}",
    "bring not {wrong} but {right}",
    "take {right} instead of {wrong}",
    "instead of {wrong}, bring {right}",
    "bring {right} and leave {wrong} alone",
    "leave {wrong} alone and bring {right}",
    "bring {right} and leave {wrong} where it is",
    "take {right} off the desk but leave {wrong} there",
    "bring {right} and don't touch {wrong}",
    "bring {right}. Do not bring {wrong}.",
    "find {right}, then never take {wrong}",
    "don't bring {wrong}, bring {right}",
    "Don't touch {wrong}! Bring {right}.",
    "do not bring {wrong} but {right}",
    "I don't want {wrong}, I want {right}",
    "bring {right} from the desk except {wrong}",
    "bring {right} from the desk except the pear and {wrong}",
    "put {right} on the sofa, but not {wrong}",
    "clear the desk but leave {wrong}",
    "clear the desk except {wrong}",
    "bring all the fruit except the pear, {wrong} and the banana",
)
RIGHT, WRONG = ("the apple", "two fruits", "a red mug"), ("the hammer", "my scissors", "any toy")


@pytest.mark.parametrize(("form", "right", "wrong"), [*product(MIXED, RIGHT, WRONG)])
def test_what_is_denied_beside_something_else_is_left_out_of_all(form, right, wrong) -> None:
    commands = read.commands(form.format(right=right, wrong=wrong))
    assert commands
    denied = wrong.rpartition(" ")[2]
    for command in (one for group in commands for one in group):
        assert denied not in command.target
        assert denied in command.exceptions


DENIALS = st.sampled_from(("don't", "never", "do not", "please don't ever", "you must not"))
SAID = st.lists(
    st.sampled_from((*DEEDS, *THINGS, "and", "or", ",", "but", "then", "it", "to me", "from")),
    min_size=1,
    max_size=8,
).map(" ".join)


@given(DENIALS, SAID)
def test_what_is_behind_a_negation_is_never_asked_for_again_nor_is_it(denial, said) -> None:
    for group in read.commands(f"{denial} take the sugar_box, {said}"):
        for command in group:
            assert command.target not in ("sugar_box", "it")
            assert "sugar_box" in command.exceptions


@pytest.mark.parametrize(
    ("words", "goal"),
    [
        ("Don't bring the mug to me, put it on the desk", "desk"),
        ("Don't bring the mug, take it to the kitchen", "kitchen"),
        ("Don't put the mug on the desk, put it on the sofa", "sofa"),
        ("Do not put the mug on the desk but on the sofa", "sofa"),
    ],
)
def test_if_it_is_a_place_that_is_denied_the_other_one_is_meant(words: str, goal: str) -> None:
    [[command]] = read.commands(words)
    assert (command.kind, command.target, command.goal) == ("put", "mug", goal)


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (
            "do not take the mug, bring it",
            "Then I will not. Say once more what I am to do instead.",
        ),
        ("don't go to the kitchen, go to the bedroom", "Then I will not. Say once more"),
        ("do not take the mug and bring the pear", "Then I will not."),
    ],
)
def test_who_may_have_asked_for_something_else_is_told_to_say_it_again(words, says) -> None:
    assert not read.commands(words)
    assert read.remark(words).startswith(says)


@pytest.mark.parametrize("words", ["bring an apple, not the peach, and a mug"])
def test_what_may_be_denied_or_wanted_is_neither_done_nor_passed_over(words: str) -> None:
    assert not read.commands(words)
    assert read.remark(words) == "I do nothing: I hear 'not', and do not understand the rest."


@pytest.mark.parametrize("but", ["other than", "apart from", "excluding"])
def test_what_is_left_out_of_what_is_not_understood_becomes_no_deed(but: str) -> None:
    words = f"bring me anything {but} the peach that she likes"
    assert not read.commands(words)
    assert read.denial(words) == but


@pytest.mark.parametrize(
    "but", ["but", ", but", "except", ", except for", "other than", "apart from"]
)
@pytest.mark.parametrize("peach", ["the peach", "that peach", "a peach"])
def test_what_is_left_out_may_stand_behind_a_comma(but: str, peach: str) -> None:
    [[command]] = read.commands(f"Bring me anything {but} {peach}")
    assert (command.target, command.exceptions) == ("thing", ("peach",))


@pytest.mark.parametrize("verb", ["get me", "hand me", "find"])
def test_who_says_that_one_could_not_and_asks_whether_one_could_asks_for_it(verb: str) -> None:
    [[command]] = read.commands(f"You couldn't {verb} the mug, could you?")
    assert command.target == "mug"
    assert not read.commands(f"You couldn't {verb} the mug.")


def test_who_only_looks_need_not_be_told_to_leave_it() -> None:
    command = read.command("find the mug and do not touch it")
    assert command
    assert (command.kind, command.target, command.exceptions) == ("find", "mug", ())


@pytest.mark.parametrize(
    "words",
    ["Bring an apple, not the peach", "Take the mug instead of the pear", "I can't find the mug"],
)
def test_what_says_what_to_do_and_what_not_is_a_command(words: str) -> None:
    command = read.command(words)
    assert command
    assert command.target in ("apple", "mug")


@pytest.mark.parametrize(
    "words",
    [
        "Bring a mug, but don't look in the kitchen",
        "Bring the mug from anywhere but the desk",
        "Bring a fruit but not from the dining table",
        "Bring the mug that isn't on the desk",
        "Look for the mug everywhere except the kitchen",
        "Bring the hammer without going to the lobby",
    ],
)
def test_who_leaves_out_a_place_is_told_what_to_say_instead(words: str) -> None:
    assert read.commands(words) == ()
    assert read.remark(words).startswith("I cannot leave out places; say where I am to look")


@pytest.mark.parametrize("words", ["Bring the mug without the pear", "Bring the mug from anywhere"])
def test_what_is_no_place_is_not_called_one(words: str) -> None:
    assert "places" not in read.remark(words)
