"""What it takes to go through a long session: `python tests/benchmarks/bench_experimenter.py`.

A session of 40 minutes with 10,000 ticks, made up, is recorded, read, and gone through in the
experimenter's page by Debian's chromium: from the slider's move to the next frame that shows it.
"""

import argparse
import random
import sys
import time
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory

sys.path.insert(0, str(Path(__file__).parents[1] / "helpers"))

from browsing import chromium
from recordings import record
from sessions import long_session

from executive.events import Inbox
from executive.page.address import Address
from executive.page.experiment.reel import Reel
from executive.page.experiment.reels import read
from executive.page.page import Page

PER_TICK_S = 0.24
MOVE = """(step) => new Promise((done) => {
  const [slider, moment] = ["input[type=range]", ".moment"].map(
    (one) => document.querySelector(`#one ${one}`));
  const began = performance.now();
  const seen = new MutationObserver(() => {
    if (moment.dataset.step !== String(step)) return;
    seen.disconnect();
    requestAnimationFrame(() => done(performance.now() - began));
  });
  seen.observe(moment, { attributes: true });
  slider.value = step;
  slider.dispatchEvent(new Event("input"));
})"""


def main() -> None:
    """Measure."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--ticks", type=int, default=10_000)
    parser.add_argument("--moves", type=int, default=200)
    options = parser.parse_args()
    with TemporaryDirectory() as folder:
        runs, time_s = Path(folder), 0.0
        records = []
        for one in long_session(options.ticks):
            records.append((time_s, one))
            time_s += PER_TICK_S / 3
        run = record(runs / "20260101T000000Z-long", records)
        began = time.monotonic()
        read(reel := Reel("long"), run)
        print(f"{reel.last + 1} ticks of {len(reel.nodes)} behaviours, read in", end=" ")
        print(f"{time.monotonic() - began:.1f} s")
        went_through(runs, run.name, reel.last, options.moves)


def went_through(runs: Path, name: str, last: int, moves: int) -> None:
    """Steps one after the other, and jumps."""
    with Page(Inbox(), Address(port=0, experimenter=True)) as page, chromium() as browser:
        assert page.desk
        page.desk.look_in(runs)
        tab = browser.new_page(viewport={"width": 1440, "height": 900})
        tab.goto(page.experimenter_url)
        tab.get_by_role("button", name="Past runs").click()
        tab.locator("#runs th button").click()
        while not page.desk.run(name, 0)["whole"]:
            time.sleep(0.2)
        tab.wait_for_timeout(1500)
        chance = random.Random(0)
        start = last // 3
        ways = {
            "step by step": [start + step for step in range(moves)],
            "jumps": [chance.randrange(last) for _ in range(moves)],
        }
        for all_open in (False, True):
            if all_open:
                tab.locator("#one").get_by_label("Open all").check()
            for way, steps in ways.items():
                took = sorted(tab.evaluate(MOVE, step) for step in dict.fromkeys(steps))
                shown = "all open" if all_open else "the branch at work"
                print(
                    f"{way}, {shown}: median {median(took):.0f} ms, "
                    f"95 % within {took[int(0.95 * len(took))]:.0f} ms"
                )


if __name__ == "__main__":
    main()
