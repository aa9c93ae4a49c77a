"""All that the page says by itself is in its file of texts, and nothing else is."""

import json
import re
from importlib.resources import files
from importlib.resources.abc import Traversable
from typing import Any

import pytest

from executive.records import Activity
from executive.types.dialogue import QuestionKind
from executive.types.knowledge import Source
from executive.types.outcome import MissionStatus


def of(package: str) -> tuple[Traversable, dict[str, Any], str]:
    """A page's files, its texts, and all its code."""
    assets = files(package).joinpath("assets")
    code = [e.read_text("utf-8") for e in assets.iterdir() if e.name.endswith((".js", ".html"))]
    return assets, json.loads(assets.joinpath("english.json").read_text("utf-8")), "\n".join(code)


ASSETS, TEXTS, CODE = of("executive.page")
PAGES = pytest.mark.parametrize(
    ("texts", "code"),
    [(TEXTS, CODE), of("executive.page.experiment")[1:]],
    ids=["person", "experimenter"],
)


@PAGES
def test_each_text_that_a_page_names_is_there(texts: dict[str, Any], code: str) -> None:
    named = set(re.findall(r'\btext\(\s*"([\w.]+)"', code))
    named |= set(re.findall(r'data-(?:text|label)="(\w+)"', code))
    assert len(named) > 20
    for key in named:
        found: Any = texts
        for part in key.split("."):
            assert part in found, key
            found = found[part]


@PAGES
def test_each_text_is_used(texts: dict[str, Any], code: str) -> None:
    unused = [key for key in texts if not re.search(rf'["`.]{key}\b', code)]
    assert [
        key for key in unused if not key.startswith(("for_", "held_")) and key != "language"
    ] == []


def test_there_is_a_sentence_for_each_activity_status_and_source() -> None:
    assert set(Activity) <= set(TEXTS["doing"])
    assert set(MissionStatus) <= set(TEXTS["last"])
    assert set(Source) <= set(TEXTS["sources"])


def test_there_are_buttons_for_each_kind_of_question() -> None:
    answers = ASSETS.joinpath("answers.js").read_text("utf-8")
    # a thing is the answer to which_object: its options are shown
    assert all(f'"{kind}"' in answers for kind in set(QuestionKind) - {QuestionKind.WHICH_OBJECT})


@PAGES
def test_nothing_is_made_of_markup(texts: dict[str, Any], code: str) -> None:
    assert not re.search(r"innerHTML|outerHTML|insertAdjacentHTML|document\.write|eval\(", code)
