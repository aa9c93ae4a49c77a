"""The page on what can be said: its sentences are read and answered as it says."""

from pathlib import Path

import pytest

from executive.language.grammar import EnglishInterpreter
from executive.records import Utterance
from executive.testing.bench import run_mission

PAGE = Path(__file__).parents[2] / "docs" / "what-you-can-say.md"
read = EnglishInterpreter()


def rows(title: str) -> list[tuple[str, str]]:
    """The sentences of the tables with this title, and what comes of them."""
    found, inside = [], False
    for line in PAGE.read_text().splitlines():
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        if cells[0] == "say":
            inside = cells[1] == title
        elif inside and cells[0].startswith('"'):
            found.append((cells[0].strip('"'), cells[1]))
    return found


@pytest.mark.parametrize(("words", "deed"), rows("it does"))
def test_does_what_is_said(words: str, deed: str) -> None:
    command = read.command(words)
    assert command
    place = f" ({command.source})" if command.source else ""
    goal = f"→ {command.goal}" if command.goal else ""
    what = f"{command.target}{place}"
    assert " ".join(filter(None, (command.kind.replace("_", " "), what, goal))) == deed


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
