"""What participants did is kept line by line; of it tables are made, and one may be erased."""

import json
from pathlib import Path
from typing import Any

import pytest

from executive.errors import InputError
from executive.page.study.data import Journal, StudyData, number_of
from executive.page.study.file import Study
from executive.page.study.tables import read_rows, renew_tables, tables, write_tables
from executive.page.study.withdrawal import withdraw

STUDY = Study.model_validate(
    {
        "title": "T",
        "consent": "Yes?",
        "instructions": "Talk.",
        "conditions": [{"name": "a"}, {"name": "b"}],
        "tasks": [{"name": "t", "text": "Do."}],
        "after_each": ["sus"],
    }
)
IN_A = {"condition": "a", "position": 1}
TASK = {"task": "t", "turn": 1, "ended": "finished", "duration_s": 3.0, **IN_A}
MISSION = {
    "words": "Find the mug",
    "status": "done",
    "reason": "The mug is on the sofa.",
    "questions": 1,
    "visits": 2,
    "llm_calls": 0,
    "mission_time_s": 9.5,
    "recording": "P01/runs/a/1",
}
STOP = {
    "task": "t",
    "recording": "",
    "time_s": 1.0,
    "what": "stop",
    "by": "the person",
    **IN_A,
    "was": "",
    "became": "",
}


@pytest.fixture
def data(tmp_path: Path) -> StudyData:
    return StudyData(tmp_path / "data", STUDY)


def begin(data: StudyData, code: str) -> Journal:
    with data.one(code) as journal:
        journal.append("consent", done="consent", sha256=STUDY.consent_sha256)
        return journal


def attempt(journal: Journal, *, over: bool, **changed: Any) -> None:
    journal.append("task_began", step="task/a/t", **IN_A)
    journal.append("mission", **{**MISSION, **changed})
    if over:
        journal.append("task", done="task/a/t", **TASK)


def test_participants_take_the_lowest_number_that_is_free(data: StudyData) -> None:
    assert data.next() == "P01"
    for code in ("P01", "P02", "P04"):
        begin(data, code)
    assert data.next() == "P03"


@pytest.mark.parametrize("code", ["", "7", "P7", "P007", "P00", "p07", "P07/..", "Anna"])
def test_what_is_no_number_is_refused(code: str) -> None:
    with pytest.raises(InputError, match="write it as in P07"):
        number_of(code)


def test_two_programs_do_not_lead_the_same_participant(data: StudyData) -> None:
    told = "at it; wait until they have come to the end, or name another participant"
    with data.one("P01"), pytest.raises(InputError, match=told), data.one("P01"):
        pass


def test_a_study_that_has_changed_is_refused_with_what_has(data: StudyData) -> None:
    begin(data, "P01")
    changed = STUDY.model_copy(update={"consent": "No?", "title": "U"})
    with pytest.raises(InputError, match="has changed since its data began: consent, title"):
        StudyData(data.folder, changed)


def test_a_row_tells_of_the_last_attempt_and_how_many_there_were(data: StudyData) -> None:
    journal = begin(data, "P01")
    attempt(journal, over=False)
    journal.append("intervention", at="", **STOP)
    attempt(journal, over=True, status="not_done")
    [row] = tables(data).results
    assert (row.attempts, row.missions, row.done, row.not_done, row.stops) == (2, 1, 0, 1, 0)
    assert row.consent_sha256 == STUDY.consent_sha256


def test_who_was_killed_in_the_middle_has_lost_nothing_that_was_over(data: StudyData) -> None:
    journal = begin(data, "P01")
    attempt(journal, over=True)
    file = journal.folder / "journal.jsonl"
    file.write_bytes(file.read_bytes() + b'{"kind": "task", "done"')
    assert journal.done() == {"consent", "task/a/t"}
    attempt(journal, over=False)
    assert len(tables(data).results) == 1


def test_tables_read_as_they_were_written(data: StudyData) -> None:
    journal = begin(data, "P01")
    attempt(journal, over=True)
    answers = {item.name: 3 for item in STUDY.questionnaire("sus").items}
    journal.append("answers", done="q", questionnaire="sus", answers=answers, **IN_A)
    journal.append("intervention", **STOP)
    write_tables(data)
    [row] = read_rows(data.folder / "results.parquet")
    assert row["recordings"] == ["P01/runs/a/1"]
    assert len(read_rows(data.folder / "answers.parquet")) == 10
    assert read_rows(data.folder / "scores.parquet")[0]["score"] == 50.0
    assert read_rows(data.folder / "interventions.parquet")[0]["by"] == "the person"


def test_a_damaged_line_is_told_where_it_is(data: StudyData) -> None:
    journal = begin(data, "P01")
    with (journal.folder / "journal.jsonl").open("a") as stream:
        stream.write("nothing\n")
    with pytest.raises(InputError, match=r"P01/journal.jsonl, line 2: is damaged"):
        tables(data)


def test_tables_that_cannot_be_made_keep_nobody_waiting(
    data: StudyData, caplog: pytest.LogCaptureFixture
) -> None:
    (data.folder / "results.parquet").mkdir()
    renew_tables(data)
    assert "the tables are not up to date, and will be made again" in caplog.text


def test_of_one_who_withdraws_nothing_is_found_and_the_others_are_whole(data: StudyData) -> None:
    for code in ("P01", "P02"):
        journal = begin(data, code)
        attempt(journal, over=True, recording=f"{code}/runs/a/1")
        run = journal.folder / "runs/a/1"
        run.mkdir(parents=True)
        (run / "mission.mcap").write_bytes(f"/{code}/".encode() * 3)
    (data.folder / "report.md").write_text("P01 and P02")
    write_tables(data)
    withdrawal = withdraw(data, "P01")
    assert withdrawal.files == 3
    assert not withdrawal.found
    left = b"".join(path.read_bytes() for path in data.folder.rglob("*") if path.is_file())
    assert b"P01" not in left
    assert [row["participant"] for row in read_rows(data.folder / "results.parquet")] == ["P02"]


@pytest.mark.parametrize(
    ("name", "content"),
    [
        ("notes.txt", b"P01 was tired"),
        ("notes.txt", b"p01 was tired"),
        ("notes.txt", "P01 was tired".encode("utf-16")),
        ("P01.txt", b""),
        ("P02/runs/x.mcap", b"runs/P01/runs"),
    ],
)
def test_what_was_put_elsewhere_of_one_who_withdraws_is_found(
    data: StudyData, name: str, content: bytes
) -> None:
    begin(data, "P01")
    begin(data, "P02")
    file = data.folder / name
    file.parent.mkdir(exist_ok=True)
    file.write_bytes(content)
    assert withdraw(data, "P01").found == (file,)


def test_a_copy_of_a_file_of_hers_is_found(data: StudyData) -> None:
    journal = begin(data, "P01")
    (journal.folder / "x").write_text("what she said")
    (data.folder / "copy").write_text("what she said")
    assert withdraw(data, "P01").found == (data.folder / "copy",)


def test_numbers_that_only_look_like_it_are_not_found(data: StudyData) -> None:
    begin(data, "P10")
    journal = begin(data, "P100")
    journal.append("note", text=json.dumps("XP10 P101"))
    assert not withdraw(data, "P10").found


def test_a_withdrawal_that_was_cut_short_is_finished_by_whoever_comes_next(data: StudyData) -> None:
    (data.folder / ".erased-1234").mkdir()
    StudyData(data.folder, STUDY)
    assert not (data.folder / ".erased-1234").exists()


def test_one_who_is_not_there_cannot_be_erased(data: StudyData) -> None:
    begin(data, "P01")
    with pytest.raises(InputError, match="there is no P02; there are P01"):
        withdraw(data, "P02")


def test_one_who_has_agreed_to_nothing_leaves_nothing(data: StudyData) -> None:
    with pytest.raises(KeyboardInterrupt), data.one("P01") as journal, data.if_only_begun(journal):
        raise KeyboardInterrupt
    assert (data.unfinished(), data.next()) == ([], "P01")
    with data.one("P01") as journal, data.if_only_begun(journal):
        journal.append("consent", done="consent", sha256=STUDY.consent_sha256)
    assert data.unfinished() == ["P01"]


def test_recordings_are_not_erased_for_want_of_a_journal(data: StudyData) -> None:
    with data.one("P01") as journal, data.if_only_begun(journal):
        (journal.folder / "runs").mkdir()
    assert data.unfinished() == ["P01"]


def test_as_long_as_nobody_has_begun_the_study_may_change(data: StudyData) -> None:
    changed = STUDY.model_copy(update={"title": "Another"})
    again = StudyData(data.folder, changed)
    begin(again, "P01")
    with pytest.raises(InputError, match="has changed since its data began: title"):
        StudyData(data.folder, STUDY)


@pytest.mark.parametrize(
    "line",
    [
        {"kind": "task"},
        {"kind": "task", "done": "x", "at": "", **TASK, "duration_s": "long"},
        {"kind": "task", "done": [], "at": "", **TASK},
        {"kind": "answers", "at": "", "questionnaire": "sus", "answers": [1], **IN_A},
        {"kind": "answers", "at": "", "questionnaire": "none", "answers": {}, **IN_A},
        {"kind": "intervention"},
        {"kind": "consent"},
    ],
)
def test_a_line_that_is_none_of_ours_is_told_and_erases_nobody(
    data: StudyData, line: dict[str, Any]
) -> None:
    begin(data, "P02")
    with data.one("P01") as journal:
        journal.file.write_text(json.dumps(line) + "\n")
    for use in (lambda: tables(data), lambda: withdraw(data, "P02")):
        with pytest.raises(InputError, match=r"P01/journal.jsonl: is damaged: a line is none of"):
            use()
    assert (data.folder / "P02").exists()
    withdraw(data, "P01")
    assert tables(data).results == ()


def test_what_a_study_did_not_know_of_when_it_began_is_as_by_default(data: StudyData) -> None:
    begin(data, "P01")
    file = data.folder / "study.json"
    kept = json.loads(file.read_text())
    del kept["speech"]
    file.write_text(json.dumps(kept))
    assert StudyData(data.folder, STUDY).journals()
    with pytest.raises(InputError, match="has changed since its data began: speech"):
        StudyData(data.folder, STUDY.model_copy(update={"speech": True}))
