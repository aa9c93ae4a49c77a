"""The plots of a study's report: every participant a line, and the mean of each condition."""

from collections.abc import Sequence
from math import ceil

from matplotlib.axes import Axes
from matplotlib.figure import Figure as Drawing

from executive.campaign.report.document import Figure
from executive.campaign.report.plots import BLACK, BLUE, drawn
from executive.page.study.measures import Measure

COLUMNS = 3
CAPTION = (
    "Grey: each participant. Blue: the mean of each condition, with its 95 % interval over the "
    "participants."
)


def figure(file: str, measures: Sequence[Measure]) -> Figure:
    """A panel for each measure."""
    lines = ceil(len(measures) / COLUMNS)

    def draw(drawing: Drawing) -> None:
        grid = drawing.subplots(lines, COLUMNS, squeeze=False).ravel()
        for axes, measure in zip(grid, measures, strict=False):
            _panel(axes, measure)
        for axes in grid[len(measures) :]:
            axes.set_axis_off()

    return drawn(file, CAPTION, (7.2, 2.4 * lines), draw)


def _panel(axes: Axes, measure: Measure) -> None:
    names = list(measure.values)
    codes = dict.fromkeys(code for of_one in measure.values.values() for code in of_one)
    for code in codes:
        met = [
            (x, measure.values[name][code])
            for x, name in enumerate(names)
            if code in measure.values[name]
        ]
        axes.plot(*zip(*met, strict=True), color="#bbbbbb", lw=0.7, marker=".", markersize=3)
    for x, name in enumerate(names):
        if one := measure.summary(name):
            reach = [[max(0.0, one.mean - one.low)], [max(0.0, one.high - one.mean)]]
            axes.errorbar(
                x,
                one.mean,
                yerr=reach,
                color=BLUE,
                marker="D",
                markeredgecolor=BLACK,
                capsize=4,
                lw=1.6,
            )
    axes.set_xticks(range(len(names)), [name.replace("$", r"\$") for name in names])
    axes.set_xlim(-0.5, len(names) - 0.5)
    axes.set_ylim(bottom=min(0.0, axes.get_ylim()[0]))
    axes.set_title(measure.name.replace("$", r"\$"), fontsize=8)
