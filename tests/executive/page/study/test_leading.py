"""A participant is led step by step, and nobody does a step that is not theirs to do."""

import signal
import subprocess
import sys
from contextlib import closing
from pathlib import Path
from typing import Any

import pytest
from paging import TOKEN, ask, heard, notice, post, step_in, told
from patience import PATIENCE_S
from studying import COMMAND, Led, begun, data_in, led, study_of, written

from executive.events import StopRequested
from executive.page.study.data import StudyData
from executive.page.study.tables import read_rows, tables
from executive.page.study.watching import SteppedIn, Watch
from executive.page.study.withdrawal import withdraw
from executive.records import EventTaken
from logs.recorder import Stamp


def can_do(led: Any, step: str, token: str = TOKEN) -> None:
    """Wait until something can be done in a step."""
    with closing(told(led, token=token)) as reading:
        next(
            one
            for one in reading
            if one.name == "study" and one.value.get("step") == step and "waits" not in one.value
        )


def does(led: Any, step: str, value: Any, token: str = TOKEN) -> int:
    """What the page sends when something can be done in a step; the status."""
    can_do(led, step, token)
    return post(led, "/study", {"step": step, "value": value}, token=token)


def up_to_the_task(one: Led) -> None:
    for step, value in (("consent/0/", "agreed"), ("instructions/0/", "read"), ("part/1/", "read")):
        assert does(one.page, step, value) == 200
    heard(one.page, "doing", state="ready")


def test_a_task_takes_what_is_said_until_it_is_over(tmp_path: Path) -> None:
    data = data_in(tmp_path, study_of(1, after_each=[]))
    with led(data, "P01") as one:
        up_to_the_task(one)
        post(one.page, "/say", {"words": "What can you do?"})
        post(one.page, "/say", {"words": COMMAND})
        heard(one.page, "outcome", status="done")
        heard(one.page, "doing", state="ready")
        assert does(one.page, "task/1/t0", "finished") == 200
    [row] = tables(data).results
    assert (row.commands, row.missions, row.done, row.stops) == (2, 1, 1, 0)
    assert row.recordings[0].startswith("P01/runs/a/")


def test_to_quit_is_to_give_up_the_task_and_not_the_study(tmp_path: Path) -> None:
    data = data_in(tmp_path, study_of(1, tasks=2, after_each=[]))
    with led(data, "P01") as one:
        up_to_the_task(one)
        post(one.page, "/say", {"words": "quit"})
        heard(one.page, "study", step="task/1/t1")
        does(one.page, "task/1/t1", "finished")
    assert [row.ended for row in tables(data).results] == ["gave_up", "finished"]


def test_what_an_experimenter_does_is_kept_with_the_task_and_erased_with_the_participant(
    tmp_path: Path,
) -> None:
    data = data_in(tmp_path, study_of(1, tasks=2, after_each=[]))
    with led(data, "P01", experimenter=True) as one:
        up_to_the_task(one)
        does(one.page, "task/1/t0", "finished")
        heard(one.page, "study", step="task/1/t1")
        step_in(one.page, "hold_place", on=True)
        post(one.page, "/say", {"words": "Find the peach at the sofa"})
        notice(one.page, "choice", held={"to": "look", "place": "sofa", "among": []})
        step_in(one.page, "place", place="high_table")
        heard(one.page, "outcome", status="done")
        heard(one.page, "doing", state="ready")
        step_in(one.page, "hold", on=True)
        does(one.page, "task/1/t1", "finished")
    made = tables(data)
    assert [row.interventions for row in made.results] == [0, 3]
    where = {(r.participant, r.condition, r.position, r.task, r.by) for r in made.interventions}
    assert where == {("P01", "a", 1, "t1", "Anna")}
    deeds = [(r.what, r.was, r.became, bool(r.recording)) for r in made.interventions]
    assert sorted(deeds) == [
        ("hold", "", "on", False),
        ("hold_place", "", "on", False),
        ("place", "sofa", "high_table", True),
    ]
    assert not withdraw(data, "P01").found
    assert not any(b"Anna" in file.read_bytes() for file in tmp_path.rglob("*") if file.is_file())


def test_who_steps_in_is_told_with_when_that_was_and_not_when_the_mission_ended() -> None:
    watch = Watch()
    watch.write(Stamp(1.5, 86_400 * 10**9), EventTaken(StopRequested("the person")))
    assert watch.take_all() == [
        SteppedIn("stop", "the person", "1970-01-02T00:00:00.000+00:00", 1.5)
    ]


def test_a_stop_of_an_experimenter_is_none_of_the_participant(tmp_path: Path) -> None:
    data = data_in(tmp_path, study_of(1, after_each=[]))
    with led(data, "P01", experimenter=True) as one:
        up_to_the_task(one)
        post(one.page, "/say", {"words": "Find a fruit"})
        notice(one.page, "question", kind="which_object")
        step_in(one.page, "stop")
        heard(one.page, "outcome", status="stopped")
        heard(one.page, "doing", state="ready")
        does(one.page, "task/1/t0", "finished")
    [row] = tables(data).results
    assert (row.stops, row.interventions) == (0, 1)


def test_conditions_have_conversations_of_their_own(tmp_path: Path) -> None:
    data = data_in(tmp_path, study_of(2, after_each=[]))
    with led(data, "P01") as one:
        up_to_the_task(one)
        post(one.page, "/say", {"words": "Hello"})
        heard(one.page, "said", who="robot")
        does(one.page, "task/1/t0", "finished")
        does(one.page, "part/2/", "read")
        can_do(one.page, "task/2/t0")
        assert not [change for change in one.page.board.since(0) if change.name == "said"]
        does(one.page, "task/2/t0", "finished")


@pytest.mark.parametrize(
    ("step", "value", "status"),
    [
        ("consent/0/", "perhaps", 422),
        ("consent/0/", ["agreed"], 422),
        ("instructions/0/", "read", 409),
        (["consent/0/"], "agreed", 409),
        (None, None, 409),
    ],
)
def test_what_is_not_asked_for_is_not_taken(
    tmp_path: Path, step: object, value: object, status: int
) -> None:
    with led(data_in(tmp_path, study_of(1)), "P01", to_the_end=False) as one:
        heard(one.page, "study", step="consent/0/")
        assert post(one.page, "/study", {"step": step, "value": value}) == status


@pytest.mark.parametrize("body", [b"", b"[]", b"{}", b"\xff", b'"step"', b"[" * 100_000])
def test_what_no_page_sends_is_refused(tmp_path: Path, body: bytes) -> None:
    with led(data_in(tmp_path, study_of(1)), "P01", to_the_end=False) as one:
        assert ask(one.page, "/study", method="POST", body=body).status == 400
        assert ask(one.page, "/study", method="POST", body=b" " * 2**21).status == 413
        assert post(one.page, "/study", {}, token="another") == 403


def test_the_page_is_not_told_what_is_compared(tmp_path: Path) -> None:
    with led(data_in(tmp_path, study_of(2, after_each=[])), "P01") as one:
        up_to_the_task(one)
        seen = [change.json for change in one.page.board.since(0) if change.name == "study"]
        assert "settings" not in seen[0]
        assert '"a"' not in seen[0]
        does(one.page, "task/1/t0", "finished")
        does(one.page, "part/2/", "read")
        does(one.page, "task/2/t0", "finished")


def test_who_declines_leaves_nothing(tmp_path: Path) -> None:
    file = written(study_of(1), tmp_path)
    with begun(file, tmp_path / "data") as (process, page):
        assert does(page, "consent/0/", "declined", page.token) == 200
        assert process.wait(PATIENCE_S) == 1
    assert not (tmp_path / "data/P01").exists()
    assert not read_rows(tmp_path / "data/results.parquet")


def test_a_signal_in_the_middle_of_a_mission_brings_the_robot_to_rest(tmp_path: Path) -> None:
    study = study_of(1, after_each=[])
    file = written(study, tmp_path)
    with begun(file, tmp_path / "data") as (process, page):
        for step, value in (("consent/0/", "agreed"), ("instructions/0/", "read")):
            does(page, step, value, page.token)
        does(page, "part/1/", "read", page.token)
        heard(page, "doing", state="ready", token=page.token)
        post(page, "/say", {"words": "Bring a fruit"}, token=page.token)
        heard(page, "question", token=page.token)
        process.send_signal(signal.SIGTERM)
        assert process.wait(PATIENCE_S) == 130
        assert process.stderr is not None
        assert process.stderr.readline() == "Stopping. Go on with --participant P01.\n"
    entries = StudyData(tmp_path / "data", study).journals()[0].entries()
    assert [entry["kind"] for entry in entries[-3:]] == ["task_began", "intervention", "mission"]
    assert (entries[-1]["status"], entries[-2]["by"]) == ("stopped", "SIGTERM")


def command(*words: str) -> "subprocess.CompletedProcess[str]":
    line = [sys.executable, "-m", "executive.page", "study", *words]
    return subprocess.run(line, capture_output=True, text=True, check=False, timeout=PATIENCE_S)


def test_the_command_tells_orders_and_erases_and_says_who_is_left(tmp_path: Path) -> None:
    study = study_of(2)
    file, data = written(study, tmp_path), data_in(tmp_path, study)
    for code in ("P01", "P02"):
        with data.one(code) as journal:
            journal.append("consent", done="consent", sha256=study.consent_sha256)
    where = (str(file), "--data", str(data.folder))
    assert "P02, P04, ...: b, a" in command(*where, "--check").stdout
    waits = command(*where)
    assert waits.returncode == 2
    assert "P01, P02 have not come to the end; go on with --participant P01" in waits.stderr
    (data.folder / "notes.txt").write_text("P02 was late")
    assert command(*where, "--withdraw", "P01").stdout.endswith("nothing of P01 in any.\n")
    found = command(*where, "--withdraw", "P02")
    assert found.returncode == 1
    assert "notes.txt" in found.stdout


def test_a_file_that_is_not_there_is_told(tmp_path: Path) -> None:
    ended = command(str(tmp_path / "none.toml"))
    assert ended.returncode == 2
    assert "none.toml: cannot be read: No such file or directory" in ended.stderr
