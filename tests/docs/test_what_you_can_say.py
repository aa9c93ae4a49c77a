"""The page on what can be said: its sentences are read and answered as it says."""

from itertools import chain
from pathlib import Path

import pytest
from talking import session_of

from executive.events import Inbox
from executive.language.grammar import EnglishInterpreter
from executive.language.spoken import NOTHING, after
from executive.records import Utterance
from executive.testing.bench import run_mission
from executive.types.commands import ALL, Command
from executive.types.goals import Goal
from kb.facts import FactStore

PAGE = Path(__file__).parents[2] / "docs" / "what-you-can-say.md"
read = EnglishInterpreter()


def rows(title: str, begins: str = "say") -> list[tuple[str, str]]:
    """The sentences of the tables with these titles, and what comes of them."""
    found, inside = [], False
    for line in PAGE.read_text().splitlines():
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        if cells[0] in ("say", "then say", "ask or tell", "meanwhile say"):
            inside = (cells[0], cells[1]) == (begins, title)
        elif inside and len(cells) == 2 and cells[0].startswith('"'):
            found.append((cells[0].strip('"'), cells[1]))
    return found


def in_words(command: Command) -> str:
    number = {0: "", 1: "", ALL: "all"}.get(command.number, str(command.number))
    but = f"but {' and '.join(command.exceptions)}" if command.exceptions else ""
    place = f"({command.source})" if command.source else ""
    goal = f"→ {command.goal}" if command.goal else ""
    kind = command.kind.replace("_", " ")
    what = (kind, number, command.superlative, command.target, but, place, goal)
    deed = " ".join(filter(None, what))
    instead = f", else {in_words(command.unless)}" if command.unless else ""
    return f"if so, {deed}{instead}" if command.conditional else deed


@pytest.mark.parametrize(("words", "deed"), rows("it does"))
def test_does_what_is_said(words: str, deed: str) -> None:
    commands = chain.from_iterable(read.commands(words))
    assert "; ".join(map(in_words, commands)) == deed


@pytest.mark.parametrize(("words", "deed"), rows("it does", "then say"))
def test_knows_what_was_said_before(words: str, deed: str) -> None:
    found = after(read.read("Find a fruit"), NOTHING, things=("pear",), place="coffee_table")
    find = after(read.read("Find the pear"), found)
    commands = read.commands(words, find if "again" in words else found)
    assert "; ".join(map(in_words, chain.from_iterable(commands))) == deed


@pytest.mark.parametrize(("words", "answer"), rows("it says", "ask or tell"))
def test_answers_what_needs_no_mission(words: str, answer: str, tmp_path: Path) -> None:
    with session_of(tmp_path) as session:
        if answer.startswith("I went"):
            session.run("Find the hammer")
        else:
            session.run("The mug is on the coffee table")
        if "hold" in answer:
            session.run("Take the mug")
        elif any(words in answer for words in ("delivery", "Bring", "Here is", "I took")):
            session.run("Bring the mug")
        assert session.run(words).reason == answer


@pytest.mark.parametrize(("words", "answer"), rows("it says", "meanwhile say"))
def test_answers_while_it_is_busy(words: str, answer: str) -> None:
    def during(goal: Goal, inbox: Inbox) -> None:
        if not heard:
            heard.append(words)
            inbox.hear(words)

    heard: list[str] = []
    facts = FactStore.believing({})
    run = run_mission("Bring the hammer", llm=False, during=during, facts=facts)
    assert answer in [one.text for one in run.notebook.all(Utterance)]


@pytest.mark.parametrize(("words", "question"), rows("it asks"))
def test_asks_what_it_does_not_know(words: str, question: str) -> None:
    run = run_mission(words, llm=False, answers=["I don't know"])
    asked = next(one for one in run.notebook.all(Utterance) if one.speaker == "robot")
    assert asked.text.startswith(question.partition("...")[0])


@pytest.mark.parametrize(("words", "answer"), rows("it says"))
def test_says_what_it_does_not_do(words: str, answer: str) -> None:
    assert (read.talk(words) or read.remark(words)).startswith(answer.partition(" ...")[0])


def test_the_page_has_sentences_of_each_kind() -> None:
    assert all(len(rows(title)) > 4 for title in ("it does", "it asks", "it says"))
