"""A real browser, driven as a person would: by what is seen, with mouse, keyboard or a finger."""

import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from patience import PATIENCE_S
from playwright.sync_api import Browser, Locator, expect, sync_playwright
from playwright.sync_api import Page as Tab

from executive.page.page import Page

DESKTOP = {"width": 1280, "height": 800}
PHONE = {"width": 390, "height": 844}
SMALLEST = {"width": 320, "height": 480}
PATIENCE_MS = 1000 * PATIENCE_S

expect.set_options(timeout=PATIENCE_MS)


@contextmanager
def chromium() -> Iterator[Browser]:
    """Debian's Chromium, without a window."""
    path = shutil.which("chromium")
    assert path, "these tests need Debian's chromium: apt-get install chromium"
    with sync_playwright() as started:
        browser = started.chromium.launch(executable_path=path, args=["--no-sandbox"])
        try:
            yield browser
        finally:
            browser.close()


@contextmanager
def opened(
    browser: Browser, page: Page, url: str = "", *, first: str = "", **given: Any
) -> Iterator[Tab]:
    """A tab of its own with the page in it; whatever goes wrong in its scripts is an error.

    Another page of the same robot is given by its address; `first` runs before its scripts.
    """
    context = browser.new_context(**{"viewport": DESKTOP, **given})
    context.add_init_script(first)
    context.set_default_timeout(PATIENCE_MS)
    tab = context.new_page()
    wrong: list[str] = []
    tab.on("pageerror", lambda error: wrong.append(str(error)))
    tab.on("dialog", lambda dialog: wrong.append(dialog.message))
    try:
        tab.goto(url or page.url)
        yield tab
        assert not wrong
    finally:
        context.close()


def say(tab: Tab, words: str) -> None:
    """Type words, and press Enter."""
    tab.locator("#words").fill(words)
    tab.locator("#words").press("Enter")


def answer(tab: Tab, label: str) -> Locator:
    """The button of an answer."""
    return tab.locator("#answers").get_by_role("button", name=label, exact=True)


def said(tab: Tab) -> list[str]:
    """The conversation, as it is read."""
    return tab.locator("#said > li > p").all_inner_texts()


def wait_until_ready(tab: Tab) -> None:
    """Until the robot listens for a command."""
    expect(tab.locator("#doing")).to_have_text("I am ready. What can I do for you?")
