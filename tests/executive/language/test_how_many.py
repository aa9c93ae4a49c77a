"""How many things are meant, and which of them."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from executive.language.grammar import EnglishInterpreter
from executive.language.spoken import NOTHING, Spoken, after

read = EnglishInterpreter()


@pytest.mark.parametrize(
    ("words", "number"),
    [
        ("Bring at least two fruits", 2),
        ("Bring no more than two fruits", 2),
        ("Bring up to three fruits", 3),
        ("Bring one or two fruits", 2),
        ("Bring me two to three fruits", 3),
        ("Bring a dozen fruits", 12),
        ("Bring half a dozen fruits", 6),
        ("Bring exactly 2 fruits", 2),
    ],
)
def test_a_bound_is_as_many_as_it_allows(words: str, number: int) -> None:
    [[command]] = read.commands(words)
    assert (command.target, command.number) == ("fruits", number)


@pytest.mark.parametrize("words", ["Bring -1 apples", "Bring 0 apples", "Bring -2 of the apples"])
def test_fewer_than_one_is_no_number_of_things(words: str) -> None:
    assert "apples" not in [one.target for group in read.commands(words) for one in group]


@pytest.mark.parametrize("words", ["Bring two more fruits", "Bring two more", "Bring another two"])
def test_more_are_others_than_those_of_before(words: str) -> None:
    before = after(read.read("Bring two fruits"), NOTHING, things=("apple", "pear"))
    [[command]] = read.commands(words, before)
    assert (command.target, command.number) == ("fruits", 2)
    assert command.exceptions == ("apple", "pear")


@pytest.mark.parametrize(
    "words", ["Bring everything except what is on the desk", "Bring all but everything on the bed"]
)
def test_what_is_left_out_has_to_be_named(words: str) -> None:
    assert read.commands(words) == ()


@pytest.mark.parametrize(
    "words",
    [
        "Don't just bring the mug, bring the apple too",
        "Bring not only the mug but also the apple",
        "Bring not just the mug, but the apple, too",
    ],
)
def test_not_only_this_is_both(words: str) -> None:
    commands = [command for group in read.commands(words) for command in group]
    assert [command.target for command in commands] == ["mug", "apple"]


def test_what_is_to_be_gone_from_a_place_is_not_put_there() -> None:
    [[command]] = read.commands("Remove the mug on the desk")
    assert (command.kind, command.target) == ("clear", "mug")
    assert (command.source, command.goal) == ("desk", "")


def seen(question: str, *things: str) -> Spoken:
    """What is spoken of when these were told in answer to a question."""
    return after(read.read(question), NOTHING, things=things, place="desk")


def targets(words: str, spoken: Spoken) -> list[str]:
    return [command.target for group in read.commands(words, spoken) for command in group]


@pytest.mark.parametrize(
    ("words", "meant"),
    [
        ("Bring both", ["mug", "pear"]),
        ("Put both on the sofa", ["mug", "pear"]),
        ("Bring them but not the pear", ["mug"]),
        ("Bring them except the mug", ["pear"]),
        ("Bring the third one", ["third one"]),
        ("Bring the second one", ["pear"]),
    ],
)
def test_which_of_two_are_meant(words: str, meant: list[str]) -> None:
    two = after(read.read("Find the mug and the pear"), NOTHING, things=("mug", "pear"))
    assert targets(words, two) == meant


def test_the_first_of_one_is_not_guessed() -> None:
    one = after(read.read("Find the pear"), NOTHING, things=("pear",))
    assert targets("Bring the first one", one) == ["first one"]


@pytest.mark.parametrize(
    ("question", "meant"),
    [
        ("Is there a fruit on the desk?", "fruit"),
        ("How many fruits are on the desk?", "it"),
        ("What is on the desk?", "it"),
    ],
)
def test_which_of_several_that_were_seen_it_is_has_to_be_asked(question: str, meant: str) -> None:
    assert targets("Bring it", seen(question, "apple", "pear")) == [meant]
    assert targets("Bring it", seen(question, "apple")) == ["apple"]


@pytest.mark.parametrize(
    ("words", "goal"),
    [
        ("And the pear on the bed", "bed"),
        ("Do the same with the pear", "sofa"),
        ("What about the pear?", "sofa"),
        ("Now the pear", "sofa"),
    ],
)
def test_the_same_may_be_asked_for_with_another_thing(words: str, goal: str) -> None:
    before = after(read.read("Put the mug on the sofa"), NOTHING, things=("mug",), place="sofa")
    [[command]] = read.commands(words, before)
    assert (command.kind, command.target, command.goal) == ("put", "pear", goal)


def test_the_same_may_be_asked_about_another_place() -> None:
    [[command]] = read.commands("And on the sofa?", seen("What is on the desk?", "mug"))
    assert (command.kind, command.source) == ("tell", "sofa")


SPOKEN = ("mug", "pear", "apple", "hammer")
ALL_OF = {
    "both": 2,
    "both of them": 2,
    "all three": 3,
    "all three of them": 3,
    "all four": 4,
    "those two": 2,
}


@given(st.sampled_from(sorted(ALL_OF)), st.integers(2, 4))
def test_a_number_that_is_all_of_them_is_never_some_of_them(words: str, spoken: int) -> None:
    things = SPOKEN[:spoken]
    commands = read.commands(f"Bring me {words}", Spoken(things, "apple"))
    targets = [one.target for group in commands for one in group]
    assert targets == ([*things] if ALL_OF[words] == spoken else [])
    if not targets:
        assert "say their names" in read.remark(f"Bring me {words}", Spoken(things, "apple"))


def test_both_of_three_that_were_named_in_the_same_breath_is_asked_about() -> None:
    words = "Find the mug, the pear and the apple and put both of them on the desk"
    assert read.commands(words) == ()
    assert "'both of them'" in read.remark(words)


@pytest.mark.parametrize(
    ("words", "meant"),
    [
        ("Bring the first two", ["mug", "pear"]),
        ("Bring me the last two of them", ["apple", "hammer"]),
        ("Bring the first and the last", ["mug", "hammer"]),
        ("Bring me the first and put the second on the desk", ["mug", "pear"]),
        ("Put the latter on the desk", ["hammer"]),
        ("Bring all of them but the pear", ["mug", "apple", "hammer"]),
    ],
)
def test_those_in_a_row_are_of_what_was_spoken_of(words: str, meant: list[str]) -> None:
    commands = read.commands(words, Spoken(SPOKEN))
    assert [one.target for group in commands for one in group] == meant


@pytest.mark.parametrize(
    ("words", "meant"),
    [
        ("Bring the mug and the pear, but the pear first", ["pear", "mug"]),
        ("Bring the mug, the pear and the apple but the apple first", ["apple", "mug", "pear"]),
        ("Bring the mug, the pear and the apple, the apple first", ["apple", "mug", "pear"]),
        ("Before you bring the mug, bring the pear", ["pear", "mug"]),
        ("After you bring the mug, bring the pear", ["mug", "pear"]),
    ],
)
def test_what_is_to_be_first_comes_first(words: str, meant: list[str]) -> None:
    groups = read.commands(words)
    assert [one.target for group in groups for one in group] == meant
    assert len(groups) == len(meant)
    assert not any(one.exceptions for group in groups for one in group)


@pytest.mark.parametrize(
    "words",
    ["Bring the mug and the pear but the apple first", "Bring me three fruits, the pear first"],
)
def test_what_is_to_be_first_and_is_none_of_them_is_not_read(words: str) -> None:
    assert read.commands(words) == ()


@pytest.mark.parametrize("words", ["Bring 1 tool", "Bring one tool", "Bring me a tool"])
def test_one_may_be_written_as_a_digit(words: str) -> None:
    [[command]] = read.commands(words)
    assert (command.target, command.number) == ("tool", 0)


@pytest.mark.parametrize("so_many", ["two fruits", "one fruit", "one of the tools"])
def test_of_all_but_so_many_it_is_not_clear_which(so_many: str) -> None:
    assert read.commands(f"Bring all but {so_many}") == ()


def test_of_all_but_those_that_are_named_it_is_clear_which() -> None:
    [[command]] = read.commands("Bring all but the two pears")
    assert command.exceptions == ("pears",)


@pytest.mark.parametrize("words", ["Find the mug to the kitchen", "Where is the mug into the sofa"])
def test_what_is_only_looked_for_goes_nowhere(words: str) -> None:
    assert read.commands(words) == ()


@pytest.mark.parametrize("verb", ["Bring", "Take", "Carry", "Put"])
@pytest.mark.parametrize("preposition", ["into", "onto"])
def test_into_a_place_is_where_it_is_to_go(verb: str, preposition: str) -> None:
    [[command]] = read.commands(f"{verb} the box on the desk {preposition} the sofa")
    assert (command.kind, command.source, command.goal) == ("put", "desk", "sofa")
