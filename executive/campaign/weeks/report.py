"""The report of a campaign of weeks: the measures by week and policy, and in the second half."""

from collections.abc import Callable, Iterator, Mapping, Sequence
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
from executive.campaign.report.statistics import Summary, grouped, summarize
from executive.campaign.weeks.lived import Lived

MEASURES: Mapping[str, tuple[str, Callable[[Lived], float]]] = {
    "questions": ("questions a command", lambda one: one.inquiries),
    "visits": ("visits a command", lambda one: one.visits),
    "stale": ("stale beliefs, % of commands", lambda one: 100.0 * one.stale),
    "misguided": ("wrong guesses by habit, % of commands", lambda one: 100.0 * one.misguided),
    "cost": ("cost of the search a command [s]", lambda one: one.cost_s),
}
"""The measures: for each, its title in the report, and its value of one command."""
SHOWN = ("questions", "visits", "stale", "cost")
"""The measures that are plotted."""
READING = (
    "A household gives ten commands a day, find or bring, at hours and of things that its seed "
    "draws; its things wander by habits. All policies live through the same days. What the robot "
    "remembers is kept, and where things are; each morning the robot is at its start.",
    "Stale belief: the robot looked in vain where the thing was by its memory, with a probability "
    "of at least 0.5 (by the paper's stages: where memory has it). Wrong guess by habit: the same "
    "where it took people to have brought the thing. Cost: the seconds of going to places and "
    "looking there, and for each question its price, the setting question_s.",
    "Intervals (95 %, of the mean) are bootstrapped over the days, of all households together: "
    "commands of a day are not independent of one another.",
)


def write_report(lived: Sequence[Lived], about: Mapping[str, str], folder: Path) -> None:
    """Write `report.md` with its plots, and `report.html`, which holds them."""
    write_document(report(lived, about), folder)


def report(lived: Sequence[Lived], about: Mapping[str, str]) -> list[Part]:
    """The whole report."""
    found = {name: list(rows) for name, rows in by_variant(lived)}
    plots = _plots(found)
    parts: list[Part] = [Heading(f"Weeks: {len(lived)} commands", 1), *map(Text, READING)]
    if lived and not plots:
        parts.append(Text(NO_PLOTS))
    parts += plots
    parts += [Heading("The second half of the weeks"), second_half(found)]
    for name, (title, _) in MEASURES.items():
        parts += [Heading(title[0].upper() + title[1:]), by_week(found, name)]
    return [*parts, Heading("Settings"), Table(["what", "value"], list(about.items()))]


def by_variant(lived: Sequence[Lived]) -> Iterator[tuple[str, Iterator[Lived]]]:
    """The rows of each policy, home and model, with its name; home and model only if they vary."""
    homes, models = ({getattr(one, key) for one in lived} for key in ("home", "llm"))
    order = dict.fromkeys((one.policy, one.home, one.llm) for one in lived)
    for policy, home, llm in order:
        several = [
            part for part, all_of in ((home, homes), (llm, models - {"none"})) if len(all_of) > 1
        ]
        mine = (one for one in lived if (one.policy, one.home, one.llm) == (policy, home, llm))
        yield ", ".join((policy, *several)), mine


def summary(rows: Sequence[Lived], measure: str) -> Summary | None:
    """Mean and interval (over the days) of a measure of some commands; None if there are none."""
    value = MEASURES[measure][1]
    return summarize(grouped((f"{one.seed} {one.day}", value(one)) for one in rows))


def weeks_of(rows: Sequence[Lived]) -> list[list[Lived]]:
    """The commands of each week, from the first to the last with any."""
    last = max((one.week for one in rows), default=-1)
    return [[one for one in rows if one.week == week] for week in range(last + 1)]


def by_week(found: Mapping[str, Sequence[Lived]], measure: str) -> Table:
    """The mean of each week, for each policy."""
    most = max((len(weeks_of(rows)) for rows in found.values()), default=0)
    heads = ["policy", *(f"week {week + 1}" for week in range(most))]
    lines = []
    for name, rows in found.items():
        means = [summary(week, measure) for week in weeks_of(rows)]
        lines.append([name, *(f"{mean.mean:.2f}" if mean else "" for mean in means)])
    return Table(heads, lines)


def second_half(found: Mapping[str, Sequence[Lived]]) -> Table:
    """The means of the second half, when the robot knows the home, with intervals."""
    heads = ["policy", *(title for title, _ in MEASURES.values()), "completed", "n"]
    lines = []
    for name, rows in found.items():
        weeks = weeks_of(rows)
        later = [one for week in weeks[len(weeks) // 2 :] for one in week]
        done = sum(one.completed for one in later) / len(later)
        cells = [_with_interval(summary(later, measure)) for measure in MEASURES]
        lines.append([name, *cells, f"{100 * done:.1f} %", str(len(later))])
    return Table(heads, lines)


def _with_interval(one: Summary | None) -> str:
    return f"{one.mean:.2f} ({one.low:.2f} to {one.high:.2f})" if one else ""


def _plots(found: Mapping[str, Sequence[Lived]]) -> list[Figure]:
    """A list of the one figure; empty without matplotlib or rows."""
    try:
        from executive.campaign.weeks.plots import figure
    except ImportError:
        return []
    if not found:
        return []
    shown = {
        title: {
            name: [summary(week, measure) for week in weeks_of(rows)]
            for name, rows in found.items()
        }
        for measure, (title, _) in ((m, MEASURES[m]) for m in SHOWN)
    }
    return [figure(shown)]
