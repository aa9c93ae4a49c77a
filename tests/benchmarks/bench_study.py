"""A study by simulated participants: `python tests/benchmarks/bench_study.py`, with chromium.

24 of them go through 4 conditions in a real browser, unattended: one is killed in the middle and
goes on, one withdraws. In the end it is counted whether every row is there.
"""

import argparse
import random
import signal
import sys
import time
from pathlib import Path
from tempfile import TemporaryDirectory

sys.path.insert(0, str(Path(__file__).parents[1] / "helpers"))

from browsing import answer, chromium, opened, say, wait_until_ready
from playwright.sync_api import Browser
from playwright.sync_api import Page as Tab
from studying import begun, end_task, led, study_of, take_part, task_done, written

from executive.page.study.data import StudyData, code_of
from executive.page.study.report import write_report
from executive.page.study.tables import read_rows
from executive.page.study.withdrawal import withdraw

KILLED, WITHDRAWN = 5, 7


def do(tab: Tab, chance: random.Random) -> None:
    """One of the things that people do: most get it done, some stop the robot or give up."""
    if chance.random() < 0.6:
        task_done(tab, chance)
        return
    say(tab, "Bring a fruit")
    answer(tab, "peach").click()
    if chance.random() < 0.5:
        tab.keyboard.press("Escape")
        wait_until_ready(tab)
        task_done(tab, chance)
    else:
        end_task(tab, "I give up")


def kill(browser: Browser, file: Path, data: StudyData, code: str, chance: random.Random) -> None:
    """Have the program of a participant killed in the middle of a task."""
    killed: list[bool] = []

    def until_the_third(tab: Tab, chance: random.Random) -> None:
        if tab.evaluate("document.body.dataset.step").startswith("task/3/"):
            say(tab, "Bring a fruit")
            process.send_signal(signal.SIGKILL)
            killed.append(True)
            raise InterruptedError
        do(tab, chance)

    try:
        with (
            begun(file, data.folder, "--participant", code) as (process, page),
            opened(browser, page) as tab,
        ):
            take_part(tab, chance, until_the_third)
    except InterruptedError:
        pass
    assert killed


def main() -> None:
    """Lead them all, and count."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--participants", type=int, default=24)
    parser.add_argument("--conditions", type=int, default=4)
    options = parser.parse_args()
    study = study_of(options.conditions, tasks=2, after_each=["sus", "nasa_tlx"])
    began = time.monotonic()
    with TemporaryDirectory() as folder, chromium() as browser:
        file, data = written(study, Path(folder)), StudyData(Path(folder) / "data", study)
        for number in range(1, options.participants + 1):
            code, chance = code_of(number), random.Random(number)
            if number == KILLED:
                kill(browser, file, data, code, chance)
            with led(data, code) as one, opened(browser, one.page) as tab:
                take_part(tab, chance, do)
            print(f"{code}: {time.monotonic() - began:.0f} s", flush=True)
        count(data, options.participants * options.conditions)


def count(data: StudyData, conditions: int) -> None:
    """Whether everything is there, before and after one withdraws."""
    results = read_rows(data.folder / "results.parquet")
    answers = read_rows(data.folder / "answers.parquet")
    print(
        f"conditions: {len({(r['participant'], r['condition']) for r in results})} of {conditions}"
    )
    print(f"rows of tasks: {len(results)} of {conditions * 2}")
    print(f"answers: {len(answers)} of {conditions * 16}")
    print(f"begun again: {sum(int(str(r['attempts'])) > 1 for r in results)}")
    missing = [f for r in results for f in list(r["recordings"]) if not (data.folder / f).is_dir()]
    print(f"recordings that are missing: {len(missing)}")
    write_report(data)
    if data.folder.joinpath(code_of(WITHDRAWN)).is_dir():
        gone = withdraw(data, code_of(WITHDRAWN))
        print(f"withdrawn: {gone.files} files, found in {len(gone.found)} of {gone.searched} left")
        print(f"rows of tasks after that: {len(read_rows(data.folder / 'results.parquet'))}")


if __name__ == "__main__":
    main()
