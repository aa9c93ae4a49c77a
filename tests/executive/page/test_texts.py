"""All that the page says by itself is in its file of texts, and nothing else is."""

import json
import re
from importlib.resources import files
from typing import Any

from executive.records import Activity
from executive.types import MissionStatus, QuestionKind, Source

ASSETS = files("executive.page").joinpath("assets")
TEXTS: dict[str, Any] = json.loads(ASSETS.joinpath("english.json").read_text("utf-8"))
CODE = "\n".join(
    entry.read_text("utf-8") for entry in ASSETS.iterdir() if entry.name.endswith((".js", ".html"))
)


def test_each_text_that_the_page_names_is_there() -> None:
    named = set(re.findall(r'\btext\(\s*"([\w.]+)"', CODE))
    named |= set(re.findall(r'data-(?:text|label)="(\w+)"', CODE))
    for key in named:
        found: Any = TEXTS
        for part in key.split("."):
            assert part in found, key
            found = found[part]


def test_each_text_is_used() -> None:
    unused = [key for key in TEXTS if not re.search(rf'["`.]{key}\b', CODE)]
    assert not unused


def test_there_is_a_sentence_for_each_activity_status_and_source() -> None:
    assert set(Activity) <= set(TEXTS["doing"])
    assert set(MissionStatus) <= set(TEXTS["last"])
    assert set(Source) <= set(TEXTS["sources"])


def test_there_are_buttons_for_each_kind_of_question() -> None:
    answers = ASSETS.joinpath("answers.js").read_text("utf-8")
    # a thing is the answer to which_object: its options are shown
    assert all(f'"{kind}"' in answers for kind in set(QuestionKind) - {QuestionKind.WHICH_OBJECT})


def test_nothing_is_made_of_markup() -> None:
    assert not re.search(r"innerHTML|outerHTML|insertAdjacentHTML|document\.write|eval\(", CODE)
