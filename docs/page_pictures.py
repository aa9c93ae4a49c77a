"""Makes the pictures of docs/page.md: `python docs/page_pictures.py`, with Debian's chromium.

Missions in the simulated home are talked through in the page, as a person would, and looked at in
the experimenter's. With the names of pictures, only these are kept.
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


def begin(runs: str) -> tuple["subprocess.Popen[str]", str, str]:
    """Start the robot; its process, and the addresses of both pages."""
    command = [sys.executable, "-m", "executive", "--page", "0", "--page-experimenter"]
    elsewhere = ["--place", "sugar_box=high_table"]  # not where it is looked for first
    process = subprocess.Popen(
        [*command, *elsewhere, "--runs", runs], stderr=subprocess.PIPE, text=True
    )
    assert process.stderr is not None
    found: list[str] = []
    for line in process.stderr:
        found += re.findall(r"http\S+token=\S+", line)
        if len(found) == 2:
            return process, found[0], found[1]
    raise SystemExit("the robot did not start")


def keep(tab: Page, name: str) -> None:
    """Take a picture, if it is wanted."""
    wanted = sys.argv[1:]
    if not wanted or name in wanted:
        tab.screenshot(path=HERE / name)


def ready(tab: Page) -> None:
    """Wait until it listens."""
    expect(tab.locator("#doing")).to_contain_text("I am ready", timeout=PATIENCE_MS)


def say(tab: Page, words: str) -> None:
    """Say something."""
    tab.fill("#words", words)
    tab.keyboard.press("Enter")


def do(tab: Page, words: str) -> None:
    """Have something done, and wait for it."""
    say(tab, words)
    expect(tab.locator("#doing")).not_to_contain_text("I am ready", timeout=PATIENCE_MS)
    ready(tab)


def of_the_person(tab: Page) -> None:
    """One while it looks for something, one in the dark with a reason, one on a phone."""
    ready(tab)
    say(tab, "Bring a sugar_box")
    tab.locator(".picture rect").first.wait_for(state="attached", timeout=PATIENCE_MS)
    keep(tab, "page.png")
    ready(tab)
    tab.emulate_media(color_scheme="dark")
    tab.get_by_role("button", name=re.compile("^Why did the robot say: I look")).first.click()
    tab.locator(".because li").first.wait_for()
    keep(tab, "page-dark.png")
    tab.emulate_media(color_scheme="light")
    tab.set_viewport_size(PHONE)
    say(tab, "Find a fruit")
    expect(tab.locator("#doing")).to_contain_text("I am waiting", timeout=PATIENCE_MS)
    for picture in tab.locator("#answers img").all():
        expect(picture).to_have_js_property("naturalWidth", 160, timeout=PATIENCE_MS)
    keep(tab, "page-phone.png")
    tab.keyboard.press("Escape")
    expect(tab.locator("#last")).to_contain_text("stopped", timeout=PATIENCE_MS)


def of_the_experimenter(desk: Page, tab: Page) -> None:
    """One with a choice of a place held, one with two runs, one on a phone."""
    for _ in range(2):  # the robot knows the same before the second and before the third
        do(tab, "Find the sugar_box")
    desk.get_by_label("Your name").fill("Anna")
    desk.get_by_label("Hold where it goes next").click()
    say(tab, "Find the sugar_box")
    desk.locator("#wizard .choice").wait_for()
    desk.get_by_role("button", name="Send there instead").click()
    desk.locator("#wizard .choice").wait_for(state="hidden")
    desk.get_by_label("Hold where it goes next").click()
    ready(tab)
    desk.get_by_label("Hold what the robot says").click()
    desk.get_by_label("Hold where it goes next").click()
    say(tab, "Find a fruit")
    desk.get_by_label("Held sentence 1").wait_for()
    desk.locator("#wizard").get_by_role("button", name="peach").click()
    desk.locator("#wizard .choice").wait_for()
    desk.wait_for_timeout(1000)
    desk.locator("#live [role=treeitem]").filter(has_text="choice").first.click()
    desk.locator("#live .why .shape").wait_for()
    keep(desk, "experiment.png")
    desk.emulate_media(color_scheme="dark")
    desk.set_viewport_size(PHONE)
    desk.wait_for_timeout(500)
    keep(desk, "experiment-phone.png")
    desk.emulate_media(color_scheme="light")
    desk.set_viewport_size(DESKTOP)
    desk.get_by_role("button", name="Past runs").click()
    desk.get_by_label("Words", exact=True).fill("sugar find")
    expect(desk.locator("#runs tbody tr")).to_have_count(3)
    for box in desk.locator("#runs tbody input").all()[:2]:  # the latest first
        box.check()
    desk.get_by_role("button", name="Two side by side").click()
    expect(desk.locator("#two .moment").last).to_contain_text("Tick", timeout=PATIENCE_MS)
    desk.wait_for_timeout(1500)
    keep(desk, "experiment-two.png")


def main() -> None:
    """Run the robot, take the pictures, end it."""
    with tempfile.TemporaryDirectory() as runs, sync_playwright() as started:
        process, url, experimenter = begin(runs)
        browser = started.chromium.launch(
            executable_path="/usr/bin/chromium", args=["--no-sandbox"]
        )
        try:
            tab, desk = (browser.new_page(viewport=DESKTOP) for _ in range(2))
            tab.goto(url)
            desk.goto(experimenter)
            of_the_person(tab)
            of_the_experimenter(desk, tab)
        finally:
            browser.close()
            process.terminate()
            process.wait(60)


if __name__ == "__main__":
    main()
