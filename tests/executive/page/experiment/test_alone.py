"""`python -m executive.page runs`: past runs are gone through without a robot."""

import json
import re
import signal
import subprocess
import sys
import threading
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from browsing import chromium
from paging import ask, heard, post
from patience import PATIENCE_S
from playwright.sync_api import expect
from talking import session_of

from executive.errors import InputError
from executive.page.address import Address
from executive.page.experiment.alone import PastRuns
from executive.page.experiment.reel import Reel
from executive.page.experiment.reels import read

TOKEN = "theirs"


def recorded(runs: Path, *answers: str) -> str:
    """The name of a mission that was recorded there."""
    with session_of(runs, [*answers, "high_table"], search="paper") as session:
        return Path(session.run("Find the peach").run_dir or "").name


def told(page: Any, what: str, **values: Any) -> Any:
    answer = ask(page, f"/experiment/{what}", token=TOKEN, **values)
    assert answer.status == 200, answer.body
    return json.loads(answer.body)


def test_a_run_is_listed_found_gone_through_and_replayed(tmp_path: Path) -> None:
    name = recorded(tmp_path)
    with PastRuns(tmp_path, Address(port=0), TOKEN) as page:
        assert heard(page, "past", token=TOKEN, path="/experiment/events")
        assert [run["run"] for run in told(page, "runs", words="peach done")["runs"]] == [name]
        assert not told(page, "runs", words="hammer")["runs"]
        while not told(page, "run", run=name)["whole"]:
            pass
        assert told(page, "step", run=name, step=0)["nodes"]
        assert told(page, "parting", one=name, other=name) == {"parting": None}


def test_there_is_nobody_to_speak_with_and_nothing_to_step_into(tmp_path: Path) -> None:
    with PastRuns(tmp_path, Address(port=0), TOKEN) as page:
        body = json.dumps({"deed": "stop"}).encode()
        answer = ask(page, "/experiment/intervene", method="POST", body=body, token=TOKEN)
        assert answer.status == 404
        assert b"nobody can step in here" in answer.body
        assert post(page, "/say", {"words": "Hello"}, token=TOKEN) == 404
        assert ask(page, "/experiment/runs", token="guessed").status == 403


def test_what_is_no_folder_of_runs_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="there is no such folder"):
        PastRuns(tmp_path / "nowhere", Address(port=0))
    name = recorded(tmp_path)
    with pytest.raises(InputError, match="is one run; give the folder it is in"):
        PastRuns(tmp_path / name, Address(port=0))


def test_the_command_serves_until_it_is_stopped(tmp_path: Path) -> None:
    command = [sys.executable, "-m", "executive.page", "runs", str(tmp_path), "--page", "0"]
    with subprocess.Popen(command, stderr=subprocess.PIPE, text=True) as process:
        assert process.stderr
        found = re.fullmatch(
            r"Open (http://\S+)/experiment\?token=(\S+)\n", process.stderr.readline()
        )
        assert found
        page = SimpleNamespace(url=found[1])
        assert json.loads(ask(page, "/experiment/runs", token=found[2]).body)["all"] == 0
        process.send_signal(signal.SIGINT)
        assert process.wait(PATIENCE_S) == 130


@pytest.mark.browser
def test_in_a_browser_only_the_list_is_there(tmp_path: Path) -> None:
    with PastRuns(tmp_path, Address(port=0), TOKEN) as page, chromium() as browser:
        tab = browser.new_page()
        tab.goto(page.url)
        expect(tab.get_by_text("There are no runs here yet.")).to_be_visible()
        expect(tab.get_by_role("button", name="Live")).to_be_hidden()
        name = recorded(tmp_path)
        tab.locator("#find").fill("peach")
        tab.locator("#runs th button").click()
        expect(tab.locator("#one .moment")).to_contain_text("Tick 0")
        expect(tab.locator("#one-title")).to_have_text(name)


@pytest.mark.browser
def test_two_runs_are_shown_in_what_they_part_as_soon_as_that_is_read(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    may_read = threading.Event()

    def later(reel: Reel, folder: Path) -> None:
        may_read.wait(PATIENCE_S)
        read(reel, folder)

    monkeypatch.setattr("executive.page.experiment.reels.read", later)
    both = sorted([recorded(tmp_path), recorded(tmp_path, "I don't know")])
    with PastRuns(tmp_path, Address(port=0), TOKEN) as page, chromium() as browser:
        part = told(page, "parting", one=both[0], other=both[1])["parting"]
        behaviour = next(aspect["what"] for aspect in part["aspects"] if aspect["behaviour"])
        assert part["tick"] > 0
        tab = browser.new_page()
        tab.goto(f"{page.url}#two/{both[0]}/{both[1]}")
        expect(tab.locator("#parting")).to_contain_text(f"They part at tick {part['tick']}")
        expect(tab.locator("#two [role=treeitem]")).to_have_count(0)
        may_read.set()
        chosen = tab.locator("#two [aria-selected=true] .name")
        expect(chosen).to_have_text([behaviour.split("/")[-1]] * 2)
        for moment in tab.locator("#two .moment").all():
            expect(moment).to_have_attribute("data-step", str(part["tick"]))
