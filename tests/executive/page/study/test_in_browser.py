"""Participants go through a study in a real browser."""

import random
import signal
from pathlib import Path

import pytest
from axe_playwright_python.sync_playwright import Axe
from browsing import DESKTOP, PHONE, SMALLEST, opened, say, wait_until_ready
from patience import PATIENCE_S
from playwright.sync_api import Browser, expect
from playwright.sync_api import Page as Tab
from speaking_browser import STUBS
from studying import begun, data_in, end_task, led, next_step, study_of, take_part, written

from executive.page.study.tables import read_rows, tables

pytestmark = pytest.mark.browser

RULES = {
    "runOnly": ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa", "best-practice"],
    "resultTypes": ["violations"],
}


def faults(tab: Tab) -> list[str]:
    response = Axe().run(tab, options=RULES).response
    return [
        f"{fault['id']}: {node['html'][:120]} {node.get('failureSummary', '')[:300]}"
        for fault in response["violations"]
        for node in fault["nodes"]
    ]


def test_two_participants_go_through_two_conditions(browser: Browser, tmp_path: Path) -> None:
    data, chance = data_in(tmp_path, study_of(2)), random.Random(0)
    for code in ("P01", "P02"):
        with led(data, code) as one, opened(browser, one.page) as tab:
            steps = take_part(tab, chance)
            expect(tab.locator("#sheet-title")).to_have_text("Thank you")
        assert steps[2:5] == ["part/1/", "task/1/t0", "questionnaire/1/sus"]
        assert one.took_part
    made = read_rows(data.folder / "results.parquet")
    assert [(r["participant"], r["condition"], r["ended"], r["done"]) for r in made] == [
        ("P01", "a", "finished", 1),
        ("P01", "b", "finished", 1),
        ("P02", "b", "finished", 1),
        ("P02", "a", "finished", 1),
    ]
    assert len(read_rows(data.folder / "answers.parquet")) == 2 * 2 * 10
    assert all(
        (data.folder / folder / "mission.mcap").exists() for r in made for folder in r["recordings"]
    )


def test_who_declines_sees_no_robot(browser: Browser, tmp_path: Path) -> None:
    data = data_in(tmp_path, study_of(1))
    with led(data, "P01") as one, opened(browser, one.page, viewport=SMALLEST) as tab:
        expect(tab.locator("#sheet-title")).to_be_visible()
        tab.get_by_role("button", name="I do not take part").click()
        expect(tab.locator("#sheet")).to_contain_text("Nothing of you is kept.")
    assert one.took_part is False
    assert not tables(data).results


@pytest.mark.parametrize("speech", [False, True])
def test_participants_may_speak_if_the_study_says_so(
    browser: Browser, tmp_path: Path, speech: bool
) -> None:
    data = data_in(tmp_path, study_of(1, speech=speech))

    def try_to_speak(tab: Tab, chance: random.Random) -> None:
        expect(tab.locator("#map")).to_be_visible()
        expect(tab.locator("#speak")).to_be_visible(visible=speech)
        end_task(tab, "I give up")

    with led(data, "P01") as one, opened(browser, one.page, first=STUBS) as tab:
        take_part(tab, random.Random(0), try_to_speak)


def test_what_a_study_says_is_read_in_the_direction_of_its_language(
    browser: Browser, tmp_path: Path
) -> None:
    words = "מה דעתך על הרובוט?"
    item = {"name": "free", "text": words, "answer": "words"}
    asked = {
        "title": words,
        "left": words,
        "right": words,
        "points": 5,
        "items": [item, {"name": "one", "text": words}],
    }
    given = {
        "title": words,
        "consent": words,
        "after_each": ["own"],
        "questionnaires": {"own": asked},
    }
    study = study_of(1, **given)
    tasks = (study.tasks[0].model_copy(update={"text": words}),)
    data = data_in(tmp_path, study.model_copy(update={"tasks": tasks}))
    directions = """words => [...document.querySelectorAll("h1, p, legend, .ends span")]
        .filter((one) => one.checkVisibility() && one.textContent.includes(words))
        .map((one) => getComputedStyle(one).direction)"""

    told: list[str] = []

    def look(tab: Tab) -> None:
        told.append(tab.evaluate(directions, words))

    def give_up(tab: Tab, chance: random.Random) -> None:
        end_task(tab, "I give up")

    with led(data, "P01", to_the_end=False) as one, opened(browser, one.page) as tab:
        take_part(tab, random.Random(0), give_up, until="questionnaire", look=look)
    rtl = ["rtl"]
    assert told == [rtl * 2, [], [], rtl, rtl * 5]


def test_a_task_is_given_up_while_the_robot_asks_and_the_next_one_begins(
    browser: Browser, tmp_path: Path
) -> None:
    data = data_in(tmp_path, study_of(1, tasks=2))

    def give_up(tab: Tab, chance: random.Random) -> None:
        say(tab, "Bring a fruit")
        expect(tab.locator("#answers")).to_be_visible()
        tab.keyboard.press("Escape")
        wait_until_ready(tab)
        say(tab, "Bring a fruit")
        expect(tab.locator("#answers")).to_be_visible()
        end_task(tab, "I give up")

    with led(data, "P01") as one, opened(browser, one.page) as tab:
        take_part(tab, random.Random(0), give_up)
    assert [(r.ended, r.missions, r.stopped, r.stops) for r in tables(data).results] == [
        ("gave_up", 2, 2, 1)
    ] * 2


@pytest.mark.parametrize("size", [(390, 844), (320, 568)])
def test_on_a_phone_a_long_task_is_read_whole_and_never_under_the_stop_button(
    browser: Browser, tmp_path: Path, size: tuple[int, int]
) -> None:
    told = "Imagine that you come home, and want some fruit, which somebody has put away. " * 4
    study = study_of(1)
    tasks = (study.tasks[0].model_copy(update={"text": told}),)
    data = data_in(tmp_path, study.model_copy(update={"tasks": tasks}))

    def look(tab: Tab, chance: random.Random) -> None:
        is_whole = "words => words.scrollHeight <= words.clientHeight"
        assert tab.locator("#task .words").evaluate(is_whole)
        tab.evaluate("scrollTo(0, 150)")
        bar, task = (tab.locator(one).bounding_box() for one in ("header", "#task"))
        assert bar
        assert task
        assert task["y"] < bar["y"] + bar["height"], "it is scrolled"
        assert (bar["y"], bar["width"]) == (0, size[0]), "under a bar across the whole screen"
        expect(tab.locator("#stop")).to_be_in_viewport(ratio=1)
        say(tab, "Bring a fruit")
        expect(tab.locator("#answers .answer").first).to_be_in_viewport(ratio=0.9)
        end_task(tab, "I give up")

    viewport = {"width": size[0], "height": size[1]}
    with led(data, "P01") as one, opened(browser, one.page, viewport=viewport) as tab:
        take_part(tab, random.Random(0), look)


@pytest.mark.parametrize("size", [(390, 844), (375, 667), (320, 568)])
def test_on_a_phone_a_question_for_places_leaves_what_one_types_in_in_sight(
    browser: Browser, tmp_path: Path, size: tuple[int, int]
) -> None:
    asks = {"world": "fake", "llm": "none", "question_s": 0.0, "answer_timeout_s": 3600.0}
    data = data_in(tmp_path, study_of(1, settings=asks))

    def look(tab: Tab, chance: random.Random) -> None:
        say(tab, "Find the peach")
        expect(tab.locator("#answers .answer").first).to_be_in_viewport(ratio=0.9)
        expect(tab.locator("#said > li p").last).to_be_in_viewport()
        expect(tab.locator("#words")).to_be_in_viewport(ratio=1)
        end_task(tab, "I give up")

    viewport = {"width": size[0], "height": size[1]}
    with led(data, "P01") as one, opened(browser, one.page, viewport=viewport) as tab:
        take_part(tab, random.Random(0), look)


def test_when_the_time_is_over_the_participant_is_led_on(browser: Browser, tmp_path: Path) -> None:
    data = data_in(tmp_path, study_of(1, limit_s=0.5))
    with led(data, "P01") as one, opened(browser, one.page) as tab:
        take_part(tab, random.Random(0), lambda tab, chance: None, until="questionnaire")
        expect(tab.locator("#sheet")).to_contain_text("The time for the last task is over.")
        take_part(tab, random.Random(0))
    assert [row.ended for row in tables(data).results] == ["time"]


def test_two_pages_of_a_participant_show_the_same_and_do_a_thing_once(
    browser: Browser, tmp_path: Path
) -> None:
    data = data_in(tmp_path, study_of(1))
    with (
        led(data, "P01") as one,
        opened(browser, one.page) as tab,
        opened(browser, one.page) as other,
    ):
        take_part(tab, random.Random(0), until="questionnaire")
        assert next_step(other, "consent/0/")[1] == "questionnaire"
        assert one.page.sends("task/1/t0", "finished") == (409, "This is over.")
        take_part(other, random.Random(0))
        expect(tab.locator("#sheet-title")).to_have_text("Thank you")
    assert len(tables(data).answers) == 10


def test_what_is_left_out_is_told_and_focused(browser: Browser, tmp_path: Path) -> None:
    data = data_in(tmp_path, study_of(1, at_start=["nasa_tlx"], after_each=[]))
    with led(data, "P01", to_the_end=False) as one, opened(browser, one.page) as tab:
        take_part(tab, random.Random(0), until="questionnaire")
        tab.locator("input[type=range]").first.press("Enter")
        tab.get_by_role("button", name="Send my answers").click()
        expect(tab.get_by_role("alert").last).to_have_text("Still to be answered: 5.")
        expect(tab.locator("input[type=range]").nth(1)).to_be_focused()
        expect(tab.locator(".missing:visible")).to_have_count(5)
        tab.locator("input[type=range]").nth(1).press("Enter")
        expect(tab.get_by_role("alert").last).to_have_text("Still to be answered: 4.")
        expect(tab.locator(".missing:visible")).to_have_count(4)
        tab.reload()
        expect(tab.locator("input[type=range].unset")).to_have_count(4)
        take_part(tab, random.Random(0), until="part")
    assert [row.points for row in tables(data).answers] == [11] * 6


def test_a_finger_chooses_the_middle_of_a_slider_too(browser: Browser, tmp_path: Path) -> None:
    data = data_in(tmp_path, study_of(1, at_start=["nasa_tlx"], after_each=[]))
    with (
        led(data, "P01", to_the_end=False) as one,
        opened(browser, one.page, viewport=PHONE, has_touch=True, is_mobile=True) as tab,
    ):
        take_part(tab, random.Random(0), until="questionnaire")
        for slider in tab.locator("input[type=range]").all():
            slider.tap()
        expect(tab.locator("input[type=range].unset")).to_have_count(0)
        tab.get_by_role("button", name="Send my answers").tap()
        next_step(tab, "questionnaire/0/nasa_tlx")
    assert [row.points for row in tables(data).answers] == [11] * 6


@pytest.mark.parametrize(
    ("size", "colors"),
    [(DESKTOP, "light"), (SMALLEST, "dark")],
    ids=["desktop", "smallest"],
)
def test_axe_finds_no_fault_and_nothing_is_cut_off(
    browser: Browser, tmp_path: Path, size: dict[str, int], colors: str
) -> None:
    free = {"title": "Words", "items": [{"name": "w", "text": "Why?", "answer": "words"}]}
    asked = ["sus", "nasa_tlx", "godspeed", "free"]
    study = study_of(1, after_each=asked, questionnaires={"free": free})
    wrong: list[str] = []

    def look(tab: Tab) -> None:
        if tab.get_by_role("button", name="Send my answers").count():
            tab.get_by_role("button", name="Send my answers").click()  # what is missing is told
        wrong.extend(faults(tab))
        wide = tab.evaluate("document.documentElement.scrollWidth")
        wrong.extend([f"{wide} pixels wide"] * (wide > size["width"]))

    with (
        led(data_in(tmp_path, study), "P01") as one,
        opened(browser, one.page, viewport=size, color_scheme=colors) as tab,
    ):
        take_part(tab, random.Random(0), look=look)
    assert not wrong


def test_one_who_is_killed_in_the_middle_goes_on_and_no_row_is_lost(
    browser: Browser, tmp_path: Path
) -> None:
    study, chance = study_of(2), random.Random(0)
    file = written(study, tmp_path)
    with begun(file, tmp_path / "data") as (process, page), opened(browser, page) as tab:
        take_part(tab, chance, until="questionnaire")
        tab.locator("input[type=radio]").first.check()
        process.send_signal(signal.SIGKILL)
    with (
        begun(file, tmp_path / "data", "--participant", "P01") as (process, page),
        opened(browser, page) as tab,
    ):
        steps = take_part(tab, chance)
        assert process.wait(PATIENCE_S) == 0
    assert steps == ["questionnaire/1/sus", "part/2/", "task/2/t0", "questionnaire/2/sus"]
    made = read_rows(tmp_path / "data/results.parquet")
    assert [(row["condition"], row["attempts"]) for row in made] == [("a", 1), ("b", 1)]
