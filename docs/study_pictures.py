"""Makes the pictures of docs/study.md: `python docs/study_pictures.py`, with Debian's chromium.

A participant is led through the example's study, in the simulated home.
"""

import re
import subprocess
import sys
import tempfile
from pathlib import Path

from playwright.sync_api import Page, expect, sync_playwright

HERE = Path(__file__).parent
PATIENCE_MS = 600_000
DESKTOP = {"width": 1440, "height": 900}
PHONE = {"width": 390, "height": 780}


def begin(data: str) -> tuple["subprocess.Popen[str]", str]:
    """Begin with a participant; the process, and the address of their page."""
    study = str(HERE / "examples/study.toml")
    command = [sys.executable, "-m", "executive.page", "study", study]
    process = subprocess.Popen(
        [*command, "--data", data, "--page", "0"], stderr=subprocess.PIPE, text=True
    )
    assert process.stderr is not None
    for line in process.stderr:
        if found := re.search(r"open (http\S+)", line):
            return process, found[1]
    raise SystemExit("the study did not begin")


def take_pictures(tab: Page) -> None:
    """One of a task, one of the questionnaire after it, on a phone."""
    tab.get_by_role("button", name="I agree and take part").click()
    expect(tab.locator("#sheet-title")).to_have_text("How it works")
    tab.get_by_role("button", name="Go on").click()
    expect(tab.locator("#sheet-title")).to_have_text("Part 1 of 2")
    tab.get_by_role("button", name="Go on").click()
    for number in (1, 2):
        expect(tab.locator("#task-title")).to_contain_text(f"({number} of 2)")
        expect(tab.locator("#doing")).to_contain_text("I am ready", timeout=PATIENCE_MS)
        if number == 1:
            tab.fill("#words", "Bring me an apple")
            tab.keyboard.press("Enter")
            tab.locator(".picture rect").first.wait_for(state="attached", timeout=PATIENCE_MS)
            tab.screenshot(path=HERE / "study.png")
        tab.get_by_role("button", name="I have done it").click()
        tab.get_by_role("button", name="Yes", exact=True).click()
    expect(tab.locator("#sheet-title")).to_have_text("How it was to use the robot")
    tab.set_viewport_size(PHONE)
    for item, point in zip(tab.locator("fieldset.item").all(), (3, 1), strict=False):
        item.locator("input").nth(point).check()
    tab.evaluate("scrollTo(0, 0)")
    tab.screenshot(path=HERE / "study-phone.png")


def main() -> None:
    """Lead one participant, take the pictures, end it."""
    with tempfile.TemporaryDirectory() as data, sync_playwright() as started:
        process, url = begin(data)
        browser = started.chromium.launch(
            executable_path="/usr/bin/chromium", args=["--no-sandbox"]
        )
        try:
            tab = browser.new_page(viewport=DESKTOP)
            tab.goto(url)
            take_pictures(tab)
        finally:
            browser.close()
            process.terminate()
            process.wait(60)


if __name__ == "__main__":
    main()
