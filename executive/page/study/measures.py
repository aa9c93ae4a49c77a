"""What a study measures: of each participant in each condition one number."""

from collections.abc import Callable, Hashable, Mapping
from dataclasses import dataclass, field
from statistics import fmean

from executive.campaign.report.statistics import Comparison, Summary, pairwise, summarize
from executive.page.study.questionnaire import ALL
from executive.page.study.tables import FINISHED, Tables, TaskRow
from executive.types.outcome import MissionStatus

OUTSIDE = ("",)
"""Of any condition: before the first one, after the last one."""
OF_TASKS: Mapping[str, Callable[[TaskRow], float]] = {
    "tasks done, say participants [%]": lambda row: 100.0 * (row.ended == FINISHED),
    "tasks done, says the robot [%]": lambda row: 100.0 * (row.last_status == MissionStatus.DONE),
    "time for a task [s]": lambda row: row.duration_s,
    "commands in a task": lambda row: row.commands,
    "questions of the robot in a task": lambda row: row.questions,
    "stops in a task": lambda row: row.stops,
    "interventions in a task": lambda row: row.interventions,
}


@dataclass(frozen=True)
class Measure:
    """One of them.

    Attributes:
        name: with its unit.
        values: by condition and participant.
    """

    name: str
    values: Mapping[str, dict[str, float]] = field(default_factory=dict)

    def summary(self, condition: str) -> Summary | None:
        """Of a condition; the interval is that of the mean over the participants."""
        return summarize({code: [v] for code, v in self.values.get(condition, {}).items()})

    def comparisons(self) -> list[Comparison[str]]:
        """Each two conditions, on the participants that have met both."""
        columns: dict[str, Mapping[Hashable, float]] = {
            name: {code: value for code, value in values.items()}
            for name, values in self.values.items()
        }
        return pairwise(columns)


def of_tasks(tables: Tables, conditions: tuple[str, ...]) -> list[Measure]:
    """Means of a participant's tasks; what never happened is left out."""
    found = []
    for name, column in OF_TASKS.items():
        values: dict[str, dict[str, float]] = {}
        for condition in conditions:
            rows = [row for row in tables.results if row.condition == condition]
            codes = dict.fromkeys(row.participant for row in rows)
            values[condition] = {
                code: fmean(column(row) for row in rows if row.participant == code)
                for code in codes
            }
        if any(value for of_one in values.values() for value in of_one.values()):
            found.append(Measure(name, values))
    return found


def of_questionnaires(tables: Tables, conditions: tuple[str, ...]) -> list[Measure]:
    """The scales of what was answered after each of these conditions."""
    found: dict[str, dict[str, dict[str, float]]] = {}
    for row in tables.scores:
        if row.condition in conditions:
            name = row.questionnaire if row.scale == ALL else f"{row.questionnaire}: {row.scale}"
            of_all = found.setdefault(name, {condition: {} for condition in conditions})
            of_all[row.condition][row.participant] = row.score
    return [Measure(name, values) for name, values in found.items()]
