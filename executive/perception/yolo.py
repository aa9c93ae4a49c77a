"""Converts outputs of the YOLO family to one form: boxes, scores, classes."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from executive.errors import InputError
from executive.text import counted

Floats32 = NDArray[np.float32]

MASKS = 32
"""Number of mask coefficients after the classes, in exports for segmentation."""
MOST_ENDED = 5000
"""The largest number of rows of an output after suppression; grids have more."""
_TOLERANCE = 0.01
_OTHER_TASKS = ("pose", "obb", "classify")


@dataclass(frozen=True, slots=True)
class Layout:
    """The layout of an output.

    Attributes:
        output: index among the network's outputs.
        kind: `grid`: the box, then a probability for each class (YOLOv8 and later); `objectness`:
            the same with an objectness score after the box (YOLOv5, v7); `ended`: corners, score,
            class, after suppression (YOLOv10, and exports with `nms=True`).
        columns: how many numbers there are for a box.
        turned: whether the output is transposed: a box is a column.
    """

    output: int
    kind: Literal["grid", "objectness", "ended"]
    columns: int
    turned: bool = False

    def rows(self, outputs: Sequence[Floats32], where: str) -> Floats32:
        """The output as (n, columns).

        Raises:
            InputError: if it does not have this layout.
        """
        output = outputs[self.output] if self.output < len(outputs) else np.zeros(0, np.float32)
        if output.ndim == 3 and output.shape[2 - self.turned] == self.columns:
            rows: Floats32 = output[0]
            return rows.T if self.turned else rows
        raise InputError(where, f"its output is now {output.shape}", "export it for one size")


@dataclass(frozen=True, slots=True, eq=False)
class Boxes:
    """The boxes in an output, unsorted.

    Attributes:
        corners: (n, 4): left, top, right, bottom.
        scores: (n,).
        classes: (n,), indices in the class list.
    """

    corners: Floats32
    scores: Floats32
    classes: NDArray[np.int64]


def layout_of(
    outputs: Sequence[Floats32], classes: int, metadata: Mapping[str, str], where: str
) -> Layout:
    """Find the output to read, and its layout; if several fit, its values and metadata decide.

    Args:
        outputs: the outputs for some picture.
        classes: number of names in the class list.
        metadata: the file's metadata.
        where: the file, for messages.

    Raises:
        InputError: if none fits, or the network is for another task or for several pictures at
            once.
    """
    if (task := metadata.get("task")) in _OTHER_TASKS:
        raise InputError(where, f"is a network for the task {task}", "export one that detects")
    if any(output.ndim == 3 and output.shape[0] > 1 for output in outputs):
        raise InputError(where, "answers for several pictures at once", "export it for one picture")
    found = list(_layouts(outputs, classes))
    ended = [layout for layout in found if layout.kind == "ended"]
    others = [layout for layout in found if layout.kind != "ended"]
    says = metadata.get("end2end") == "True" or "'nms': True" in metadata.get("args", "")
    if ended and (says or not others or _looks_ended(ended[0].rows(outputs, where))):
        return ended[0]
    if not others:
        shapes = ", ".join(str(output.shape) for output in outputs) or "none"
        raise InputError(
            where,
            f"its output is {shapes} and its class list has {counted(classes, 'name')}",
            f"(1, {4 + classes}, n), (1, n, {5 + classes}) or (1, n, 6) goes with them",
        )
    return others[0]


def _layouts(outputs: Sequence[Floats32], classes: int) -> Iterator[Layout]:
    """All layouts that fit by the number of columns."""
    masks = any(o.ndim == 4 and MASKS in (o.shape[1], o.shape[3]) for o in outputs)
    for number, output in enumerate(outputs):
        if output.ndim != 3:
            continue
        _, first, second = output.shape
        for more in (0, MASKS) if masks else (0,):
            grid, objectness, ended = 4 + classes + more, 5 + classes + more, 6 + more
            if first == grid and not (second == ended and first > second):
                yield Layout(number, "grid", grid, turned=True)
                continue
            if second == ended and first <= MOST_ENDED:
                yield Layout(number, "ended", ended)
            if second == objectness:
                yield Layout(number, "objectness", objectness)
            if second == grid:
                yield Layout(number, "grid", grid)


def _looks_ended(rows: Floats32) -> bool:
    """Whether the rows can be corners, score and class: a class is an integer."""
    numbers, scores = rows[:, 5], rows[:, 4]
    of_classes = (numbers == np.floor(numbers)) & (numbers >= 0)
    ordered = (rows[:, 2] >= rows[:, 0]) & (rows[:, 3] >= rows[:, 1])
    return bool((of_classes & ordered & (scores >= 0) & (scores <= 1 + _TOLERANCE)).all())


@np.errstate(all="ignore")
def read(rows: Floats32, layout: Layout, classes: int) -> Boxes:
    """The boxes with their best class, without those that are not finite, empty or unclassified."""
    if layout.kind == "ended":
        corners, best, numbers = rows[:, :4], rows[:, 4], rows[:, 5]
    else:
        half = rows[:, 2:4] / 2
        corners = np.concatenate((rows[:, :2] - half, rows[:, :2] + half), axis=1)
        scores = probabilities(rows, layout, classes)
        if layout.kind == "objectness":
            scores = scores[:, :1] * scores[:, 1:]
        numbers = scores.argmax(axis=1).astype(np.float32)
        best = scores.max(axis=1)
    good = np.isfinite(corners).all(axis=1) & np.isfinite(best) & np.isfinite(numbers)
    good &= (corners[:, 2] > corners[:, 0]) & (corners[:, 3] > corners[:, 1])
    good[good] &= (numbers[good] >= 0) & (numbers[good] < classes)
    return Boxes(corners[good], best[good], numbers[good].astype(np.int64))


def probabilities(rows: Floats32, layout: Layout, classes: int) -> Floats32:
    """The columns that should be in [0, 1]."""
    if layout.kind == "ended":
        return rows[:, 4:5]
    return rows[:, 4 : 4 + classes + (layout.kind == "objectness")]


def check_probabilities(rows: Floats32, layout: Layout, classes: int, where: str) -> None:
    """Check that scores are probabilities.

    Raises:
        InputError: if they are not.
    """
    found = probabilities(rows, layout, classes)
    known = found[np.isfinite(found)]
    if found.size and not known.size:
        raise InputError(where, "its scores are no numbers", "export it with 32 bits")
    if known.size and not -_TOLERANCE <= known.min() <= known.max() <= 1 + _TOLERANCE:
        low, high = known.min(), known.max()
        right = "export it with its sigmoid, so that they are probabilities"
        raise InputError(where, f"its scores go from {low:.3g} to {high:.3g}", right)
