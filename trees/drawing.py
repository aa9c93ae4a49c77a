"""Draws a tree as SVG, from left to right: a row for each leaf, parents left of children."""

from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass
from uuid import UUID
from xml.sax.saxutils import escape

from py_trees.behaviour import Behaviour
from py_trees.composites import Parallel, Selector, Sequence
from py_trees.decorators import FailureIsSuccess, SuccessIsFailure

from trees.asking import Ask
from trees.body import BodyAction
from trees.model import ModelAction
from trees.nodes import EachOf, FirstOf
from trees.person import Announce, Apologise, Report

ROW, HEIGHT, GAP, MARGIN = 30.0, 22.0, 26.0, 12.0
"""Distance between rows, height of a box, gap between columns, outer margin (px)."""
LETTER, PADDING = 6.7, 9.0
"""Average width of a letter, and the space on each side of a box's text (px)."""

SIGNS: tuple[tuple[type, str, str], ...] = (
    (Sequence, "→", "all in order"),
    (Selector, "?", "the first that succeeds"),
    (Parallel, "⇉", "all at once"),
    (FirstOf, "∃", "loop, until one succeeds"),
    (EachOf, "∀", "loop over all"),
    (FailureIsSuccess, "✓", "failure is success"),
    (SuccessIsFailure, "↷", "success is failure: what comes next is tried"),
)
"""The type of a composite or decorator, its sign, and what the sign means."""
WHO: tuple[tuple[tuple[type, ...], str, str], ...] = (
    ((BodyAction,), "#cfe3fa", "robot"),
    ((ModelAction,), "#e3d3f7", "language model"),
    ((Ask, Announce, Report, Apologise), "#fbe2c2", "person"),
)
"""The types of leaves, their colour, and whom they work with."""
BY_ITSELF, COMPOSITE = "#dcefdc", "#eceff2"

STYLE = """
text { font: 12px "DejaVu Sans", Verdana, sans-serif; fill: #1f2328; dominant-baseline: central }
.sign { font-weight: bold; fill: #57606a }
rect { stroke: #8b949e; stroke-width: .8 }
path { fill: none; stroke: #8b949e; stroke-width: 1.2 }
"""


@dataclass(frozen=True, slots=True)
class _Box:
    """A node with its position: `column` is its depth; `row` may lie between two rows of leaves."""

    node: Behaviour
    column: int
    row: float
    parent: Behaviour | None

    @property
    def label(self) -> str:
        return f"{sign(self.node)} {self.node.name}".strip()

    @property
    def width(self) -> float:
        return len(self.label) * LETTER + 2 * PADDING


def svg(root: Behaviour) -> str:
    """The tree as the text of an SVG file (W3C SVG 1.1), with a legend."""
    boxes = {box.node.id: box for box in _place(root, 0, 0.0, None)}
    lefts = _columns(list(boxes.values()))
    width = max(lefts[box.column] + box.width for box in boxes.values()) + MARGIN
    rows = max(box.row for box in boxes.values()) + 1
    shapes = [shape for box in boxes.values() for shape in _draw(box, boxes, lefts)]
    shapes += _legend(MARGIN + (rows + 1) * ROW)
    height = MARGIN + (rows + 1 + len(SIGNS)) * ROW + MARGIN
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width:.0f}" height="{height:.0f}" '
        f'viewBox="0 0 {width:.0f} {height:.0f}">\n<style>{STYLE}</style>\n'
        '<rect width="100%" height="100%" style="fill: white; stroke: none"/>\n'
        + "\n".join(shapes)
        + "\n</svg>\n"
    )


def sign(node: Behaviour) -> str:
    """The sign of a composite or a decorator; empty for a leaf."""
    return next((sign for kind, sign, _ in SIGNS if isinstance(node, kind)), "")


def color(node: Behaviour) -> str:
    """The colour of a behaviour, by whom it works with."""
    if node.children:
        return COMPOSITE
    return next((color for kinds, color, _ in WHO if isinstance(node, kinds)), BY_ITSELF)


def _place(
    node: Behaviour, column: int, first_row: float, parent: Behaviour | None
) -> Iterator[_Box]:
    """Boxes of a subtree whose first leaf is in `first_row`, the root last."""
    if not node.children:
        yield _Box(node, column, first_row, parent)
        return
    row, middles = first_row, list[float]()
    for child in node.children:
        boxes = list(_place(child, column + 1, row, node))
        yield from boxes
        middles.append(boxes[-1].row)
        row += sum(1 for box in boxes if not box.node.children)
    yield _Box(node, column, (middles[0] + middles[-1]) / 2, parent)


def _columns(boxes: list[_Box]) -> list[float]:
    """Left edge of each column (px); leaves need no space, as nothing is to their right."""
    widths: dict[int, float] = defaultdict(float)
    for box in boxes:
        if box.node.children:
            widths[box.column] = max(widths[box.column], box.width)
    lefts = [MARGIN]
    for column in range(max(box.column for box in boxes)):
        lefts.append(lefts[-1] + widths[column] + GAP)
    return lefts


def _draw(box: _Box, boxes: dict[UUID, _Box], lefts: list[float]) -> Iterator[str]:
    left, middle = lefts[box.column], _middle(box.row)
    if box.parent is not None:
        beside = boxes[box.parent.id]
        start = lefts[beside.column] + beside.width
        bend = left - GAP / 2
        yield (
            f'<path d="M{start:.1f} {_middle(beside.row):.1f} H{bend:.1f} '
            f'V{middle:.1f} H{left:.1f}"/>'
        )
    yield _rectangle(left, middle, box.width, color(box.node), rounded=not box.node.children)
    yield _text(left + PADDING, middle, box.label)


def _middle(row: float) -> float:
    return MARGIN + row * ROW + HEIGHT / 2


def _legend(top: float) -> Iterator[str]:
    """The signs, and next to them the colours."""
    for number, (_, sign, meaning) in enumerate(SIGNS):
        y = top + number * ROW + HEIGHT / 2
        yield _text(MARGIN + PADDING, y, f"{sign}   {meaning}")
    leaves = [*((color, f"works with the {who}") for _, color, who in WHO), (BY_ITSELF, "decides")]
    for number, (fill, meaning) in enumerate(leaves):
        y = top + number * ROW + HEIGHT / 2
        yield _rectangle(MARGIN + 230, y, 30, fill, rounded=True)
        yield _text(MARGIN + 270, y, meaning)


def _rectangle(left: float, middle: float, width: float, fill: str, *, rounded: bool) -> str:
    return (
        f'<rect x="{left:.1f}" y="{middle - HEIGHT / 2:.1f}" width="{width:.1f}" '
        f'height="{HEIGHT:.0f}" rx="{HEIGHT / 2 if rounded else 3:.0f}" fill="{fill}"/>'
    )


def _text(left: float, middle: float, text: str) -> str:
    return f'<text x="{left:.1f}" y="{middle:.1f}">{escape(text)}</text>'
