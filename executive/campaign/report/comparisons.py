"""Tables that compare variants of a campaign: policies, homes and models."""

from collections.abc import Mapping, Sequence
from statistics import fmean

from executive.campaign.journal import Row
from executive.campaign.report import paper
from executive.campaign.report.cells import Lines, interval, mean_of, name, p_value
from executive.campaign.report.document import Table
from executive.campaign.report.paper import Condition
from executive.campaign.report.statistics import Comparison, compare, stars, summarize
from executive.campaign.report.tables import MEASURES
from executive.campaign.report.variants import Column, Variant, by_command, select, summary_of
from kb.benchmark.calibration import calibration


def policies(found: Sequence[Variant]) -> Table:
    """Compare every variant with the first of its home, in each condition with several variants."""
    columns = {title: column for title, (column, _) in MEASURES.items()}
    lines: Lines = []
    for condition in paper.CONDITIONS:
        mine = _by_variant(found, condition)
        if len(mine) < 2:
            continue
        marks = {title: _against_first(mine, column) for title, column in columns.items()}
        for variant, rows in mine.items():
            lines.append(
                [
                    name(condition),
                    variant,
                    *(mean_of(rows, columns[t]) + marks[t].get(variant, "") for t in columns),
                    mean_of(rows, lambda row: row.failed_visits),
                    f"{sum(row.invented for row in rows)} of {sum(row.named for row in rows)}",
                    f"{100 * fmean(row.completed for row in rows):.1f} %",
                    mean_of(rows, lambda row: row.spl),
                    str(len(rows)),
                ]
            )
    heads = ["failed visits", "invented names", "completed", "SPL", "n"]
    return Table(["condition", "variant", *columns, *heads], lines)


def searching(found: Sequence[Variant]) -> Table:
    """Duration of searches, and their cost including questions."""
    lines: Lines = []
    for condition in paper.CONDITIONS:
        mine = _by_variant(found, condition)
        marks = _against_first(mine, _cost_s) if len(mine) > 1 else {}
        for variant, rows in mine.items():
            search = summary_of(rows, lambda row: row.search_s)
            cost = summary_of(rows, _cost_s)
            if search and cost:
                lines.append(
                    [
                        name(condition),
                        variant or "-",
                        f"{search.mean:.1f}",
                        interval(search, 1),
                        mean_of(rows, lambda row: row.inquiries),
                        f"{cost.mean:.1f}" + marks.get(variant, ""),
                        interval(cost, 1),
                        str(len(rows)),
                    ]
                )
    heads = ["condition", "variant", "search [s]", "95 %", "inquiries", "cost [s]", "95 %", "n"]
    return Table(heads, lines)


def cost_differences(found: Sequence[Variant]) -> Table:
    """Differences in the cost of a search from the first variant of the same home."""
    lines: Lines = []
    for condition in paper.CONDITIONS:
        mine = _by_variant(found, condition)
        for test in _tests_with_first(mine, _cost_s):
            theirs, ours = (by_command(mine[one], _cost_s) for one in (test.a, test.b))
            each = {str(unit): [ours[unit] - theirs[unit]] for unit in ours if unit in theirs}
            if difference := summarize(each):
                figures = f"{difference.mean:+.1f}", interval(difference, 1), p_value(test)
                lines.append([name(condition), test.b, test.a, *figures])
    return Table(["condition", "variant", "beside", "cost [s]", "95 %", "p"], lines)


def _cost_s(row: Row) -> float:
    return row.cost_s


def trust(found: Sequence[Variant]) -> Table:
    """Calibration of the belief before the first look."""
    lines: Lines = []
    for condition in paper.CONDITIONS:
        for variant in found:
            rows = [row for row in select(variant.own, condition) if row.sure]
            if rows:
                was = calibration(map(_prediction, rows))
                lines.append(
                    [
                        name(condition),
                        variant.name,
                        mean_of(rows, lambda row: row.sure),
                        mean_of(rows, _correctness),
                        f"{was.error:.2f}",
                        f"{was.log_score:.2f}",
                        str(len(rows)),
                    ]
                )
    heads = ["likeliest place", "is right", "calibration error", "log score"]
    return Table(["condition", "variant", *heads, "n"], lines)


def _correctness(row: Row) -> float:
    """Expected correctness of the likeliest place; of equally likely ones, any may be first."""
    return (row.sure_of_it >= row.sure) / row.as_likely


def _prediction(row: Row) -> tuple[dict[str, float], list[str]]:
    """The believed probabilities and the true places of a mission, for `calibration`.

    If the true place is among the likeliest, all of these are taken for true, so that each counts
    for a part.
    """
    if _correctness(row):
        alike = [f"place {number}" for number in range(row.as_likely)]
        return dict.fromkeys(alike, row.sure), alike
    return {"another": row.sure, "it": row.sure_of_it}, ["it"]


def _by_variant(found: Sequence[Variant], condition: Condition) -> dict[str, list[Row]]:
    """The missions of a condition by variant; variants without any are left out."""
    return {variant.name: mine for variant in found if (mine := select(variant.own, condition))}


def _against_first(rows: Mapping[str, Sequence[Row]], column: Column) -> dict[str, str]:
    """The stars for each variant's difference from the first of its home, paired by command."""
    return {test.b: f" {stars(test.p)}".rstrip() for test in _tests_with_first(rows, column)}


def _tests_with_first(rows: Mapping[str, Sequence[Row]], column: Column) -> list[Comparison[str]]:
    """Comparisons of the first variant of each home with all others of that home."""
    columns = {variant: by_command(mine, column) for variant, mine in rows.items()}
    first: dict[str, str] = {}
    for variant, mine in rows.items():
        first.setdefault(mine[0].home, variant)
    pairs = [(first[mine[0].home], variant) for variant, mine in rows.items()]
    return compare(columns, [(one, other) for one, other in pairs if one != other])
