"""The tables of a report: the paper's, with our figures and its own, and further ones."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from os.path import relpath
from pathlib import Path
from statistics import fmean

from executive.campaign.journal import Row
from executive.campaign.report import paper
from executive.campaign.report.cells import (
    Lines,
    each_variant,
    in_brackets,
    interval,
    mean_beside,
    name,
    of_paper,
    p_value,
    situation,
)
from executive.campaign.report.document import Cell, Link, Table
from executive.campaign.report.paper import Condition
from executive.campaign.report.statistics import (
    Comparison,
    pairwise,
)
from executive.campaign.report.variants import (
    Column,
    Variant,
    by_command,
    by_mission,
    select,
    summary_of,
)
from executive.config import KnowledgeSystem
from executive.types.outcome import MissionStatus

MEASURES: Mapping[str, tuple[Column, dict[Condition, tuple[float, float]]]] = {
    "inquiries": (lambda row: row.inquiries, paper.INQUIRIES),
    "visits": (lambda row: row.visits, paper.VISITS),
}
"""The measures that the paper reports by mean and SD: our column, and the paper's figures."""

COST: Mapping[str, Callable[[Sequence[Row]], float]] = {
    "list generation [s]": lambda rows: fmean(r.thinking_time_s for r in rows),
    "calls of the LLM": lambda rows: fmean(r.llm_calls for r in rows),
    "each LLM output [s]": lambda rows: sum(r.llm_s for r in rows) / sum(r.llm_calls for r in rows),
    "generated tokens": lambda rows: (
        sum(r.generated_tokens for r in rows) / sum(r.llm_calls for r in rows)
    ),
}

ACTIVITIES: Mapping[str, Column] = {
    "thinking": lambda row: _only_thinking_s(row),
    "driving": lambda row: row.driving_s,
    "looking": lambda row: row.looking_s,
    "handling": lambda row: row.handling_s,
    "other": lambda row: max(0.0, row.mission_time_s - sum(_known_s(row))),
}
"""Mission time (s) by activity; `other` is the rest of it."""


def _only_thinking_s(row: Row) -> float:
    return row.thinking_time_s - row.thought_moving_s


def _known_s(row: Row) -> tuple[float, ...]:
    return _only_thinking_s(row), row.driving_s, row.looking_s, row.handling_s


def overview(found: Sequence[Variant]) -> Table:
    """The most important means, one column per system."""

    def lines(variant: Variant) -> Lines:
        table = []
        for title, (column, figures) in MEASURES.items():
            for defaults in (False, True):
                cells = (
                    mean_beside(
                        select(variant.rows, (system, defaults)),
                        column,
                        of_paper(variant, figures[system, defaults][0]),
                    )
                    for system in paper.SYSTEMS
                )
                table.append([f"{title}, {situation(defaults)}", *cells])
        figures_s = paper.COST["list generation [s]"]
        for defaults in (False, True) if asked(variant.rows) else ():
            thinking = [
                mean_beside(
                    asked(select(variant.rows, (system, defaults))),
                    lambda row: row.thinking_time_s,
                    of_paper(variant, figures_s.get((system, defaults))),
                )
                for system in paper.SYSTEMS
            ]
            table.append([f"list generation, {situation(defaults)} [s]", *thinking])
        return table

    return each_variant(found, ["", *map(str, paper.SYSTEMS)], lines)


def completion(found: Sequence[Variant]) -> Table:
    """Completion by the ground truth and by what the robot said, and SPL, for each system."""

    def lines(variant: Variant) -> Lines:
        table = []
        for system in paper.SYSTEMS:
            mine = [row for row in variant.own if row.key.system == system]
            done = summary_of(mine, lambda row: 100.0 * row.completed)
            said = summary_of(mine, lambda row: 100.0 * (row.status == MissionStatus.DONE))
            spl = summary_of(mine, lambda row: row.spl)
            if done and said and spl:
                table.append(
                    [
                        system,
                        f"{done.mean:.1f} %"
                        + in_brackets(variant, f"{100 * paper.COMPLETION[system]:.1f} %"),
                        interval(done, 1),
                        f"{said.mean:.1f} %",
                        f"{spl.mean:.2f}",
                        interval(spl, 2),
                        str(done.n),
                    ]
                )
        return table

    heads = ["system", "completed", "95 %", "said to be done", "SPL", "95 %", "n"]
    return each_variant(found, heads, lines)


def times(found: Sequence[Variant]) -> Table:
    """Mean mission time (s) of completed missions, by kind of command and condition."""

    def lines(variant: Variant) -> Lines:
        done = [row for row in variant.rows if row.completed]
        return [
            [
                kind,
                *(
                    mean_beside(
                        select(done, condition, kind),
                        lambda row: row.mission_time_s,
                        of_paper(variant, t),
                        1,
                    )
                    for condition, t in figures.items()
                ),
            ]
            for kind, figures in paper.TIME_S.items()
        ]

    return each_variant(found, ["", *map(name, paper.CONDITIONS)], lines)


def time_split(found: Sequence[Variant]) -> Table:
    """Mean mission time by activity and condition, and the factor by which thinking prolongs it."""

    def lines(variant: Variant) -> Lines:
        return [
            [
                name(condition),
                *(f"{fmean(map(column, mine)):.1f}" for column in ACTIVITIES.values()),
                _lengthened(mine),
            ]
            for condition in paper.CONDITIONS
            if (mine := select(variant.own, condition))
        ]

    heads = [f"{activity} [s]" for activity in ACTIVITIES]
    return each_variant(found, ["condition", *heads, "with thinking / without"], lines)


def _lengthened(rows: Sequence[Row]) -> str:
    """The factor by which missions are longer than without waiting for the model; "-": unknown."""
    whole_s = sum(row.mission_time_s for row in rows)
    without_s = whole_s - sum(map(_only_thinking_s, rows))
    return f"{whole_s / without_s:.3f}" if without_s > 0 else "-"


def measure(found: Sequence[Variant], title: str) -> Table:
    """Mean, interval and SD of one of `MEASURES`, for each condition."""
    column, figures = MEASURES[title]

    def lines(variant: Variant) -> Lines:
        table = []
        for condition, (mean, sd) in figures.items():
            if summary := summary_of(select(variant.own, condition), column):
                table.append(
                    [
                        name(condition),
                        f"{summary.mean:.2f}" + in_brackets(variant, f"{mean:.2f}"),
                        interval(summary, 2),
                        f"{summary.sd:.2f}" + in_brackets(variant, f"{sd:.2f}"),
                        str(summary.n),
                    ]
                )
        return table

    return each_variant(found, ["condition", "mean", "95 %", "SD", "n"], lines)


def differences(found: Sequence[Variant], title: str) -> Table:
    """Wilcoxon's signed-rank test of one of `MEASURES`, for all pairs of systems."""
    column, _ = MEASURES[title]

    def lines(variant: Variant) -> Lines:
        table = []
        for defaults in (False, True):
            commands, missions = system_tests(variant.rows, column, defaults)
            p_of_missions = {(test.a, test.b): p_value(test) for test in missions}
            for test in commands:
                table.append(
                    [
                        situation(defaults),
                        f"{test.a} - {test.b}",
                        f"{test.difference:+.2f}",
                        p_value(test),
                        p_of_missions.get((test.a, test.b), "-"),
                    ]
                )
        return table

    heads = ["situation", "systems", "difference", "p by command", "p by mission"]
    return each_variant(found, heads, lines)


Tests = list[Comparison[KnowledgeSystem]]


def system_tests(rows: Iterable[Row], column: Column, defaults: bool) -> tuple[Tests, Tests]:
    """All pairs of systems compared in a situation: by command, and by mission.

    Two systems without a common seed are compared only by command.
    """
    mine = {
        system: one
        for system in paper.SYSTEMS
        if (one := select(rows := list(rows), (system, defaults)))
    }
    return (
        pairwise({system: by_command(one, column) for system, one in mine.items()}),
        pairwise({system: by_mission(one, column) for system, one in mine.items()}),
    )


def cost(found: Sequence[Variant]) -> Table:
    """Cost of consulting the language model, for the missions that did; empty if none did."""

    def lines(variant: Variant) -> Lines:
        consulted = asked(variant.own)
        if not consulted:
            return []
        table = []
        for title, figures in paper.COST.items():
            cells = []
            for condition, figure in figures.items():
                mine = select(consulted, condition)
                ours = f"{COST[title](mine):.2f}" if mine else "-"
                cells.append(ours + in_brackets(variant, f"{figure:.2f}"))
            table.append([title, *cells])
        return table

    return each_variant(found, ["", *map(name, next(iter(paper.COST.values())))], lines)


def failures(rows: Iterable[Row], folder: Path) -> Table:
    """The reasons why missions were not completed, the most frequent first, with recordings."""
    causes: dict[tuple[str, str, str, str], list[Row]] = {}
    for row in rows:
        if not row.completed:
            where = name((row.key.system, row.defaults))
            causes.setdefault((row.status, _reason(row), row.policy, where), []).append(row)
    lines: list[list[Cell]] = []
    for cause, failed in sorted(causes.items(), key=lambda item: -len(item[1])):
        links = [
            Link(f"{row.command.rstrip('.')} (seed {row.seed})", relpath(row.run_dir, folder))
            for row in failed
            if row.run_dir
        ]
        lines.append([*cause, str(len(failed)), links or "not recorded"])
    return Table(["status", "reason", "policy", "condition", "missions", "recordings"], lines)


def asked(rows: Iterable[Row]) -> list[Row]:
    """The missions in which a language model was asked, not a stand-in."""
    return [row for row in rows if row.llm_calls and row.llm != "none"]


def _reason(row: Row) -> str:
    if row.status != MissionStatus.DONE:
        return row.reason
    return f"said to be done, but the {row.object} is truly {row.truth or 'on no furniture'}"
