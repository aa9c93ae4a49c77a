"""What the page costs: `python tests/benchmarks/bench_page.py`, with Debian's chromium.

How long it takes from what happens to its being in the page; what an open page costs while nothing
happens; how much slower missions in physics are while two pages show them.
"""

import argparse
import sys
import time
from contextlib import ExitStack
from datetime import UTC, datetime
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory

sys.path.insert(0, str(Path(__file__).parents[1] / "helpers"))

from browsing import chromium, opened
from playwright.sync_api import Browser
from playwright.sync_api import Page as Tab

from executive import Session, load_settings
from executive.events import Inbox
from executive.page.address import Address
from executive.page.page import Page
from executive.page.plan import plan
from executive.records import PlannedPath
from logs.recorder import FanOut
from sim.home.home_file import load_home

APPEARED = """() => {
  window.appeared = [];
  const note = () => requestAnimationFrame(() => window.appeared.push(Date.now() / 1000));
  const watch = (id) => new MutationObserver(note).observe(
    document.getElementById(id), { childList: true, subtree: true });
  watch("said");
  watch("map");
}"""
WORDS = "Bring a sugar_box"


def delays(tab: Tab, happen: list[float]) -> list[float]:
    """Seconds from each thing that happened to the first frame that shows it."""
    tab.wait_for_timeout(500)
    appeared = sorted(tab.evaluate("window.appeared"))
    return [next(at for at in appeared if at >= began) - began for began in happen]


def said(page: Page) -> None:
    """The robot says something."""
    page.board.say({"who": "robot", "text": "Hello", "at": time.time()})


def from_event_to_page(page: Page, tab: Tab, times: int) -> None:
    """Sentences come at once; what is recorded, with the recorder's next round."""
    page.board.put("home", plan(load_home("four_rooms")))
    page.board.flush()
    recorder = FanOut(lambda: 0.0)
    recorder.open([page.sink], datetime.now(UTC))

    def moved(number: int) -> None:
        recorder.record(PlannedPath(((0.0, 0.0, 0.0), (1.0, number / 100, 0.0))))

    for name, happen in (("said", lambda n: said(page)), ("recorded", moved)):
        tab.wait_for_timeout(500)
        tab.evaluate(APPEARED)
        began = []
        for number in range(times):
            tab.wait_for_timeout(97 + number % 61)
            began.append(time.time())
            happen(number)
        found = sorted(delays(tab, began))
        print(
            f"{name}: median {median(found) * 1e3:.0f} ms, "
            f"95 % within {found[int(0.95 * len(found))] * 1e3:.0f} ms, of {times}"
        )
    recorder.close()


def idle(seconds: float) -> None:
    """This process's share of a core while two pages are open and nothing happens."""
    before = time.process_time()
    time.sleep(seconds)
    share = (time.process_time() - before) / seconds
    print(f"idle, two pages open: {share:.2%} of a core")


def mission(page: Page | None, runs: Path, seed: int) -> tuple[float, float]:
    """CPU time and time of one mission in physics (s), shown or not."""
    settings = load_settings(
        llm="none", user="oracle", detector="simulated", runs=runs, seed=seed, world="physics"
    )
    shown = {"sinks": [page.sink]} if page else {}
    with Session(settings, **shown) as session:
        if page:
            page.follow(session)
        cpu, began = time.process_time(), time.monotonic()
        session.run(WORDS)
        return time.process_time() - cpu, time.monotonic() - began


def overhead(browser: Browser, page: Page, runs: Path, missions: int) -> None:
    """Missions in turn: without a page, with one that nobody has opened, with one open, with two.

    The browser is a process of its own; what counts is this one.
    """
    mission(None, runs, 0)
    ways = {"without a page": None, "none open": 0, "one open": 1, "two open": 2}
    took: dict[str, list[tuple[float, float]]] = {way: [] for way in ways}
    for number in range(missions):
        for way, count in ways.items():
            with ExitStack() as stack:
                for _ in range(count or 0):
                    stack.enter_context(opened(browser, page))
                took[way].append(mission(None if count is None else page, runs, number))
    for index, name in enumerate(("processor time of this process", "time")):
        plain = [one[index] for one in took["without a page"]]
        print(f"a mission, {name}: {median(plain):.2f} s without a page")
        for way in list(ways)[1:]:
            more = [one[index] / of - 1 for one, of in zip(took[way], plain, strict=True)]
            print(f"  {way}: {median(more):+.1%}")


def main() -> None:
    """Measure."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--times", type=int, default=200)
    parser.add_argument("--idle-s", type=float, default=20.0)
    parser.add_argument("--missions", type=int, default=7)
    options = parser.parse_args()
    with ExitStack() as stack:
        runs = Path(stack.enter_context(TemporaryDirectory()))
        page = stack.enter_context(Page(Inbox(), Address(port=0)))
        browser = stack.enter_context(chromium())
        with ExitStack() as two:
            tab, _ = (two.enter_context(opened(browser, page)) for _ in range(2))
            tab.wait_for_timeout(2000)
            if options.times:
                from_event_to_page(page, tab, options.times)
            if options.idle_s:
                idle(options.idle_s)
        if options.missions:
            overhead(browser, page, runs, options.missions)


if __name__ == "__main__":
    main()
