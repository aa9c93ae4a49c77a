"""The report of a study: by condition, with intervals and paired tests."""

from collections.abc import Iterable, Sequence
from pathlib import Path

from executive.campaign.report.document import (
    NO_PLOTS,
    Figure,
    Heading,
    Part,
    Table,
    Text,
    write_document,
)
from executive.campaign.report.statistics import Summary, stars
from executive.errors import InputError
from executive.page.study.data import StudyData, is_last, number_of
from executive.page.study.file import Study
from executive.page.study.measures import OUTSIDE, Measure, of_questionnaires, of_tasks
from executive.page.study.steps import order
from executive.page.study.tables import AnswerRow, Tables, write_tables

READING = (
    "Each participant counts once in each condition, with the mean of their tasks. Intervals "
    "(95 %, of the mean) are bootstrapped over the participants.",
    "Differences are tested with Wilcoxon's signed-rank test, two-sided, on the participants who "
    "have met both conditions, Holm-corrected over the pairs of conditions of a measure; "
    "* p < 0.05, ** p < 0.01. Nothing is corrected over the measures: decide before the study "
    "which of them it is about.",
)


def write_report(data: StudyData) -> Path:
    """Write `report.md` with its plots, and `report.html`, which holds them; the latter's path.

    Raises:
        InputError: if there is nothing to report yet, or it cannot be written.
    """
    made = write_tables(data)
    if not made.results:
        raise InputError(f"--data {data.folder}", "no task is over yet", "lead a participant first")
    try:
        write_document(report(data, made), data.folder)
    except OSError as error:
        what = f"the report cannot be written: {error.strerror}"
        raise InputError(f"--data {data.folder}", what, "make room") from None
    return data.folder / "report.html"


def report(data: StudyData, tables: Tables) -> list[Part]:
    """The whole report."""
    study = data.study
    conditions = tuple(condition.name for condition in study.conditions)
    tasks, asked = of_tasks(tables, conditions), of_questionnaires(tables, conditions)
    plots = _plots(tasks, asked)
    parts: list[Part] = [Heading(study.title, 1), *map(Text, READING)]
    parts += [] if plots else [Text(NO_PLOTS)]
    for title, measures in (("Tasks", tasks), ("Questionnaires", asked)):
        if measures:
            parts += [Heading(title), by_condition(measures, conditions)]
            parts += plots.get(title, ())
            parts += [differences(measures)] if len(conditions) > 1 else []
    if outside := of_questionnaires(tables, OUTSIDE):
        parts += [Heading("Before and after"), by_condition(outside, OUTSIDE, ("all",))]
    parts += [Heading("Participants"), participants(data, tables)]
    parts += [Heading("At which place each condition came"), places(tables, conditions)]
    if words := [row for row in tables.answers if row.words]:
        parts += [Heading("In their words"), in_words(study, words)]
    return [*parts, Heading("Conditions"), _conditions(study), Text(_consent(study))]


def by_condition(
    measures: Iterable[Measure], conditions: Sequence[str], heads: Sequence[str] = ()
) -> Table:
    """Means with intervals, and standard deviations; the heads are the conditions."""
    lines = [
        [measure.name, *(_told(measure.summary(condition)) for condition in conditions)]
        for measure in measures
    ]
    return Table(["mean (95 %)", *(heads or conditions)], lines)


def _told(one: Summary | None) -> str:
    if one is None:
        return "-"
    if one.groups < 2:  # one participant says nothing of others
        return f"{one.mean:.1f}, n = {one.n}"
    return f"{one.mean:.1f} ({one.low:.1f} to {one.high:.1f}), SD {one.sd:.1f}, n = {one.n}"


def differences(measures: Iterable[Measure]) -> Table:
    """Each two conditions, measure by measure."""
    lines = [
        [
            measure.name,
            f"{one.a} - {one.b}",
            f"{one.difference:+.1f}",
            f"{'< 0.001' if one.p < 0.001 else f'{one.p:.3f}'} {stars(one.p)}".strip(),
            str(one.pairs),
        ]
        for measure in measures
        for one in measure.comparisons()
    ]
    return Table(["", "conditions", "mean difference", "p", "pairs"], lines)


def participants(data: StudyData, tables: Tables) -> Table:
    """Who came how far."""
    lines = []
    for journal in data.journals():
        mine = [row for row in tables.results if row.participant == journal.code]
        names = (condition.name for condition in order(data.study, number_of(journal.code)))
        state = "to the end" if any(map(is_last, journal.entries())) else "not to the end"
        most = len(data.study.conditions) * len(data.study.tasks)
        lines.append([journal.code, ", ".join(names), f"{len(mine)} of {most}", state])
    return Table(["participant", "order", "tasks over", "came"], lines)


def places(tables: Tables, conditions: Sequence[str]) -> Table:
    """Of how many participants a condition was the first, the second, and so on."""
    met = {(row.participant, row.condition, row.position) for row in tables.results}
    numbers = range(1, len(conditions) + 1)
    lines = [
        [name, *(str(sum(m[1:] == (name, number) for m in met)) for number in numbers)]
        for name in conditions
    ]
    return Table(["condition", *map(str, numbers)], lines)


def in_words(study: Study, answers: Iterable[AnswerRow]) -> Table:
    """What was written."""
    lines = [
        [_question(study, row), row.condition or "-", row.participant, row.words or ""]
        for row in answers
    ]
    return Table(["asked", "condition", "participant", "answer"], lines)


def _question(study: Study, row: AnswerRow) -> str:
    items = study.questionnaire(row.questionnaire).items
    return next((item.text for item in items if item.name == row.item), row.item)


def _conditions(study: Study) -> Table:
    lines = [["(all)", _settings(study.settings)]]
    lines += [[one.name, _settings(one.settings)] for one in study.conditions]
    return Table(["condition", "settings"], lines)


def _settings(settings: dict[str, object]) -> str:
    return ", ".join(f"{name} = {value!r}" for name, value in settings.items()) or "-"


def _consent(study: Study) -> str:
    return f"SHA-256 of the text of consent: {study.consent_sha256}."


def _plots(tasks: Sequence[Measure], asked: Sequence[Measure]) -> dict[str, Sequence[Figure]]:
    """The figures by section; none without matplotlib."""
    try:
        from executive.page.study import plots
    except ImportError:
        return {}
    named = (("Tasks", "tasks", tasks), ("Questionnaires", "questionnaires", asked))
    return {title: [plots.figure(file, some)] for title, file, some in named if some}
