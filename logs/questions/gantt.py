"""Draws what ran when: a row for each behaviour, a bar from its start to its end."""

from collections import Counter
from collections.abc import Iterator, Sequence
from math import ceil
from xml.sax.saxutils import escape

from executive.text import printable
from logs.questions.report import Span

ROW, HEIGHT, MARGIN = 22.0, 14.0, 12.0
"""Distance from row to row, height of a bar, outer margin (px)."""
WIDTH, LETTER = 900.0, 6.2
"""Width of the time axis, and of a letter (px)."""
LEAST = 2.0
"""The least width of a bar (px), for one without a duration."""
STEPS_S = (0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 30, 60, 120, 300, 600)
MOST_MARKS = 12

COLORS = {
    "RUNNING": "#f2a93b",
    "SUCCESS": "#3fb950",
    "FAILURE": "#e5534b",
    "INVALID": "#8b949e",
}

STYLE = """
text { font: 11px "DejaVu Sans", Verdana, sans-serif; fill: #1f2328; dominant-baseline: central }
line { stroke: #d0d7de }
"""


def svg(spans: Sequence[Span]) -> str:
    """The spans as an SVG file (W3C SVG 1.1), mission time (s) from left to right.

    The tooltip of a bar shows its times and the message of the behaviour.
    """
    paths = list(dict.fromkeys(span.path for span in spans))
    rows = {path: row for row, path in enumerate(paths)}
    names = _names(paths)
    labels = max((len(name) for name in names), default=0) * LETTER
    end_s = max((span.end_s for span in spans), default=0.0)
    axis = _Axis(2 * MARGIN + labels, WIDTH / max(end_s, 1e-3))
    bottom = MARGIN + ROW * len(paths)
    shapes = [*_scale(axis, end_s, bottom)]
    for row, name in enumerate(names):
        shapes.append(_text(MARGIN, MARGIN + (row + 0.5) * ROW, name))
    shapes += [_bar(span, axis, rows[span.path]) for span in spans]
    width, height = axis.x(end_s) + 4 * MARGIN, bottom + ROW + MARGIN
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width:.0f}" height="{height:.0f}" '
        f'viewBox="0 0 {width:.0f} {height:.0f}">\n<style>{STYLE}</style>\n'
        '<rect width="100%" height="100%" fill="white"/>\n' + "\n".join(shapes) + "\n</svg>\n"
    )


class _Axis:
    """Converts mission time (s) to pixels."""

    def __init__(self, left: float, pixels_a_second: float) -> None:
        self._left = left
        self._scale = pixels_a_second

    def x(self, time_s: float) -> float:
        return self._left + time_s * self._scale


def _names(paths: Sequence[str]) -> list[str]:
    """The last name of each path; if this is ambiguous, with the name before it."""
    last = [path.rpartition("/")[2] for path in paths]
    times = Counter(last)
    return [
        name if times[name] == 1 else "/".join(path.split("/")[-2:])
        for path, name in zip(paths, last, strict=True)
    ]


def _scale(axis: _Axis, end_s: float, bottom: float) -> Iterator[str]:
    longest = STEPS_S[-1]
    step = next(
        (s for s in STEPS_S if end_s / s <= MOST_MARKS),
        longest * ceil(end_s / longest / MOST_MARKS),
    )
    for number in range(int(end_s / step) + 1):
        x = axis.x(number * step)
        yield f'<line x1="{x:.1f}" y1="{MARGIN:.1f}" x2="{x:.1f}" y2="{bottom:.1f}"/>'
        yield _text(x, bottom + ROW / 2, f"{number * step:g} s", "middle")


def _bar(span: Span, axis: _Axis, row: int) -> str:
    left, right = axis.x(span.start_s), axis.x(span.end_s)
    top = MARGIN + row * ROW + (ROW - HEIGHT) / 2
    what = f"{span.start_s:.3f} to {span.end_s:.3f} s  {span.status}  {span.path}  {span.message}"
    return (
        f'<rect x="{left:.1f}" y="{top:.1f}" width="{max(right - left, LEAST):.1f}" '
        f'height="{HEIGHT:.0f}" fill="{COLORS[span.status]}">'
        f"<title>{escape(printable(what.strip()))}</title></rect>"
    )


def _text(x: float, y: float, text: str, anchor: str = "start") -> str:
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}">{escape(printable(text))}</text>'
