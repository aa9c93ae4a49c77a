"""Formats figures for the cells of a report's tables: ours, and the paper's in brackets."""

from collections.abc import Callable, Sequence
from statistics import fmean
from typing import Any

from executive.campaign.journal import Row
from executive.campaign.report.document import Table
from executive.campaign.report.paper import Condition
from executive.campaign.report.statistics import Comparison, Summary, stars
from executive.campaign.report.variants import Column, Variant

Lines = list[list[str]]
"""The rows of a table, cell by cell."""


def name(condition: Condition) -> str:
    """The name of a condition in tables and plots."""
    system, defaults = condition
    return f"{system}, {situation(defaults)}"


def situation(defaults: bool) -> str:
    """The name of a situation: whether the ontology has default locations."""
    return "defaults" if defaults else "no defaults"


def interval(summary: Summary, digits: int) -> str:
    """The interval as text; "-" for a single command."""
    if summary.groups < 2:
        return "-"
    return f"{summary.low:.{digits}f} to {summary.high:.{digits}f}"


def mean_of(rows: Sequence[Row], column: Column) -> str:
    """The mean of a column over at least one mission."""
    return f"{fmean(map(column, rows)):.2f}"


def mean_beside(rows: Sequence[Row], column: Column, theirs: float | None, digits: int = 2) -> str:
    """Our mean ("-" without missions), and the paper's in brackets; empty if neither is known."""
    ours = f"{fmean(map(column, rows)):.{digits}f}" if rows else "" if theirs is None else "-"
    return ours + (f" ({theirs:.{digits}f})" if theirs is not None else "")


def of_paper(variant: Variant, figure: float | None) -> float | None:
    """The paper's figure, if commands and home are the same; else None."""
    return figure if variant.as_in_paper else None


def in_brackets(variant: Variant, figure: str) -> str:
    """The paper's figure in brackets; empty if commands or home differ."""
    return f" ({figure})" if variant.as_in_paper else ""


def p_value(comparison: Comparison[Any]) -> str:
    """The p value with its stars and the number of pairs."""
    p = "< 0.001" if comparison.p < 0.001 else f"{comparison.p:.3f}"
    return f"{p} {stars(comparison.p)} (n = {comparison.pairs})".replace("  ", " ")


def each_variant(
    found: Sequence[Variant], heads: Sequence[str], lines: Callable[[Variant], Lines]
) -> Table:
    """One table of all variants, with a column for their names if there are several.

    `lines` makes the rows of one variant.
    """
    if len(found) == 1:
        return Table(heads, lines(found[0]))
    named = [[variant.name, *line] for variant in found for line in lines(variant)]
    return Table(["variant", *heads], named)
