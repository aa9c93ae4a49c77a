"""Makes the pictures of docs/page.md: `python docs/page_pictures.py`, with Debian's chromium.

A mission in the simulated home is talked through in the page, as a person would.
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


def begin(runs: str) -> tuple["subprocess.Popen[str]", str]:
    """Start the robot; its process, and the address of its page."""
    command = [sys.executable, "-m", "executive", "--page", "0", "--runs", runs]
    process = subprocess.Popen(command, stderr=subprocess.PIPE, text=True)
    assert process.stderr is not None
    for line in process.stderr:
        if found := re.search(r"Open (http\S+)", line):
            return process, found[1]
    raise SystemExit("the robot did not start")


def ready(tab: Page) -> None:
    """Wait until it listens."""
    expect(tab.locator("#doing")).to_contain_text("I am ready", timeout=PATIENCE_MS)


def take_pictures(tab: Page) -> None:
    """One while it looks for something, one in the dark with a reason, one on a phone."""
    ready(tab)
    tab.fill("#words", "Bring a sugar_box")
    tab.keyboard.press("Enter")
    tab.locator(".picture rect").first.wait_for(state="attached", timeout=PATIENCE_MS)
    tab.screenshot(path=HERE / "page.png")
    ready(tab)
    tab.emulate_media(color_scheme="dark")
    tab.get_by_role("button", name=re.compile("^Why did the robot say: I look")).first.click()
    tab.locator(".because li").first.wait_for()
    tab.screenshot(path=HERE / "page-dark.png")
    tab.emulate_media(color_scheme="light")
    tab.set_viewport_size(PHONE)
    tab.fill("#words", "Find a fruit")
    tab.keyboard.press("Enter")
    tab.locator("#answers img").last.wait_for()
    tab.wait_for_timeout(1000)
    tab.locator("#answers").evaluate("box => { box.scrollTop = 0; }")
    tab.screenshot(path=HERE / "page-phone.png")


def main() -> None:
    """Run the robot, take the pictures, end it."""
    with tempfile.TemporaryDirectory() as runs, sync_playwright() as started:
        process, url = begin(runs)
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
