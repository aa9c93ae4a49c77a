"""Everyone can use the page: no rule of WCAG 2.2 AA that a program can check is broken."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from axe_playwright_python.sync_playwright import Axe
from browsing import DESKTOP, PHONE, SMALLEST, answer, opened, say, wait_until_ready
from paging import Robot, robot
from playwright.sync_api import Browser, expect
from playwright.sync_api import Page as Tab
from speaking_browser import STUBS

pytestmark = pytest.mark.browser

RULES = {
    "runOnly": ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa", "best-practice"],
    "resultTypes": ["violations"],
}


@pytest.fixture(scope="module")
def found(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Robot]:
    """A robot that has found something, and now asks where another thing is."""
    with robot(tmp_path_factory.mktemp("runs"), recorded=True) as made:
        yield made


@contextmanager
def asked(browser: Browser, robot: Robot, **given: object) -> Iterator[Tab]:
    """The page after a mission, with a reason shown, while the robot asks for a place."""
    with opened(browser, robot.page, **given) as tab:
        if not robot.outcomes:
            wait_until_ready(tab)
            say(tab, "Find the peach")
            answer(tab, "sofa").click()
            answer(tab, "high table").click()
            wait_until_ready(tab)
            say(tab, "Bring a fruit")
        tab.locator(".why").nth(1).click()
        expect(tab.locator(".because li").first).to_be_visible()
        yield tab


def faults(tab: Tab) -> list[str]:
    response = Axe().run(tab, options=RULES).response
    return [
        f"{fault['id']}: {node['html'][:120]} {node.get('failureSummary', '')[:300]}"
        for fault in response["violations"]
        for node in fault["nodes"]
    ]


@pytest.mark.parametrize("colors", ["light", "dark"])
@pytest.mark.parametrize("size", [DESKTOP, PHONE], ids=["desktop", "phone"])
def test_axe_finds_no_fault(
    browser: Browser, found: Robot, size: dict[str, int], colors: str
) -> None:
    with asked(browser, found, viewport=size, color_scheme=colors) as tab:
        assert not faults(tab)
        if size is PHONE:
            tab.get_by_role("button", name="Home and camera").click()
            assert not faults(tab)


def test_axe_finds_no_fault_before_anything_is_said(browser: Browser, tmp_path: Path) -> None:
    with robot(tmp_path) as made, opened(browser, made.page) as tab:
        wait_until_ready(tab)
        expect(tab.locator("#suggestions .answer").first).to_be_visible()
        assert not faults(tab)


@pytest.mark.parametrize("size", [SMALLEST, {"width": 320, "height": 256}], ids=["phone", "zoomed"])
@pytest.mark.parametrize("letters", ["16px", "32px"])
def test_on_the_smallest_screen_with_large_letters_nothing_is_cut_off(
    browser: Browser, found: Robot, size: dict[str, int], letters: str
) -> None:
    with asked(browser, found, viewport=size) as tab:
        tab.evaluate(f"document.documentElement.style.fontSize = '{letters}'")
        for view in ("Talk", "Home and camera"):
            tab.get_by_role("button", name=view).click()
            wide = tab.evaluate("document.documentElement.scrollWidth")
            assert wide <= size["width"]
            tab.evaluate("scrollTo(0, document.documentElement.scrollHeight)")
            expect(tab.locator("#stop")).to_be_in_viewport(ratio=0.9)


@pytest.mark.parametrize("size", [(320, 568), (640, 360)], ids=["small", "on its side"])
def test_on_a_small_phone_the_question_and_answers_to_it_are_seen_at_once(
    browser: Browser, found: Robot, size: tuple[int, int]
) -> None:
    with asked(browser, found):
        pass
    with opened(browser, found.page, viewport={"width": size[0], "height": size[1]}) as tab:
        expect(tab.locator("#said > li p").last).to_be_in_viewport()
        expect(tab.locator("#answers .answer").first).to_be_in_viewport(ratio=0.9)
        expect(tab.locator("#words")).to_be_in_viewport(ratio=0.9)


@pytest.mark.parametrize("width", [320, 390])
def test_on_a_phone_what_may_be_typed_first_is_read_whole(
    browser: Browser, found: Robot, width: int
) -> None:
    viewport = {"width": width, "height": 640}
    with opened(browser, found.page, viewport=viewport, first=STUBS) as tab:
        expect(tab.locator("#speak")).to_be_visible()
        letters, room = tab.evaluate(
            """() => {
              const box = document.querySelector("#words"), style = getComputedStyle(box);
              const ruler = document.createElement("canvas").getContext("2d");
              ruler.font = style.font;
              const padding = parseFloat(style.paddingLeft) + parseFloat(style.paddingRight);
              return [ruler.measureText(box.placeholder).width, box.clientWidth - padding];
            }"""
        )
        assert 0 < letters <= room


def test_what_is_pressed_is_large_enough_for_a_finger(browser: Browser, found: Robot) -> None:
    with asked(browser, found, viewport=PHONE) as tab:
        for button in tab.locator("button:visible").all():
            box = button.bounding_box()
            assert box is not None
            assert min(box["width"], box["height"]) >= 24
        stop = tab.locator("#stop").bounding_box()
        assert stop is not None
        assert min(stop["width"], stop["height"]) >= 60


def test_what_is_said_is_announced_and_the_stop_has_its_key(browser: Browser, found: Robot) -> None:
    with asked(browser, found) as tab:
        assert tab.get_by_role("log").get_by_text("Where is the").count()
        doing = tab.get_by_role("status").filter(has=tab.locator("#doing"))
        expect(doing).to_have_text("I am waiting for your answer.")
        assert tab.locator("#stop").get_attribute("aria-keyshortcuts") == "Escape"
