"""What words mean, before anyone has looked whether the things and places in them exist."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from executive.language.grammar import EnglishInterpreter
from executive.language.meaning import (
    ME,
    About,
    Answer,
    Choice,
    Correction,
    Courtesy,
    Question,
    Refusal,
    Relation,
    Request,
    Said,
    Statement,
    Task,
    Thing,
    Things,
    Unable,
    Unread,
    Where,
)
from executive.language.reader import Reader, english
from executive.types.commands import ALL, CommandKind

read = english().read


def some(*names: str) -> Things:
    return Things(tuple(Thing(name, number=1) for name in names))


def certain(*names: str) -> Things:
    return Things(tuple(Thing(name, definite=True) for name in names))


def asks(*tasks: Task) -> Request:
    return Request(tasks)


DESK, KITCHEN = Where("desk", Relation.ON), Where("kitchen", Relation.IN)
IT = Things((Thing("it", pronoun=True, definite=True),))


@pytest.mark.parametrize(
    ("words", "meaning"),
    [
        ("Find the mug on the desk", asks(Task(CommandKind.FIND, certain("mug"), DESK))),
        ("Where is the mug?", asks(Task(CommandKind.FIND, certain("mug")))),
        (
            "Bring the mug from the desk or from the bed",
            asks(Task(CommandKind.BRING, certain("mug"), Where("desk", others=(Where("bed"),)))),
        ),
        (
            "Take the mug on the desk in the kitchen",
            asks(
                Task(CommandKind.TAKE, certain("mug"), Where("desk", Relation.ON, within=KITCHEN)),
            ),
        ),
        (
            "Move the mug from the bed to the kitchen",
            asks(Task(CommandKind.PUT, certain("mug"), Where("bed"), Where("kitchen"))),
        ),
        ("Give the mug to Anna", asks(Task(CommandKind.PUT, certain("mug"), goal=Where("anna")))),
        ("Bring Anna the mug", asks(Task(CommandKind.PUT, certain("mug"), goal=Where("anna")))),
        ("Bring the mug to me", asks(Task(CommandKind.BRING, certain("mug"), goal=ME))),
        (
            "Put a mug next to the pear",
            asks(Task(CommandKind.PUT, some("mug"), goal=Where("pear", Relation.NEXT_TO))),
        ),
        (
            "Put the mug on the desk, and the pear in the kitchen",
            asks(
                Task(CommandKind.PUT, certain("mug"), goal=DESK),
                Task(CommandKind.PUT, certain("pear"), goal=KITCHEN),
            ),
        ),
        (
            "Bring the mug to me and the pear to the kitchen",
            asks(
                Task(CommandKind.BRING, certain("mug"), goal=ME),
                Task(CommandKind.PUT, certain("pear"), goal=Where("kitchen")),
            ),
        ),
        (
            "Go to the kitchen, then to the bed",
            asks(
                Task(CommandKind.GO, goal=Where("kitchen")), Task(CommandKind.GO, goal=Where("bed"))
            ),
        ),
        ("Bring both the mug and the pear", asks(Task(CommandKind.BRING, certain("mug", "pear")))),
        (
            "Bring a couple of the mugs",
            asks(Task(CommandKind.BRING, Things((Thing("mugs", number=2, definite=True),)))),
        ),
        ("Put it back", asks(Task(CommandKind.PUT_BACK, IT))),
        ("Put it down", asks(Task(CommandKind.PUT_DOWN, IT))),
        ("Bring an apple and a pear", asks(Task(CommandKind.BRING, some("apple", "pear")))),
        (
            "Bring two apples",
            asks(Task(CommandKind.BRING, Things((Thing("apples", number=2),)))),
        ),
        (
            "Bring all the fruit",
            asks(Task(CommandKind.BRING, Things((Thing("fruit", number=ALL, definite=True),)))),
        ),
        (
            "Bring me either a mug or a pitcher",
            asks(Task(CommandKind.BRING, Things(some("mug", "pitcher").members, one_of=True))),
        ),
        (
            "Bring me anything but a banana",
            asks(
                Task(
                    CommandKind.BRING,
                    Things((Thing(number=1, exceptions=some("banana").members),)),
                )
            ),
        ),
        (
            "Bring me something yellow to drink from",
            asks(
                Task(CommandKind.BRING, Things((Thing("yellow", number=1, purpose="drink from"),)))
            ),
        ),
        (
            "Go to the kitchen, find the mug and bring it here",
            asks(
                Task(CommandKind.GO, goal=Where("kitchen")),
                Task(CommandKind.FIND, certain("mug")),
                Task(CommandKind.BRING, IT, goal=ME),
            ),
        ),
        (
            "Bring an apple if there is one, otherwise a pear",
            asks(
                Task(
                    CommandKind.BRING,
                    some("apple"),
                    conditional=True,
                    unless=Task(CommandKind.BRING, some("pear")),
                )
            ),
        ),
        ("Clear the table", asks(Task(CommandKind.CLEAR, source=Where("table")))),
        ("What is on the desk?", asks(Task(CommandKind.TELL, source=DESK))),
        ("Is there a mug on the desk?", asks(Task(CommandKind.CHECK, some("mug"), DESK))),
        (
            "How many mugs are there on the desk?",
            asks(Task(CommandKind.COUNT, Things((Thing("mugs"),)), DESK)),
        ),
    ],
)
def test_reads_what_is_to_be_done(words: str, meaning: Said) -> None:
    assert read(words) == meaning


@pytest.mark.parametrize(
    ("words", "meaning"),
    [
        ("Do not touch the hammer", Refusal("touch the hammer")),
        ("Leave the hammer alone", Refusal("hammer")),
        ("Leave the hammer on the desk", Refusal("hammer")),
        ("Throw the ball", Unable("throw", "the ball")),
        ("no, the pear", Correction(certain("pear"), denies=True)),
        (
            "No, next to the hammer",
            Correction(place=Where("hammer", Relation.NEXT_TO), denies=True),
        ),
        ("No, leave the pear", Refusal("pear")),
        ("I mean the pear", Correction(certain("pear"))),
        ("and the pear", Correction(certain("pear"), adds=True)),
        (
            "not the apple, the pear",
            Correction(certain("pear"), certain("apple"), denies=True),
        ),
        ("What can you do?", Question(About.ABILITIES)),
        ("What do you hold?", Question(About.HAND)),
        ("The mug is on the desk", Statement(certain("mug"), DESK)),
        ("I think the pear", Answer(things=certain("pear"))),
        ("maybe on the desk, in the kitchen", Answer(where=(DESK, KITCHEN))),
        ("the second one", Answer(place_in_list=2)),
        ("yes, the pear", Answer(Choice.YES, things=certain("pear"))),
        ("I don't know", Answer(Choice.UNKNOWN)),
        ("any of them", Answer(Choice.ANY)),
        ("both", Answer(Choice.BOTH)),
        ("all of them", Answer(Choice.ALL)),
        ("Hello!", Courtesy.HELLO),
        ("Thank you very much", Courtesy.THANKS),
    ],
)
def test_reads_what_else_is_said(words: str, meaning: Said) -> None:
    assert read(words) == meaning


@pytest.mark.parametrize(
    ("words", "at"),
    [
        ("Bring the mug which I used", "which"),
        ("Bring me no apple", "no"),
        ("Put the mug on the desk and on the sofa", "put"),
        ("Find the mug on the desk and the pear on the sofa and bring them", "them"),
        ("", ""),
    ],
)
def test_what_does_not_fit_is_not_read_and_it_is_told_where(words: str, at: str) -> None:
    assert read(words) == Unread(words, at)


@pytest.mark.parametrize("name", ["salt and pepper", "jar with a lid", "do not disturb sign"])
def test_a_name_with_words_that_mean_something_else_is_a_name(name: str) -> None:
    reader = Reader(names=[name])
    assert reader.read(f"Bring me the {name}") == asks(Task(CommandKind.BRING, certain(name)))


WORDS = sorted(english().vocabulary | {",", "mug", "desk", "12", "?", "isn't", "salt_box"})


@given(st.lists(st.sampled_from(WORDS), max_size=30))
def test_whatever_is_said_nothing_is_raised(words: list[str]) -> None:
    assert read(" ".join(words))


@given(
    st.lists(
        st.sampled_from(
            [
                "with",
                "without",
                "and",
                "no",
                "not",
                "first",
                "to",
                "stop",
                "leave",
                "in",
                "two",
                "wash",
                "if",
                "them",
            ]
        ),
        min_size=1,
        max_size=3,
    )
)
@settings(max_examples=30, deadline=None)
def test_a_name_is_one_whatever_words_are_in_it(words: list[str]) -> None:
    name = f"mug {' '.join(words)} cup"
    reads = EnglishInterpreter([name])
    for said in (
        f"Bring me the {name}",
        f"Bring the pear and the {name}",
        f"Find my {name}, please",
    ):
        assert [one.target for group in reads.commands(said) for one in group][-1] == name
    assert reads.read(f"Do not touch the {name}") == Refusal(f"touch the {name}")


def test_it_is_told_where_the_grammar_gives_up_behind_a_name() -> None:
    said = Reader(names=["mug without handle"]).read("bring the mug without handle the pear why")
    assert isinstance(said, Unread)
    assert said.words[said.begins :] == "the pear why"


def test_names_need_no_other_parser() -> None:
    assert english(("mug without handle",)).parser is english().parser
