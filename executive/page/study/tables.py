"""The tables of a study, made of the journals: for each a row as a dataclass, and a file."""

import io
import logging
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, fields
from pathlib import Path

import pyarrow.parquet as pq

from executive.campaign.rows import table_of
from executive.errors import ExecutiveError, InputError
from executive.events import THE_PERSON
from executive.files import write_whole
from executive.page.study.data import Entry, Journal, StudyData, number_of
from executive.page.study.file import Study
from executive.text import one_line
from executive.types.outcome import MissionStatus

log = logging.getLogger(__name__)


@dataclass(frozen=True)
class TaskRow:
    """A task of a participant that is over: a row of `results.parquet`. Times in seconds."""

    participant: str
    number: int
    condition: str
    position: int
    """The how-manieth condition of this participant it is, from 1."""
    task: str
    turn: int
    """The how-manieth task of its condition, from 1."""
    ended: str
    """finished, gave_up or time."""
    began_at: str
    ended_at: str
    duration_s: float
    """From reading it to its end."""
    attempts: int
    """How often it was begun: more than once if the program was ended in between."""
    commands: int
    """What was said to the robot when it listened for a command; of the last attempt, as below."""
    missions: int
    done: int
    not_done: int
    not_understood: int
    stopped: int
    last_status: str
    """Of the last mission; empty if there was none."""
    last_reason: str
    questions: int
    """Of the robot."""
    visits: int
    llm_calls: int
    mission_time_s: float
    stops: int
    """How often the participant said stop, or pressed it; that the task was left is none."""
    interventions: int
    """Of the experimenter."""
    consent_sha256: str
    recordings: tuple[str, ...]
    """Folders of its missions, below the study's."""


@dataclass(frozen=True)
class AnswerRow:
    """An answer to an item: a row of `answers.parquet`."""

    participant: str
    condition: str
    """Empty: before or after all of them."""
    position: int
    questionnaire: str
    item: str
    points: int | None
    words: str | None
    at: str


@dataclass(frozen=True)
class ScoreRow:
    """What the answers of a scale come to: a row of `scores.parquet`."""

    participant: str
    condition: str
    position: int
    questionnaire: str
    scale: str
    score: float


@dataclass(frozen=True)
class InterventionRow:
    """Somebody stepped in: a row of `interventions.parquet`."""

    participant: str
    condition: str
    position: int
    task: str
    at: str
    recording: str
    time_s: float
    """Mission time."""
    what: str
    by: str
    was: str
    became: str


Row = TaskRow | AnswerRow | ScoreRow | InterventionRow


@dataclass(frozen=True)
class Tables:
    """All of them."""

    results: tuple[TaskRow, ...]
    answers: tuple[AnswerRow, ...]
    scores: tuple[ScoreRow, ...]
    interventions: tuple[InterventionRow, ...]

    def by_kind(self) -> Iterator[tuple[type[Row], Sequence[Row]]]:
        """Each with what its rows are."""
        yield TaskRow, self.results
        yield AnswerRow, self.answers
        yield ScoreRow, self.scores
        yield InterventionRow, self.interventions


STOP, LEFT = "stop", "left"
"""What somebody does who steps in: stops the robot, or leaves the task while it is at work."""
FINISHED, GAVE_UP, TIME = "finished", "gave_up", "time"
"""How tasks end: the participant says so, or gives up, or has had the time."""


def tables(data: StudyData, without: str = "") -> Tables:
    """What the journals say, but for that of the participant who is left out.

    Raises:
        InputError: if one of them is damaged.
    """
    told = [_told(data.study, one) for one in data.journals() if one.code != without]
    return Tables(
        tuple(row for one in told for row in one.results),
        tuple(row for one in told for row in one.answers),
        tuple(row for one in told for row in one.scores),
        tuple(row for one in told for row in one.interventions),
    )


def _told(study: Study, journal: Journal) -> Tables:
    """What one of them says, in rows that a table takes."""
    entries = journal.entries()
    try:
        told = Tables(
            tuple(_results(journal, entries)),
            tuple(_answers(journal, entries)),
            tuple(_scores(study, journal, entries)),
            tuple(_interventions(journal, entries)),
        )
        for kind, rows in told.by_kind():
            table_of(kind, rows)
    except (KeyError, TypeError, ValueError, AttributeError) as error:
        what = f"is damaged: a line is none of ours ({type(error).__name__}: {error})"
        right = "mend it by hand, or take the line out"
        raise InputError(str(journal.file), one_line(what), right) from None
    return told


def write_tables(data: StudyData) -> Tables:
    """Write them into the study's folder.

    Raises:
        InputError: if a journal is damaged.
        OSError: if a table cannot be written.
    """
    with data.alone():
        made = tables(data)
        _write(data.folder / "results.parquet", TaskRow, made.results)
        _write(data.folder / "answers.parquet", AnswerRow, made.answers)
        _write(data.folder / "scores.parquet", ScoreRow, made.scores)
        _write(data.folder / "interventions.parquet", InterventionRow, made.interventions)
    return made


def renew_tables(data: StudyData) -> None:
    """Write them if that is possible; nobody is kept waiting for it, as it can be done later."""
    try:
        write_tables(data)
    except (OSError, ExecutiveError) as error:
        log.warning("the tables are not up to date, and will be made again: %s", error)


def _results(journal: Journal, entries: Sequence[Entry]) -> Iterator[TaskRow]:
    consent = next((e["sha256"] for e in entries if e["kind"] == "consent"), "")
    attempts: dict[str, list[list[Entry]]] = {}
    under_way: list[Entry] = []
    for entry in entries:
        match entry["kind"]:
            case "task_began":
                under_way = [entry]
                attempts.setdefault(entry["step"], []).append(under_way)
            case "task":
                begun = attempts.get(entry["done"], [[entry]])
                yield _result(journal, entry, begun, consent)
            case _:
                under_way.append(entry)


def _result(
    journal: Journal, entry: Entry, attempts: Sequence[Sequence[Entry]], consent: str
) -> TaskRow:
    last = attempts[-1]
    missions = [e for e in last if e["kind"] == "mission"]
    steps_in = [e for e in last if e["kind"] == "intervention"]
    states = [e["status"] for e in missions]
    theirs = [e["what"] for e in steps_in if e["by"] == THE_PERSON]
    return TaskRow(
        participant=journal.code,
        number=number_of(journal.code),
        **{k: entry[k] for k in ("condition", "position", "task", "turn", "ended", "duration_s")},
        began_at=last[0]["at"],
        ended_at=entry["at"],
        attempts=len(attempts),
        commands=len(missions) + sum(e["kind"] == "answered" for e in last),
        missions=len(missions),
        done=states.count(MissionStatus.DONE),
        not_done=states.count(MissionStatus.NOT_DONE),
        not_understood=states.count(MissionStatus.NOT_UNDERSTOOD),
        stopped=states.count(MissionStatus.STOPPED),
        last_status=states[-1] if states else "",
        last_reason=missions[-1]["reason"] if missions else "",
        questions=sum(e["questions"] for e in missions),
        visits=sum(e["visits"] for e in missions),
        llm_calls=sum(e["llm_calls"] for e in missions),
        mission_time_s=sum(e["mission_time_s"] for e in missions),
        stops=theirs.count(STOP),
        interventions=len(steps_in) - len(theirs),
        consent_sha256=consent,
        recordings=tuple(e["recording"] for e in missions if e["recording"]),
    )


def _where(entry: Entry) -> tuple[str, int]:
    return entry["condition"], entry["position"]


def _answers(journal: Journal, entries: Iterable[Entry]) -> Iterator[AnswerRow]:
    for entry in entries:
        if entry["kind"] == "answers":
            for item, value in entry["answers"].items():
                points = value if isinstance(value, int) else None
                words = value if isinstance(value, str) else None
                which = *_where(entry), entry["questionnaire"]
                yield AnswerRow(journal.code, *which, item, points, words, entry["at"])


def _scores(study: Study, journal: Journal, entries: Iterable[Entry]) -> Iterator[ScoreRow]:
    for entry in entries:
        if entry["kind"] == "answers":
            name = entry["questionnaire"]
            scores = study.questionnaire(name).scores(entry["answers"])
            for scale, score in scores.items():
                yield ScoreRow(journal.code, *_where(entry), name, scale, score)


def _interventions(journal: Journal, entries: Iterable[Entry]) -> Iterator[InterventionRow]:
    told = [field.name for field in fields(InterventionRow) if field.name != "participant"]
    for entry in entries:
        if entry["kind"] == "intervention":
            yield InterventionRow(journal.code, **{name: entry[name] for name in told})


# --- files ---


def _write(file: Path, kind: type[Row], rows: Sequence[Row]) -> None:
    out = io.BytesIO()
    pq.write_table(table_of(kind, rows), out)
    write_whole(file, out.getvalue())


def read_rows(file: Path) -> list[dict[str, object]]:
    """The rows of a table."""
    return list(pq.read_table(file).to_pylist())
