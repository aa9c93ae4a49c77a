"""The plots of a report, as SVG, readable in grey and by people with colour blindness.

The colours are from Okabe and Ito, "Color Universal Design", 2008; each has its own hatch or
marker.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from io import StringIO
from statistics import fmean
from typing import Any

import matplotlib as mpl
from matplotlib.axes import Axes
from matplotlib.figure import Figure as Drawing
from matplotlib.patches import Patch

from executive.campaign.journal import Row
from executive.campaign.report import paper
from executive.campaign.report.cells import name, situation
from executive.campaign.report.document import Figure
from executive.campaign.report.statistics import Summary, stars
from executive.campaign.report.tables import ACTIVITIES, MEASURES, system_tests
from executive.campaign.report.variants import Variant, select, summary_of
from executive.config import KnowledgeSystem

BLACK, ORANGE, SKY, GREEN, BLUE, VERMILION, PURPLE = (
    "#000000", "#E69F00", "#56B4E9", "#009E73", "#0072B2", "#D55E00", "#CC79A7",
)  # fmt: skip
OF_SYSTEM = dict(zip(paper.SYSTEMS, ((ORANGE, ""), (SKY, "///"), (GREEN, "xxx")), strict=True))
OF_ACTIVITY = dict(
    zip(
        ACTIVITIES,
        ((PURPLE, "+++"), (SKY, "///"), (ORANGE, ""), (GREEN, "xxx"), ("#DDDDDD", "\\\\")),
        strict=True,
    )
)
"""Colour and hatch of each activity."""
OF_SITUATION = {False: (VERMILION, "o"), True: (BLUE, "s")}
"""Colour and marker without default locations (False) and with them (True)."""
STYLE: Any = {
    "font.family": "DejaVu Sans",
    "font.size": 9,
    "hatch.linewidth": 0.5,
    "svg.fonttype": "none",
    "svg.hashsalt": "robot-executive",
    "axes.spines.top": False,
    "axes.spines.right": False,
}
TITLES = {"inquiries": "inquiries to the person", "visits": "pieces of furniture visited"}
FULL_BOX = "Boxes: quartiles; line: median; diamond: mean; whiskers: all missions."


def figures(found: Sequence[Variant]) -> Iterator[tuple[str, Sequence[Figure]]]:
    """All sections with their figures; all but the section `policies` show the first variant."""
    rows = found[0].rows
    whose = f" ({found[0].name})" if found[0].name else ""
    diamonds = "Diamonds: the paper. " if found[0].as_in_paper else ""
    for title in MEASURES:
        caption = (
            f"Mean {TITLES[title]}{whose}, with 95 % intervals over the commands. {diamonds}"
            "Brackets: systems that differ, by command (* p < 0.05, ** p < 0.01)."
        )
        draw = partial(_means, rows=rows, title=title, beside_paper=found[0].as_in_paper)
        yield title, [drawn(title, caption, (6.6, 3.0), draw)]
    histograms = f"How many missions had so many inquiries and visits{whose}."
    boxes = f"Inquiries and visits of single missions{whose}. {FULL_BOX}"
    yield (
        "distributions",
        [
            drawn("histograms", histograms, (6.6, 4.6), lambda d: _panels(d, rows, _histogram)),
            drawn("boxes", boxes, (6.6, 4.2), lambda d: _panels(d, rows, _boxes)),
        ],
    )
    spent = f"What the mean mission's time goes into{whose}."
    yield "time", [drawn("time", spent, (6.6, 2.8), lambda d: _time(d, rows))]
    if len(found) > 1:
        compared = "Means of every variant that asks a model or its stand-in, with 95 % intervals."
        size = (7.2, 1.4 + 0.28 * len(found))
        yield "policies", [drawn("policies", compared, size, lambda d: _policies(d, found))]


def drawn(
    file: str, caption: str, size: tuple[float, float], draw: Callable[[Drawing], None]
) -> Figure:
    """Let `draw` draw on a sheet of this size (width and height in inches)."""
    out = StringIO()
    with mpl.rc_context(STYLE):
        drawing = Drawing(figsize=size, layout="constrained")
        draw(drawing)
        drawing.savefig(out, format="svg", metadata={"Date": None})
    return Figure(file, caption, out.getvalue())


def _means(drawing: Drawing, rows: Sequence[Row], title: str, beside_paper: bool) -> None:
    column, figures = MEASURES[title]
    panels = drawing.subplots(1, 2, sharey=True)
    for defaults, axes in zip((False, True), panels, strict=True):
        tops: dict[KnowledgeSystem, float] = {}
        for x, system in enumerate(paper.SYSTEMS):
            theirs = figures[system, defaults][0] if beside_paper else 0.0
            if beside_paper:
                axes.plot(x, theirs, "D", color=BLACK, markersize=5, zorder=4)
            if summary := summary_of(select(rows, (system, defaults)), column):
                color, hatch = OF_SYSTEM[system]
                axes.bar(x, summary.mean, 0.62, color=color, hatch=hatch, edgecolor=BLACK)
                axes.errorbar(x, summary.mean, _reach(summary), color=BLACK, capsize=4)
                tops[system] = max(summary.high, theirs)
        _brackets(axes, rows, title, defaults, tops)
        axes.set_xticks(range(len(paper.SYSTEMS)), list(map(str, paper.SYSTEMS)))
        axes.set_title(situation(defaults))
    panels[0].set_ylabel(TITLES[title].replace(" to ", "\nto ").replace(" visited", "\nvisited"))


def _reach(summary: Summary) -> list[list[float]]:
    """Distances of the interval's ends below and above the mean, as error bars need them."""
    return [[max(0.0, summary.mean - summary.low)], [max(0.0, summary.high - summary.mean)]]


def _brackets(
    axes: Axes,
    rows: Sequence[Row],
    title: str,
    defaults: bool,
    tops: Mapping[KnowledgeSystem, float],
) -> None:
    """Draw brackets with stars between the systems that differ significantly, above the bars.

    `tops` are the heights of the bars with their error bars.
    """
    step = max([*tops.values(), 1.0]) * 0.12
    height = max([*tops.values(), 0.0]) + step * 0.6
    for test in system_tests(rows, MEASURES[title][0], defaults)[0]:
        if mark := stars(test.p):
            left, right = paper.SYSTEMS.index(test.a), paper.SYSTEMS.index(test.b)
            foot = height - step * 0.25
            axes.plot([left, left, right, right], [foot, height, height, foot], "k-", lw=0.9)
            axes.text((left + right) / 2, height, mark, ha="center", va="bottom", fontsize=8)
            height += step


Panel = Callable[[Axes, Sequence[Row], str, bool], None]


def _panels(drawing: Drawing, rows: Sequence[Row], panel: Panel) -> None:
    """Draw four panels and one legend.

    Inquiries are above, visits below; without default locations left, with them right.
    """
    grid = drawing.subplots(2, 2, sharey="row", sharex="row")
    for line, title in zip(grid, MEASURES, strict=True):
        for axes, defaults in zip(line, (False, True), strict=True):
            panel(axes, rows, title, defaults)
            axes.set_title(f"{title}, {situation(defaults)}", fontsize=9)
    handles = [
        Patch(facecolor=color, hatch=hatch, edgecolor=BLACK, label=str(system))
        for system, (color, hatch) in OF_SYSTEM.items()
    ]
    drawing.legend(handles=handles, loc="outside lower center", ncols=3, frameon=False)


def _histogram(axes: Axes, rows: Sequence[Row], title: str, defaults: bool) -> None:
    column, _ = MEASURES[title]
    most = round(max(map(column, rows), default=0.0))
    for place, system in enumerate(paper.SYSTEMS):
        values = [column(row) for row in select(rows, (system, defaults))]
        color, hatch = OF_SYSTEM[system]
        xs = [value + (place - 1) * 0.27 for value in range(most + 1)]
        counts = [values.count(value) for value in range(most + 1)]
        axes.bar(xs, counts, 0.27, color=color, hatch=hatch, edgecolor=BLACK, linewidth=0.7)
    axes.set_xticks(range(most + 1))
    if not defaults:
        axes.set_ylabel("missions")


def _boxes(axes: Axes, rows: Sequence[Row], title: str, defaults: bool) -> None:
    column, _ = MEASURES[title]
    values = [[column(row) for row in select(rows, (s, defaults))] for s in paper.SYSTEMS]
    drawn = axes.boxplot(
        values,
        patch_artist=True,
        showmeans=True,
        whis=(0, 100),
        widths=0.55,
        medianprops={"color": BLACK, "linewidth": 1.8},
        meanprops={"marker": "D", "markerfacecolor": "white", "markeredgecolor": BLACK},
    )
    for box, (color, hatch) in zip(drawn["boxes"], OF_SYSTEM.values(), strict=True):
        box.set(facecolor=color, hatch=hatch, edgecolor=BLACK)
    axes.set_xticks(range(1, 1 + len(paper.SYSTEMS)), [""] * len(paper.SYSTEMS))
    if not defaults:
        axes.set_ylabel(title)


def _time(drawing: Drawing, rows: Sequence[Row]) -> None:
    axes = drawing.subplots()
    shown = [(c, mine) for c in paper.CONDITIONS if (mine := select(rows, c))]
    lefts = [0.0] * len(shown)
    for activity, column in ACTIVITIES.items():
        widths = [fmean(map(column, mine)) for _, mine in shown]
        color, hatch = OF_ACTIVITY[activity]
        style: Any = {"color": color, "hatch": hatch, "edgecolor": BLACK, "linewidth": 0.7}
        axes.barh(range(len(shown)), widths, 0.62, left=lefts, label=activity, **style)
        lefts = [left + width for left, width in zip(lefts, widths, strict=True)]
    axes.set_yticks(range(len(shown)), [name(condition) for condition, _ in shown])
    axes.invert_yaxis()
    axes.set_xlim(0, 1.03 * max([1.0, *lefts]))
    axes.set_xlabel("mission time [s]")
    drawing.legend(loc="outside lower center", ncols=len(ACTIVITIES), frameon=False)


def _policies(drawing: Drawing, found: Sequence[Variant]) -> None:
    """Compare the variants, each by its last system but okb: the one with a memory, if it ran."""
    panels = drawing.subplots(1, 2, sharey=True)
    for axes, title in zip(panels, MEASURES, strict=True):
        for y, variant in enumerate(found):
            for defaults, (color, marker) in OF_SITUATION.items():
                shown = [select(variant.rows, (s, defaults)) for s in paper.SYSTEMS[1:]]
                mine = next((rows for rows in reversed(shown) if rows), None)
                summary = summary_of(mine, MEASURES[title][0]) if mine else None
                if summary:
                    place = y + (0.16 if defaults else -0.16)
                    reach = _reach(summary)
                    style = {"color": color, "marker": marker, "capsize": 3, "markersize": 5}
                    label = situation(defaults) if y == 0 and title == "visits" else None
                    axes.errorbar(summary.mean, place, xerr=reach, ls="", label=label, **style)
        axes.set_xlabel(TITLES[title])
        axes.set_xlim(left=-0.05)
        axes.grid(axis="x", color="#cccccc", linewidth=0.5)
    panels[0].set_yticks(range(len(found)), [variant.name.replace("$", r"\$") for variant in found])
    panels[0].invert_yaxis()
    drawing.legend(loc="outside lower center", ncols=2, frameon=False)
