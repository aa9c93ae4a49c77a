"""The plot of weeks: a panel per measure, a line per policy, distinguishable also in grey."""

from collections.abc import Mapping, Sequence
from itertools import cycle

from matplotlib.figure import Figure as Drawing

from executive.campaign.report.document import Figure
from executive.campaign.report.plots import (
    BLUE,
    GREEN,
    ORANGE,
    PURPLE,
    SKY,
    VERMILION,
    drawn,
)
from executive.campaign.report.statistics import Summary

LINES = (
    (BLUE, "o", "-"),
    (VERMILION, "s", "--"),
    (GREEN, "^", "-."),
    (PURPLE, "D", ":"),
    (ORANGE, "v", "-"),
    (SKY, "x", "--"),
)
"""Colour, marker and line style of each policy."""
CAPTION = "By week, the mean of all households, with 95 % intervals over the days."


def figure(shown: Mapping[str, Mapping[str, Sequence[Summary | None]]]) -> Figure:
    """Plot all measures side by side; `shown` maps titles to policies to weekly means."""

    def draw(drawing: Drawing) -> None:
        panels = drawing.subplots(2, (len(shown) + 1) // 2, sharex=True, squeeze=False)
        for axes, (title, policies) in zip(panels.flat, shown.items(), strict=False):
            for (color, marker, line), (name, weeks) in zip(
                cycle(LINES), policies.items(), strict=False
            ):
                known = [(week, one) for week, one in enumerate(weeks, start=1) if one]
                means = [one.mean for _, one in known]
                reach = [
                    [max(0.0, one.mean - one.low) for _, one in known],
                    [max(0.0, one.high - one.mean) for _, one in known],
                ]
                at = [week for week, _ in known]
                style = {"color": color, "marker": marker, "ls": line, "markersize": 4}
                axes.errorbar(at, means, yerr=reach, capsize=2, label=name, lw=1.2, **style)
            axes.set_title(title, fontsize=9)
            axes.set_ylim(bottom=0)
            axes.grid(axis="y", color="#cccccc", linewidth=0.5)
        for axes in panels[-1]:
            axes.set_xlabel("week")
        handles, labels = panels[0][0].get_legend_handles_labels()
        drawing.legend(handles, labels, loc="outside lower center", ncols=3, frameon=False)

    return drawn("weeks", CAPTION, (7.2, 5.2), draw)
