"""Several sentences at once, with pauses or without, of which some may ask for nothing."""

import pytest

from executive.language.grammar import EnglishInterpreter

read = EnglishInterpreter()


def asked(words: str) -> list[tuple[str, ...]]:
    """The tasks, each by verb, thing, where it is and where it is to go."""
    commands = (one for group in read.commands(words) for one in group)
    return [(c.kind.value, c.target, *filter(None, (c.source, c.goal))) for c in commands]


@pytest.mark.parametrize(
    ("words", "meant"),
    [
        ("bring me the apple the mug and the drill", ["apple", "mug", "drill"]),
        ("find the mug the pear the hammer", ["mug", "pear", "hammer"]),
        ("bring me two apples a pear and my mug", ["apples", "pear", "mug"]),
        ("go to the kitchen look for the pear and bring it to me", ["pear"]),
        ("take the pear put it in the fridge then come back", ["pear", ""]),
        ("bring me the hammer go to the desk and take the mug", ["hammer", "mug"]),
        ("go to the desk the sofa and the bed", ["", "", ""]),
    ],
)
def test_who_makes_no_pauses_is_understood(words: str, meant: list[str]) -> None:
    assert [task[1] for task in asked(words)] == meant


@pytest.mark.parametrize(
    "words",
    [
        "bring the mug the red one",
        "do not bring the apple the mug",
        "not the apple the mug",
        "the apple the mug",
        "bring me like the mug",
        "bring the teacher the apple",
        "is the hammer a tool",
        "move the mug a little to the left",
        "bring the mug and the pear and throw the apple",
        "give me the mug and him the pear",
    ],
)
def test_what_may_be_one_thing_or_none_is_not_taken_apart(words: str) -> None:
    assert asked(words) == []


@pytest.mark.parametrize(
    ("words", "task"),
    [
        ("I am cooking dinner. Can you bring me the mug?", ("bring", "mug")),
        ("i am cooking dinner can you bring me the mug", ("bring", "mug")),
        ("It is cold in here. Bring the mug, please.", ("bring", "mug")),
        ("Bring the mug, I am thirsty", ("bring", "mug")),
        ("Thanks! Now bring me the apple.", ("bring", "apple")),
        ("Hi! How are you? Please bring me a banana.", ("bring", "banana")),
        ("I can't reach the sugar box, could you get it?", ("bring", "sugar box")),
        ("The mug is dirty. Take it to the kitchen.", ("put", "mug", "kitchen")),
        ("The mug is on the desk. Bring it to me.", ("bring", "mug", "desk")),
        ("I think the mug is in the kitchen, can you get it?", ("bring", "mug", "kitchen")),
        ("I left the hammer on the sofa. Put it on the desk", ("put", "hammer", "sofa", "desk")),
        ("It is on the desk. Bring the mug.", ("bring", "mug", "desk")),
        ("I need the hammer, it is on the shelf", ("bring", "hammer", "shelf")),
        ("the mug is on the desk so bring it here", ("bring", "mug", "desk")),
        ("bring the mug because I am thirsty", ("bring", "mug")),
        ("Bring the mug, so that I can drink", ("bring", "mug")),
        ("Bring the mug carefully", ("bring", "mug")),
        ("Do not hesitate to bring the mug", ("bring", "mug")),
    ],
)
def test_what_asks_for_nothing_may_stand_beside_a_request(
    words: str, task: tuple[str, ...]
) -> None:
    assert asked(words) == [task]


@pytest.mark.parametrize(
    "words",
    [
        "I am hungry, do not bring the apple",
        "The mug is on the desk. Bring me the apple.",
        "I am not allowed the apple, bring me the pear",
        "I told you to bring the mug, bring the pear",
        "I am allergic to apples, bring me all the fruit",
        "The apple is bad, do not bring it",
        "I left my mug on the desk and my pear on the sofa, bring them",
        "Bring the mug because I am not to have the pear",
    ],
)
def test_what_may_ask_for_something_else_is_not_passed_over(words: str) -> None:
    assert asked(words) == []


@pytest.mark.parametrize(
    ("words", "verbs"),
    [
        ("Look in the kitchen. If there is a pear, bring it.", ["tell", "bring"]),
        ("Find the mug. Find the pear. Bring them to me.", ["find", "find", "bring", "bring"]),
        ("find the mug and the pear and bring both of them", ["find", "find", "bring", "bring"]),
        ("find the mug and the pear then bring the first one", ["find", "find", "bring"]),
    ],
)
def test_each_sentence_is_a_task(words: str, verbs: list[str]) -> None:
    assert [task[0] for task in asked(words)] == verbs


@pytest.mark.parametrize(
    ("words", "checked", "instead"),
    [
        ("If the mug isn't on the desk, bring the apple", ("mug", "desk"), "apple"),
        ("If there is no apple, bring a pear", ("apple", ""), "pear"),
        ("If you can't find the mug bring the pitcher", ("mug", ""), "pitcher"),
        ("Bring the mug unless it is in the kitchen", ("mug", "kitchen"), "mug"),
        ("Unless there is an apple on the desk, bring a pear", ("apple", "desk"), "pear"),
    ],
)
def test_what_is_not_there_may_be_a_condition(
    words: str, checked: tuple[str, str], instead: str
) -> None:
    [[command]] = read.commands(words)
    assert (command.kind.value, command.conditional) == ("check", True)
    assert (command.target, command.source) == checked
    assert command.unless
    assert (command.unless.kind.value, command.unless.target) == ("bring", instead)


def test_several_things_that_are_told_of_are_them() -> None:
    words = "I dropped the mug and the pear, can you bring them?"
    assert asked(words) == [("bring", "mug"), ("bring", "pear")]
