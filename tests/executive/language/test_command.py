"""What people say, and what the robot makes of it."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from executive.language.grammar import EnglishInterpreter
from executive.types.commands import CommandKind

read = EnglishInterpreter()


@pytest.mark.parametrize(
    ("words", "kind", "target"),
    [
        ("Bring a sugar_box.", CommandKind.BRING, "sugar_box"),
        ("Find an apple", CommandKind.FIND, "apple"),
        ("take the mug", CommandKind.TAKE, "mug"),
        ("Could you please bring me the sugar box?", CommandKind.BRING, "sugar box"),
        ("fetch pitcher", CommandKind.BRING, "pitcher"),
        ("Robot, where is my power drill?", CommandKind.FIND, "power drill"),
        (
            "Please pick up some colored wood blocks, please",
            CommandKind.TAKE,
            "colored wood blocks",
        ),
        ("  GET   ME an   ORANGE !! ", CommandKind.BRING, "orange"),
        ("Bring the hammer to me.", CommandKind.BRING, "hammer"),
        ("I'd like an apple", CommandKind.BRING, "apple"),
        ("I’d like you to find me the mug", CommandKind.FIND, "mug"),
        ("I would like to have some sugar", CommandKind.BRING, "sugar"),
        ("Can I have a banana, please?", CommandKind.BRING, "banana"),
        ("I need the scissors.", CommandKind.BRING, "scissors"),
        ("Where's my mug?", CommandKind.FIND, "mug"),
        ("I can't find the scissors!", CommandKind.FIND, "scissors"),
        ("Pick the pear up", CommandKind.TAKE, "pear"),
        ("Hold on to the mug", CommandKind.TAKE, "mug"),
        ("Get hold of the mug", CommandKind.TAKE, "mug"),
        ("Hand me the spatula, please", CommandKind.BRING, "spatula"),
        ("Carry the mug over here", CommandKind.BRING, "mug"),
        ("Have you seen the drill?", CommandKind.FIND, "drill"),
    ],
)
def test_reads_a_request(words: str, kind: CommandKind, target: str) -> None:
    command = read.command(words)
    assert command is not None
    assert (command.kind, command.target, command.words) == (kind, target, words)


@pytest.mark.parametrize(
    "words", ["", "   ", "apple", "bring", "Bring a.", "findings", "hello you", "Hold on!"]
)
def test_reads_no_request_where_there_is_none(words: str) -> None:
    command = read.command(words)
    assert command is None


@given(st.text())
def test_never_raises_and_never_names_nothing(words: str) -> None:
    command = read.command(words)
    if command and command.kind != CommandKind.GO:
        assert command.target.strip() or command.source.strip()  # "clear the desk"


@pytest.mark.parametrize("answer", ["I don't know", "no idea!", "Don’t know.", "no", "never mind"])
def test_hears_that_the_person_cannot_help(answer: str) -> None:
    assert read.declines(answer)


@pytest.mark.parametrize(
    ("answer", "agrees"),
    [
        *((yes, True) for yes in ("yes", "Yes, please!", "yeah", "Sure.", "okay")),
        *((no, False) for no in ("no", "No!", "nope", "no, the mug", "not that")),
        *((neither, None) for neither in ("no idea", "not sure", "the mug", "", "nobody")),
    ],
)
def test_hears_yes_and_no(answer: str, agrees: bool | None) -> None:
    assert read.agrees(answer) is agrees


@pytest.mark.parametrize("answer", ["on the desk", "the notebook shelf", "bedroom", "kitchen"])
def test_does_not_take_an_answer_for_a_refusal(answer: str) -> None:
    assert not read.declines(answer)


@pytest.mark.parametrize("words", ["clear", "Tidy up, please"])
def test_who_is_to_clear_is_told_what_it_takes(words: str) -> None:
    read = EnglishInterpreter()
    assert not read.commands(words)
    assert read.remark(words).startswith("I can clear only at a place; say which.")


def test_a_sentence_is_put_in_plain_form_once_for_all_who_ask(monkeypatch) -> None:
    def counted(text: str) -> str:
        asked.append(text)
        return text.lower()

    asked: list[str] = []
    monkeypatch.setattr("executive.language.reader.plain_letters", counted)
    words, it = "Bring me the tin that nobody spoke of in any test", EnglishInterpreter()
    for ask in (it.commands, it.remark, it.denial, it.declines, it.agrees, it.talk):
        ask(words)
    assert asked.count(words) == 1
