"""What the experimenter's page is told, and who may ask."""

import json
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any
from urllib.parse import parse_qs, urlsplit

import pytest
from paging import TOKEN, Robot, ask, heard, page_alone, post, robot

from executive.page.page import Page
from logs.viewer.display import DISPLAYS

PATHS = ["", "/runs", "/run", "/step", "/lines", "/node", "/call", "/parting", "/events"]


@pytest.fixture(scope="module")
def ran(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Robot]:
    """A robot that has found something, and looks for another thing."""
    with robot(tmp_path_factory.mktemp("runs"), recorded=True, experimenter=True) as made:
        heard(made.page, "doing", state="ready")
        made.page.says("Find the peach")
        first = heard(made.page, "question", kind="where_is")["id"]
        made.page.says("sofa")
        while heard(made.page, "question", kind="where_is")["id"] == first:
            pass
        made.page.says("high_table")
        made.ended(1)
        yield made


def token_of(page: Page) -> str:
    return parse_qs(urlsplit(page.experimenter_url).query)["token"][0]


def told(page: Page, what: str, **values: Any) -> Any:
    answer = ask(page, f"/experiment/{what}", token=token_of(page), **values)
    assert answer.status == 200, answer.body
    return json.loads(answer.body)


@pytest.mark.parametrize("path", PATHS)
@pytest.mark.parametrize("token", [TOKEN, "", "guessed"])
def test_who_has_the_persons_token_or_none_is_told_nothing(
    ran: Robot, path: str, token: str
) -> None:
    assert ask(ran.page, f"/experiment{path}", token=token).status == 403


@pytest.mark.parametrize("what", ["replay", "view"])
def test_who_has_the_persons_token_can_have_nothing_done(ran: Robot, what: str) -> None:
    assert post(ran.page, f"/experiment/{what}", {"run": "x"}, token=TOKEN) == 403


@pytest.mark.parametrize("path", ["//experiment", "/./experiment", "/EXPERIMENT", "/experimenter"])
def test_by_no_other_way_is_it_reached(ran: Robot, path: str) -> None:
    assert ask(ran.page, path, token=TOKEN).status in (403, 404)


def test_the_experimenters_token_does_not_speak_for_the_person(ran: Robot) -> None:
    assert post(ran.page, "/say", {"words": "stop"}, token=token_of(ran.page)) == 403


@pytest.mark.parametrize("path", PATHS)
def test_without_the_option_there_is_no_such_page(path: str) -> None:
    with page_alone() as page:
        assert page.experimenter_url == ""
        assert ask(page, f"/experiment{path}").status == 404


def test_the_past_run_is_listed_and_told_step_by_step(ran: Robot) -> None:
    listed = told(ran.page, "runs", words="peach", status="done")
    assert listed["found"] == 1
    name = listed["runs"][0]["run"]
    while not (run := told(ran.page, "run", run=name))["whole"]:
        pass
    assert run["status"] == "done"
    assert run["nodes"][0]["name"] == "mission"
    last = told(ran.page, "step", run=name, step=999999)
    assert last["step"] == last["last"] == run["last"]
    assert last["nodes"]["0"][0] == "SUCCESS"
    assert json.loads(last["facts"]["object"]) == "peach"
    before = told(ran.page, "step", run=name, step=0, shown=run["last"])
    assert before["nodes"]["0"][0] == "RUNNING"


def test_the_mission_that_runs_is_told_as_the_recording_tells_it(ran: Robot) -> None:
    name = told(ran.page, "runs")["runs"][0]["run"]
    live, past = (told(ran.page, "step", run=run, step=0)["nodes"] for run in ("live", name))
    assert live == past


def test_a_tree_that_is_known_is_not_told_again(ran: Robot) -> None:
    size = told(ran.page, "run", run="live")["size"]
    assert told(ran.page, "run", run="live", known=size)["nodes"] == []


def test_a_run_does_not_part_from_itself_and_is_replayed(ran: Robot) -> None:
    name = told(ran.page, "runs")["runs"][0]["run"]
    assert told(ran.page, "parting", one=name, other=name) == {"parting": None}
    body = json.dumps({"run": name}).encode()
    replayed = told(ran.page, "replay", method="POST", body=body)
    assert replayed["same"], replayed["text"]


@pytest.mark.skipif(sys.platform != "linux", reason="elsewhere no variable names a display")
def test_without_a_display_no_viewer_is_started_and_it_is_told(
    ran: Robot, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in DISPLAYS:
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setattr(subprocess, "Popen", None)
    name = told(ran.page, "runs")["runs"][0]["run"]
    body = json.dumps({"run": name}).encode()
    path = "/experiment/view"
    answer = ask(ran.page, path, token=token_of(ran.page), method="POST", body=body)
    assert answer.status == 404
    assert "needs a display" in json.loads(answer.body)["error"]


@pytest.mark.parametrize("run", ["..", "/etc", "a/b", "nothing", ""])
@pytest.mark.parametrize("path", ["run", "step", "lines", "node", "call"])
def test_there_are_no_other_runs(ran: Robot, path: str, run: str) -> None:
    values = {"run": run, "step": 0, "node": 0, "call": 0}
    answer = ask(ran.page, f"/experiment/{path}", token=token_of(ran.page), **values)
    assert answer.status == 404
    assert "no such run" in json.loads(answer.body)["error"]


@pytest.mark.parametrize(
    ("path", "values"),
    [
        ("step", {"step": "soon"}),
        ("node", {"step": 0, "node": -1}),
        ("node", {"step": 0, "node": 10**9}),
        ("call", {"call": 0}),
    ],
)
def test_what_is_no_number_of_anything_is_refused(
    ran: Robot, path: str, values: dict[str, Any]
) -> None:
    answer = ask(ran.page, f"/experiment/{path}", token=token_of(ran.page), run="live", **values)
    assert answer.status == 404
    assert "int()" not in answer.body.decode()


def test_a_recording_that_breaks_off_is_told_as_far_as_it_goes(ran: Robot) -> None:
    recording = Path(ran.outcomes[0].run_dir or "") / "mission.mcap"
    content = recording.read_bytes()
    broken = recording.parent.parent / "20000101T000000Z-broken"
    broken.mkdir()
    (broken / "mission.mcap").write_bytes(content[: len(content) // 3])
    while not (run := told(ran.page, "run", run=broken.name))["whole"]:
        pass
    assert run["status"] == ""
    assert run["last"] == told(ran.page, "step", run=broken.name, step=10**9)["step"]
    (broken / "mission.mcap").write_bytes(content)
    told(ran.page, "run", run=broken.name, anew=1)
    while not (run := told(ran.page, "run", run=broken.name))["whole"]:
        pass
    assert run["status"] == "done"
