"""What the page costs: `python tests/benchmarks/bench_page.py`, with Debian's chromium.

How long it takes from what happens to its being in the page; what an open page costs while nothing
happens; what missions in physics take while pages show them, the page's part of it, and what the
browser takes beside it.
"""

import argparse
import sys
import threading
import time
from contextlib import ExitStack
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory

sys.path.insert(0, str(Path(__file__).parents[1] / "helpers"))

import psutil
from browsing import chromium, opened
from playwright.sync_api import Browser
from playwright.sync_api import Page as Tab
from served import served_process
from stopwatch import Stopwatch

from executive import Session, load_settings
from executive.events import Inbox
from executive.language.wording import Wording
from executive.page.address import Address
from executive.page.page import Page
from executive.page.plan import plan
from executive.page.sink import PageSink
from executive.records import PlannedPath
from executive.user import Scripted
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
    page.board.put("home", plan(load_home("four_rooms"), Wording(lambda name: None)))
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


@dataclass(frozen=True)
class Cost:
    """What one mission took (s): wall time, processor time of this process, and the page's of it.

    Attributes:
        browser: processor time of all of Chromium's processes meanwhile; no part of `process`.
        page: by part: its own thread, the log's thread while it writes what pages show, and the
            threads in which pictures are made.
    """

    wall: float
    process: float
    browser: float
    page: dict[str, float]

    @property
    def share(self) -> float:
        """The page's processor time, as a share of what the mission takes without it."""
        spent = sum(self.page.values())
        return spent / (self.process - spent)


def mission(page: Page | None, runs: Path, seed: int) -> Cost:
    """One mission in physics, shown or not."""
    settings = load_settings(
        llm="none", user="oracle", detector="simulated", runs=runs, seed=seed, world="physics"
    )
    shown = {"sinks": [page.sink]} if page else {}
    watch = Stopwatch(time.thread_time)
    with Session(settings, **shown) as session:
        if page:
            page.follow(session)
            with_page(watch, page.sink)
        drawn, serving = browser_s(), serving_s()
        cpu, began = time.process_time(), time.monotonic()
        session.run(WORDS)
        wall, process = time.monotonic() - began, time.process_time() - cpu
        page_s = {"served": serving_s() - serving, **watch.seconds}
        return Cost(wall, process, browser_s() - drawn, page_s)


def with_page(watch: Stopwatch, sink: PageSink) -> None:
    """Have this watch, and no earlier one, time what the sink does in the threads of others."""
    for name, part in (("write", "logged"), ("flush", "logged"), ("picture", "pictured")):
        vars(sink).pop(name, None)
        watch.around(sink, name, part)


def serving_s() -> float:
    """Processor time of the thread that serves the page (s)."""
    (thread,) = (one for one in threading.enumerate() if one.name == "page")
    assert thread.ident
    return time.clock_gettime(time.pthread_getcpuclockid(thread.ident))


def browser_s() -> float:
    """Processor time of all of Chromium's processes so far (s)."""
    spent = 0.0
    for process in psutil.Process().children(recursive=True):
        if process.name().startswith("chromium"):
            times = process.cpu_times()
            spent += times.user + times.system
    return spent


def overhead(browser: Browser, page: Page, runs: Path, missions: int) -> None:
    """Missions in turn: without a page, with one that nobody has opened, with one open, with two.

    Wall time tells of the browser, too, which draws on the same cores; from one mission to the next
    it differs by more than the page takes. Processor time of the page's own parts, and of the
    browser, does not.
    """
    mission(None, runs, 0)
    ways = {"without a page": None, "none open": 0, "one open": 1, "two open": 2}
    took: dict[str, list[Cost]] = {way: [] for way in ways}
    for number in range(missions):
        for way, count in ways.items():
            with ExitStack() as stack:
                for _ in range(count or 0):
                    stack.enter_context(opened(browser, page))
                took[way].append(mission(None if count is None else page, runs, number))
    for way, costs in took.items():
        pairs = zip(costs, took["without a page"], strict=True)
        longer = median(one.wall / plain.wall - 1 for one, plain in pairs)
        wall, process, browser_took, share = (
            median(getattr(one, name) for one in costs)
            for name in ("wall", "process", "browser", "share")
        )
        print(
            f"a mission, {way}: {wall:.2f} s ({longer:+.1%}), processor {process:.2f} s, "
            f"and of the browser {browser_took:.2f} s"
        )
        if way != "without a page":
            parts = ", ".join(
                f"{part} {median(one.page.get(part, 0.0) for one in costs):.3f} s"
                for part in ("served", "logged", "pictured")
            )
            print(f"  the page's of it: {share:.2%} ({parts})")


def in_real_time(browser: Browser, page: Page, runs: Path, missions: int) -> None:
    """Missions of a robot for which a second is a second, in turn without a page and with two."""
    took: dict[int, list[float]] = {0: [], 2: []}
    for count, walls in list(took.items()) * missions:
        inbox = Inbox()
        shown = {"sinks": [page.sink]} if count else {}
        with ExitStack() as stack:
            robot = stack.enter_context(served_process("--speed", "1"))
            settings = load_settings(llm="none", runs=runs, robot=robot, profile="served")
            user = Scripted(inbox, ["on the counter wagon"])
            session = stack.enter_context(Session(settings, inbox=inbox, user=user, **shown))
            for _ in range(count):
                stack.enter_context(opened(browser, page))
            if count:
                page.follow(session)
            began = time.monotonic()
            outcome = session.run(WORDS)
            walls.append(time.monotonic() - began)
            print(f"{count} pages: {walls[-1]:.2f} s, {outcome.status}")
    longer = median(two / none - 1 for none, two in zip(took[0], took[2], strict=True))
    print(f"a mission in real time, two open: {longer:+.1%}")


def main() -> None:
    """Measure."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--times", type=int, default=200)
    parser.add_argument("--idle-s", type=float, default=20.0)
    parser.add_argument("--missions", type=int, default=7)
    parser.add_argument("--real-time", type=int, default=1, metavar="MISSIONS")
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
        if options.real_time:
            in_real_time(browser, page, runs, options.real_time)


if __name__ == "__main__":
    main()
