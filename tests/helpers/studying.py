"""Participants who are simulated: they go through a study in a real browser, as people would."""

import random
import re
import subprocess
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import tomli_w
from browsing import said, say, wait_until_ready
from paging import TOKEN
from patience import PATIENCE_S
from playwright.sync_api import Page as Tab
from playwright.sync_api import expect

from executive.page.address import Address
from executive.page.study.data import StudyData
from executive.page.study.file import Study
from executive.page.study.leading import Leader
from executive.page.study.page import StudyPage

COMMAND = "Find the peach at the high_table"
"""What the robot does at once, and asks nothing."""
FOUND = re.compile("The peach is on the|I hold the peach")
"""What it says then; it has the peach in its hand if it was stopped as it brought it."""


def study_of(conditions: int, tasks: int = 1, limit_s: float | None = None, **given: Any) -> Study:
    """A study in the instant world."""
    searches = ("plan", "paper")
    return Study.model_validate(
        {
            "title": "A study",
            "consent": "Do you take part?",
            "instructions": "Talk with the robot.",
            "settings": {"world": "fake", "llm": "none", "answer_timeout_s": 3600.0},
            "conditions": [
                {"name": name, "settings": {"search": searches[number % 2]}}
                for number, name in enumerate("abcdefghijkl"[:conditions])
            ],
            "tasks": [
                {"name": f"t{number}", "text": "Find the peach.", "limit_s": limit_s}
                for number in range(tasks)
            ],
            "after_each": ["sus"],
            **given,
        }
    )


@dataclass
class Led:
    """A participant who is led.

    Attributes:
        page: their page.
        leader: who leads them.
        took_part: whether they did, when all is over.
        wrong: what was raised.
    """

    page: StudyPage
    leader: Leader
    took_part: bool | None = None
    wrong: list[BaseException] = field(default_factory=list)


@contextmanager
def led(
    data: StudyData, code: str, *, to_the_end: bool = True, experimenter: bool = False
) -> Iterator[Led]:
    """Lead a participant, in a thread; what is raised there is raised here."""
    with (
        data.one(code) as journal,
        StudyPage(
            Address(port=0, experimenter=experimenter), TOKEN, speech=data.study.speech
        ) as page,
    ):
        made = Led(page, Leader(data, journal, page))

        def lead() -> None:
            try:
                made.took_part = made.leader.lead()
            except BaseException as error:
                made.wrong.append(error)

        thread = threading.Thread(target=lead, daemon=True)
        thread.start()
        try:
            yield made
            thread.join(PATIENCE_S if to_the_end else 0)
        finally:
            if thread.is_alive():
                made.leader.interrupt("the test")
                thread.join(PATIENCE_S)
        if to_the_end and made.wrong:
            raise AssertionError("the participant was not led to the end") from made.wrong[0]


def task_done(tab: Tab, chance: random.Random) -> None:
    """Have the robot do one thing, and say that the task is done."""
    before = len(said(tab))
    say(tab, COMMAND)
    after = tab.locator(f"#said > li.robot:nth-child(n+{before + 1})")
    expect(after.filter(has_text=FOUND).first).to_be_visible()
    wait_until_ready(tab)
    end_task(tab, "I have done it")


def end_task(tab: Tab, how: str) -> None:
    """Press a button of the task, and mean it."""
    tab.locator("#task").get_by_role("button", name=how).click()
    tab.locator("#task").get_by_role("button", name="Yes", exact=True).click()


def answer_all(tab: Tab, chance: random.Random) -> None:
    """Fill in a questionnaire."""
    for item in tab.locator("fieldset.item").all():
        if points := item.locator("input[type=radio]").all():
            chance.choice(points).check()
        elif item.locator("input[type=range]").count():
            item.locator("input[type=range]").press("Enter")
        else:
            item.locator("textarea").fill("Words.")
    tab.get_by_role("button", name="Send my answers").click()


def step_of(tab: Tab) -> tuple[str, str]:
    """At which step the page is, and of what kind."""
    found: list[str] = tab.evaluate("[document.body.dataset.step, document.body.dataset.kind]")
    return found[0], found[1]


def next_step(tab: Tab, after: str = "") -> tuple[str, str]:
    """The step that comes after this one, as soon as something can be done in it."""
    tab.wait_for_function("before => (document.body.dataset.step ?? '') !== before", arg=after)
    return step_of(tab)


def take_part(
    tab: Tab,
    chance: random.Random,
    do: Callable[[Tab, random.Random], None] = task_done,
    *,
    until: str = "thanks",
    look: Callable[[Tab], None] = lambda tab: None,
) -> list[str]:
    """Go through the study up to a kind of step, and look at each; the steps on the way."""
    gone: list[str] = []
    step, kind = next_step(tab)
    while kind != until:
        gone.append(step)
        look(tab)
        go_through(tab, kind, chance, do)
        step, kind = next_step(tab, step)
    look(tab)
    return gone


def go_through(
    tab: Tab, kind: str, chance: random.Random, do: Callable[[Tab, random.Random], None]
) -> None:
    """Do what a step asks for."""
    match kind:
        case "consent":
            tab.get_by_role("button", name="I agree and take part").click()
        case "instructions" | "part":
            tab.get_by_role("button", name="Go on").click()
        case "task":
            wait_until_ready(tab)
            expect(tab.get_by_role("button", name="I give up")).to_be_visible()
            do(tab, chance)
        case "questionnaire":
            answer_all(tab, chance)


def data_in(folder: Path, study: Study) -> StudyData:
    """The data of a study, in a folder of its own."""
    return StudyData(folder / "data", study)


@contextmanager
def begun(
    file: Path, data: Path, *more: str
) -> Iterator[tuple["subprocess.Popen[str]", SimpleNamespace]]:
    """The program as it is started by hand, and its page."""
    command = [sys.executable, "-m", "executive.page", "study", str(file), "--data", str(data)]
    with subprocess.Popen(
        [*command, "--page", "0", *more], stderr=subprocess.PIPE, text=True
    ) as process:
        assert process.stderr is not None
        found = re.search(r"open (http\S+token=(\S+))", process.stderr.readline())
        assert found
        try:
            yield process, SimpleNamespace(url=found[1], token=found[2])
        finally:
            process.kill()


def written(study: Study, folder: Path) -> Path:
    """The study as a file."""
    file = folder / "study.toml"
    file.write_text(tomli_w.dumps(study.model_dump(mode="json", exclude_none=True)))
    return file
