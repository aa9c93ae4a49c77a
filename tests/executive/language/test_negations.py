"""A negation never becomes a deed, whoever reads it."""

import random
from itertools import product

import pytest

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
    "instead of {thing}, bring the mug",
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


@pytest.mark.parametrize(
    "words",
    ["Bring an apple, not the peach", "Take the mug instead of the pear", "I can't find the mug"],
)
def test_what_says_what_to_do_and_what_not_is_a_command(words: str) -> None:
    command = read.command(words)
    assert command
    assert command.target in ("apple", "mug")
