"""The benchmark's tables as a picture. Needs matplotlib, of the extra `benchmark`."""

from collections.abc import Mapping, Sequence
from pathlib import Path

import matplotlib as mpl
from matplotlib.figure import Figure

from kb.benchmark.measures import Measures

KINDS = (".svg", ".png", ".pdf")
PRECISION, FIRST = "#0072B2", "#E69F00"
"""Blue and orange of Okabe and Ito, "Color Universal Design", 2008."""
WIDTH, LEGEND, TITLE, BAR = 8.0, 0.3, 0.7, 0.33
"""Of the picture, of the legend, of a title with its axis, of a pair of bars (inches)."""


def draw(path: Path, tables: Mapping[str, Sequence[tuple[str, Measures]]]) -> None:
    """Two bars for each way of finding out, a panel for each table.

    Raises:
        OSError: if the file cannot be written.
    """
    mpl.rcParams.update({"svg.hashsalt": "robot-executive", "svg.fonttype": "none"})
    heights = [TITLE + BAR * len(rows) for rows in tables.values()]
    figure = Figure(figsize=(WIDTH, LEGEND + sum(heights)), layout="constrained")
    panels = figure.subplots(len(tables), squeeze=False, height_ratios=heights)[:, 0]
    for axes, (title, rows) in zip(panels, tables.items(), strict=True):
        ways = [way for way, _ in rows]
        for measure, offset, color, label in (
            ([m.average_precision for _, m in rows], -0.2, PRECISION, "mean average precision"),
            ([m.first for _, m in rows], 0.2, FIRST, "a right place first"),
        ):
            bars = axes.barh([i + offset for i in range(len(rows))], measure, 0.38, color=color)
            bars.set_label(label)
            axes.bar_label(bars, fmt="%.2f", padding=2, fontsize=8)
        axes.set_yticks(range(len(rows)), ways)
        axes.invert_yaxis()
        axes.set_xlim(0, 1.05)
        axes.set_title(title, loc="left", fontsize=10)
        axes.spines[["top", "right"]].set_visible(False)
    handles, labels = panels[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper right", ncols=2, fontsize=8)
    figure.savefig(path, metadata={"Date": None} if path.suffix == ".svg" else None)
