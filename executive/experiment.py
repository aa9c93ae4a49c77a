"""The report of a campaign: the paper's tables with ours beside its figures, in Markdown."""

from collections import Counter
from collections.abc import Callable, Hashable, Iterable, Mapping, Sequence
from statistics import fmean

from executive import paper
from executive.config import KnowledgeSystem
from executive.journal import CRASHED, Row
from executive.paper import Condition
from executive.statistics import Comparison, Summary, grouped, pairwise, stars, summarize
from executive.types import Kind

Column = Callable[[Row], float]

READING = """\
In brackets: the paper's figures. Intervals (95 %, of the mean) are bootstrapped over the commands.

Differences are tested with Wilcoxon's signed-rank test, two-sided, Holm-corrected over the pairs
of systems of a situation; \\* p < 0.05, \\*\\* p < 0.01. *By command*: the mean of a command's
seeds is one pair. *By mission*: a command with a seed is one pair, which takes repetitions of a
command for independent, and so overstates what is known."""

MEASURES: dict[str, tuple[Column, dict[Condition, tuple[float, float]]]] = {
    "Inquiries to the person": (lambda row: row.inquiries, paper.INQUIRIES),
    "Pieces of furniture visited": (lambda row: row.visits, paper.VISITS),
}
"""What the paper reports by mean and SD, with stars."""

COST: dict[str, Callable[[Sequence[Row]], float]] = {
    "list generation [s]": lambda rows: fmean(r.thinking_time_s for r in rows),
    "calls of the LLM": lambda rows: fmean(r.llm_calls for r in rows),
    "each LLM output [s]": lambda rows: sum(r.llm_s for r in rows) / sum(r.llm_calls for r in rows),
    "generated tokens": lambda rows: (
        sum(r.generated_tokens for r in rows) / sum(r.llm_calls for r in rows)
    ),
}


def report(rows: Sequence[Row], about: Mapping[str, str]) -> str:
    """The whole report; crashed missions count as not completed and nowhere else.

    Args:
        rows: missions that have ended, of any part of the campaign.
        about: settings, versions and the like, to be listed at the end.
    """
    ran = [row for row in rows if row.status != CRASHED]
    parts = [
        f"# Campaign: {len(rows)} missions",
        READING,
        completion(rows),
        times(ran),
        *(measure(ran, title) for title in MEASURES),
        cost(ran),
        failures(rows),
        "## Settings\n\n" + table(["what", "value"], about.items()),
    ]
    return "\n\n".join(parts) + "\n"


def completion(rows: Sequence[Row]) -> str:
    """Share of missions that were done, by system."""
    lines = []
    for system in paper.SYSTEMS:
        mine = [row for row in rows if row.key.system == system]
        if summary := summary_of(mine, lambda row: 100.0 * row.completed):
            lines.append(
                [
                    system,
                    f"{summary.mean:.1f} % ({100 * paper.COMPLETION[system]:.1f} %)",
                    interval(summary, 1),
                    str(summary.n),
                ]
            )
    return "## Task completion rate\n\n" + table(["system", "completed", "95 %", "n"], lines)


def times(rows: Iterable[Row]) -> str:
    """Mission time of completed missions, by kind and condition."""
    done = [row for row in rows if row.completed]
    lines = [
        [kind, *(_cell(_mean(_of(done, c, kind), "mission_time_s"), t) for c, t in figures.items())]
        for kind, figures in paper.TIME_S.items()
    ]
    return "## Mission time of completed missions [s]\n\n" + table(["", *_names()], lines)


def measure(rows: Sequence[Row], title: str) -> str:
    """Mean, SD and interval of each condition, then which differ."""
    column, figures = MEASURES[title]
    lines = []
    for condition, (mean, sd) in figures.items():
        if summary := summary_of(_of(rows, condition), column):
            lines.append(
                [
                    name(condition),
                    f"{summary.mean:.2f} ({mean:.2f})",
                    interval(summary, 2),
                    f"{summary.sd:.2f} ({sd:.2f})",
                    str(summary.n),
                ]
            )
    means = table(["condition", "mean", "95 %", "SD", "n"], lines)
    return f"## {title}\n\n{means}\n\n{differences(rows, column)}"


def differences(rows: Sequence[Row], column: Column) -> str:
    """Wilcoxon's signed-rank test of each two systems, in each situation."""
    lines = []
    for defaults in (False, True):
        mine = [row for row in rows if row.defaults == defaults]
        by_command = pairwise(_columns(mine, column, lambda row: row.command))
        by_mission = pairwise(_columns(mine, column, lambda row: (row.command, row.seed)))
        for command, mission in zip(by_command, by_mission, strict=True):
            situation = "defaults" if defaults else "no defaults"
            lines.append(
                [
                    situation,
                    f"{command.a} - {command.b}",
                    f"{command.difference:+.2f}",
                    _p(command),
                    _p(mission),
                ]
            )
    heads = ["situation", "systems", "difference", "p by command", "p by mission"]
    return table(heads, lines)


def cost(rows: Iterable[Row]) -> str:
    """What consulting the language model cost, of missions that did."""
    asked = [row for row in rows if row.llm_calls]
    lines = []
    for title, figures in paper.COST.items():
        cells = []
        for condition, figure in figures.items():
            mine = _of(asked, condition)
            cells.append(_cell(COST[title](mine) if mine else None, figure, 2))
        lines.append([title, *cells])
    heads = ["", *map(name, next(iter(paper.COST.values())))]
    return "## Execution cost of missions that consulted the LLM\n\n" + table(heads, lines)


def failures(rows: Iterable[Row]) -> str:
    """Why missions were not completed, commonest first."""
    failed = Counter(
        (row.status, row.reason, name((row.key.system, row.defaults)))
        for row in rows
        if not row.completed
    )
    lines = [[*cause, str(times)] for cause, times in failed.most_common()]
    body = table(["status", "reason", "condition", "missions"], lines) if lines else "None."
    return f"## Missions not completed\n\n{body}"


def name(condition: Condition) -> str:
    """A condition as the head of a column."""
    system, defaults = condition
    return f"{system}, {'defaults' if defaults else 'no defaults'}"


def summary_of(rows: Iterable[Row], column: Column) -> Summary | None:
    """The column's summary, with its interval over the commands."""
    return summarize(grouped((row.command, column(row)) for row in rows))


def interval(summary: Summary, digits: int) -> str:
    """From the low to the high end."""
    return f"{summary.low:.{digits}f} to {summary.high:.{digits}f}"


def table(heads: Sequence[str], lines: Iterable[Sequence[str]]) -> str:
    """A Markdown table; a bar within a cell is escaped."""
    rows = [heads, ["---"] * len(heads), *lines]
    escaped = ([cell.replace("|", "\\|").replace("\n", " ") for cell in row] for row in rows)
    return "\n".join(f"| {' | '.join(row)} |" for row in escaped)


def _names() -> list[str]:
    return [name(condition) for condition in paper.CONDITIONS]


def _of(rows: Iterable[Row], condition: Condition, kind: Kind | None = None) -> list[Row]:
    return [
        row
        for row in rows
        if (row.key.system, row.defaults) == condition and kind in (None, row.kind)
    ]


def _mean(rows: Sequence[Row], column: str) -> float | None:
    return fmean(getattr(row, column) for row in rows) if rows else None


def _cell(ours: float | None, theirs: float, digits: int = 1) -> str:
    return f"{'-' if ours is None else f'{ours:.{digits}f}'} ({theirs:.{digits}f})"


def _columns(
    rows: Iterable[Row], column: Column, unit: Callable[[Row], Hashable]
) -> dict[KnowledgeSystem, dict[Hashable, float]]:
    """Of each system the mean value of each unit."""
    values: dict[KnowledgeSystem, dict[Hashable, list[float]]] = {}
    for row in rows:
        values.setdefault(row.key.system, {}).setdefault(unit(row), []).append(column(row))
    return {
        system: {key: fmean(several) for key, several in values[system].items()}
        for system in paper.SYSTEMS
        if system in values
    }


def _p(comparison: Comparison[KnowledgeSystem]) -> str:
    mark = stars(comparison.p).replace("*", "\\*")
    p = "< 0.001" if comparison.p < 0.001 else f"{comparison.p:.3f}"
    return f"{p} {mark} (n = {comparison.pairs})".replace("  ", " ")
