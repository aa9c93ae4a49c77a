"""Speech by the browser: what it hears is asked back, what the robot says is said aloud.

Recogniser and voice of the browser are stubs, but for one test.
"""

from pathlib import Path

import pytest
from axe_playwright_python.sync_playwright import Axe
from browsing import PHONE, SMALLEST, answer, opened, said, say, wait_until_ready
from paging import Robot, robot
from playwright.sync_api import Browser, Locator, Route, expect
from playwright.sync_api import Page as Tab
from speaking_browser import NO_SPEECH, STUBS, aloud, fail, hear

from executive.events import Listened
from executive.replay import replay
from logs.recording.reader import Run

pytestmark = pytest.mark.browser

FOUND = "Find the peach at the high table"


def speak(tab: Tab) -> Locator:
    """The button that begins to listen."""
    return tab.get_by_role("button", name="Speak")


def settle(tab: Tab, label: str) -> Locator:
    """A button under what is asked back."""
    return tab.locator("#asked-back").get_by_role("button", name=label, exact=True)


@pytest.mark.parametrize("how", ["button", "heard", "typed"])
def test_a_command_that_is_heard_is_asked_back_and_done_after_a_yes(
    browser: Browser, talking: Robot, how: str
) -> None:
    with opened(browser, talking.page, first=STUBS) as tab:
        wait_until_ready(tab)
        speak(tab).click()
        hear(tab, FOUND)
        expect(tab.get_by_role("group", name=f"Did you say: {FOUND}?")).to_be_visible()
        assert not talking.outcomes
        if how == "button":
            settle(tab, "Yes").click()
        elif how == "typed":
            say(tab, "yes")
        else:
            tab.keyboard.press("F2")
            hear(tab, "Yes.")
        assert talking.ended(1).status == "done"
        expect(tab.locator("#asked-back")).to_be_hidden()
        assert said(tab).count(f"You:\n{FOUND}") == 1


def test_what_was_heard_is_recorded_and_replays(browser: Browser, talking: Robot) -> None:
    with opened(browser, talking.page, first=STUBS) as tab:
        wait_until_ready(tab)
        speak(tab).click()
        hear(tab, FOUND, confidence=0.5)
        settle(tab, "Yes").click()
        folder = talking.ended(1).run_dir
    assert folder
    events = (at.value for at in Run(Path(folder)).events())
    heard = [event for event in events if isinstance(event, Listened)]
    assert heard == [Listened("browser", FOUND, 0.5, "asked back")]
    assert replay(Path(folder) / "mission.mcap").parting is None


def test_a_no_takes_it_back(browser: Browser, talking: Robot) -> None:
    with opened(browser, talking.page, first=STUBS) as tab:
        wait_until_ready(tab)
        speak(tab).click()
        hear(tab, FOUND)
        settle(tab, "No").click()
        expect(tab.locator("#said .robot").last).to_contain_text("Then I will not.")
        expect(tab.locator("#asked-back")).to_be_hidden()
    assert not talking.outcomes


@pytest.mark.parametrize("words", ["stop", "bring the mug no stop"])
def test_a_stop_stops_while_one_still_speaks(browser: Browser, talking: Robot, words: str) -> None:
    with opened(browser, talking.page, first=STUBS) as tab:
        wait_until_ready(tab)
        say(tab, "Find a fruit")
        expect(answer(tab, "peach")).to_be_visible()
        tab.keyboard.press("F2")
        hear(tab, "bring", final=False)
        hear(tab, words, final=False)
        assert talking.ended(1).status == "stopped"
        expect(speak(tab)).to_have_attribute("aria-pressed", "false")
        assert tab.evaluate("recogniser.aborted")
        assert not any("Did you say" in line for line in said(tab))
        assert said(tab).count("Robot:\nStopping.") == 1


def test_the_answer_to_a_question_is_asked_back_beside_it(browser: Browser, talking: Robot) -> None:
    with opened(browser, talking.page, first=STUBS) as tab:
        wait_until_ready(tab)
        say(tab, "Find a fruit")
        expect(answer(tab, "peach")).to_be_visible()
        speak(tab).click()
        hear(tab, "beach", "peach")
        expect(tab.locator("#asked-back")).to_contain_text("Did you say: peach?")
        expect(answer(tab, "banana")).to_be_visible()
        settle(tab, "Yes").click()
        expect(answer(tab, "high table")).to_be_visible()


@pytest.mark.parametrize("how", ["Escape", "typed", "chosen"])
def test_whatever_else_is_done_takes_the_place_of_what_is_asked_back(
    browser: Browser, talking: Robot, how: str
) -> None:
    with opened(browser, talking.page, first=STUBS) as tab:
        wait_until_ready(tab)
        say(tab, "Find a fruit")
        expect(answer(tab, "peach")).to_be_visible()
        speak(tab).click()
        hear(tab, "bring the mug")
        expect(settle(tab, "Yes")).to_be_visible()
        if how == "Escape":
            tab.keyboard.press(how)
        elif how == "typed":
            say(tab, "peach")
        else:
            answer(tab, "peach").click()
        expect(tab.locator("#asked-back")).to_be_hidden()


def test_a_yes_that_comes_too_late_does_nothing_and_is_told(
    browser: Browser, talking: Robot
) -> None:
    def meanwhile(route: Route) -> None:
        """On another page they were faster."""
        assert talking.page.settles(1, agrees=False)
        route.continue_()

    with opened(browser, talking.page, first=STUBS) as tab:
        wait_until_ready(tab)
        speak(tab).click()
        hear(tab, FOUND)
        expect(settle(tab, "Yes")).to_be_visible()
        tab.route("**/settle*", meanwhile)
        settle(tab, "Yes").click()
        expect(tab.get_by_role("alert")).to_contain_text("came when its question was over")
    assert not talking.outcomes


def test_where_the_browser_has_no_speech_nothing_is_offered(
    browser: Browser, talking: Robot
) -> None:
    with opened(browser, talking.page, first=NO_SPEECH) as tab:
        wait_until_ready(tab)
        say(tab, "hello")
        expect(tab.locator("#said .robot")).to_have_count(1)
        expect(speak(tab)).to_be_hidden()
        expect(tab.get_by_role("switch")).to_be_hidden()


TROUBLE = {
    "not-allowed": "does not let this page hear you",
    "network": "needs the internet",
    "audio-capture": "no microphone",
    "no-speech": "heard nothing",
    "odd": "could not listen (odd)",
}


@pytest.mark.parametrize("error", TROUBLE)
def test_why_it_cannot_listen_is_told_in_words(
    browser: Browser, talking: Robot, error: str
) -> None:
    with opened(browser, talking.page, first=STUBS) as tab:
        wait_until_ready(tab)
        speak(tab).click()
        expect(tab.locator("#hearing")).to_have_text("I am listening.")
        fail(tab, error)
        expect(tab.locator("#hearing")).to_contain_text(TROUBLE[error])
        expect(speak(tab)).to_have_attribute("aria-pressed", "false")


def test_a_real_browser_that_may_not_listen_says_so(browser: Browser, talking: Robot) -> None:
    """Chromium without a window refuses the microphone by itself."""
    with opened(browser, talking.page) as tab:
        wait_until_ready(tab)
        tab.keyboard.press("F2")
        expect(tab.locator("#hearing")).to_contain_text("does not let this page hear you")


def test_what_was_heard_and_is_lost_on_the_way_is_told(browser: Browser, talking: Robot) -> None:
    with opened(browser, talking.page, first=STUBS) as tab:
        wait_until_ready(tab)
        tab.route("**/heard*", lambda route: route.abort())
        speak(tab).click()
        hear(tab, FOUND)
        expect(tab.locator("#hearing")).to_contain_text("has not reached the robot")


def test_what_the_robot_says_is_said_aloud_if_that_is_wanted(
    browser: Browser, talking: Robot
) -> None:
    with opened(browser, talking.page, first=STUBS) as tab:
        wait_until_ready(tab)
        say(tab, "hello")
        expect(tab.locator("#said .robot")).to_have_count(1)
        assert not aloud(tab)
        tab.get_by_role("switch", name="Read aloud").check()
        say(tab, "hello")
        assert aloud(tab, 1) == ["Hello!"]
        tab.reload()  # it is remembered, and nothing is said twice
        wait_until_ready(tab)
        expect(tab.get_by_role("switch")).to_be_checked()
        say(tab, "Find a fruit")
        [question] = aloud(tab, 1)
        assert "Which" in question


def test_a_stop_and_one_who_speaks_silence_the_voice(browser: Browser, talking: Robot) -> None:
    with opened(browser, talking.page, first=STUBS) as tab:
        wait_until_ready(tab)
        tab.get_by_role("switch").check()
        say(tab, "Find a fruit")
        aloud(tab, 1)
        hushed = tab.evaluate("hushed")
        speak(tab).click()
        assert tab.evaluate("hushed") == hushed + 1
        talking.page.person.mention("I say this meanwhile.")
        expect(tab.locator("#said")).to_contain_text("meanwhile")
        tab.wait_for_timeout(300)
        assert len(aloud(tab)) == 1
        tab.keyboard.press("Escape")
        assert tab.evaluate("hushed") > hushed + 1
        assert "Stopping" in aloud(tab, 2)[-1]


@pytest.mark.parametrize("size", [PHONE, SMALLEST], ids=["phone", "smallest"])
@pytest.mark.parametrize("letters", ["16px", "32px"])
def test_everyone_can_speak(
    browser: Browser, tmp_path: Path, size: dict[str, int], letters: str
) -> None:
    rules = {"runOnly": ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa", "best-practice"]}
    with (
        robot(tmp_path) as made,
        opened(browser, made.page, first=STUBS, viewport=size) as tab,
    ):
        wait_until_ready(tab)
        tab.evaluate(f"document.documentElement.style.fontSize = '{letters}'")
        speak(tab).click()
        hear(tab, "bring the mug", final=False)
        expect(tab.locator("#interim")).to_have_text("bring the mug")
        hear(tab, "bring the mug")
        tab.get_by_text("About speaking").click()
        expect(tab.get_by_text("send the sound of your voice to their maker")).to_be_visible()
        settle(tab, "Yes").focus()
        assert tab.evaluate("document.documentElement.scrollWidth") <= size["width"]
        assert not Axe().run(tab, options=rules).response["violations"]
