"""Draws the benchmark's tables. Needs matplotlib, from the extra `benchmark`."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from textwrap import fill

import matplotlib as mpl
from matplotlib.figure import Figure

from kb.benchmark.calibration import BINS, Calibration
from kb.benchmark.measures import Measures

KINDS = (".svg", ".png", ".pdf")
PRECISION, FIRST = "#0072B2", "#E69F00"
"""Blue and orange of Okabe and Ito, "Color Universal Design", 2008."""
SIDE, LETTERS = 3.6, 44
"""Size of a square panel (inches); length of a title line (characters)."""
WIDTH, LEGEND, TITLE, BAR = 8.0, 0.3, 0.7, 0.33
"""Width of the picture; heights of legend, title with axis, and pair of bars (inches)."""


def draw_reliability(path: Path, told: Mapping[str, Calibration]) -> None:
    """Draw `reliability` into a file.

    Raises:
        OSError: if the file cannot be written.
    """
    mpl.rcParams.update({"svg.hashsalt": "robot-executive", "svg.fonttype": "none"})
    figure = reliability(told)
    figure.savefig(path, metadata={"Date": None} if path.suffix == ".svg" else None)


def reliability(told: Mapping[str, Calibration]) -> Figure:
    """How often the first place is right, over its predicted probability; one panel for each set.

    The number of things in each bin of 0.1 is written above it.
    """
    figure = Figure(figsize=(SIDE * max(1, len(told)), SIDE), layout="constrained")
    panels = figure.subplots(1, max(1, len(told)), squeeze=False)[0]
    for axes, (title, found) in zip(panels, told.items(), strict=False):
        axes.plot([0, 1], [0, 1], color="grey", linewidth=1, linestyle="--")
        chances, right, numbers = zip(*found.bins, strict=True)
        axes.plot(chances, right, color=PRECISION, marker="o", clip_on=False)
        tenths = [(min(int(chance * BINS), BINS - 1) + 0.5) / BINS for chance in chances]
        above = axes.secondary_xaxis("top")
        above.set_xticks(tenths, list(map(str, numbers)), fontsize=8)
        above.set_xlabel("things", fontsize=8)
        above.tick_params(length=0)
        error = f"calibration error {found.error:.2f}, log score {found.log_score:.2f}"
        axes.set_title(f"{fill(title, LETTERS)}\n{error}", loc="left", fontsize=8)
        axes.set_xlabel("said to be so likely", fontsize=8)
        axes.set_ylabel("so often right", fontsize=8)
        axes.set_xlim(0, 1)
        axes.set_ylim(0, 1)
    return figure


def draw(path: Path, tables: Mapping[str, Sequence[tuple[str, Measures]]]) -> None:
    """Draw two bars for each method, and one panel for each table.

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
