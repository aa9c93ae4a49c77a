"""Metrics of a detector: average precision, recall and confusion matrix, from arrays of boxes.

Boxes are (n, 4): left, top, right, bottom. Objects that do not count (too small, or too much
occluded) may be found or missed: neither is right or wrong.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from executive.geometry import Floats

Ints = NDArray[np.int64]
ENOUGH = 0.5
"""Boxes with at least this overlap (IoU) match."""


@dataclass(frozen=True, slots=True, eq=False)
class Judged:
    """The detections in a picture, and the truth.

    Attributes:
        boxes: (n, 4) of detections.
        scores: (n,) their confidences, in [0, 1].
        classes: (n,) their classes.
        true_boxes: (m, 4) of objects.
        true_classes: (m,) their classes.
        counts: (m,) bool, whether each object counts.
    """

    boxes: Floats
    scores: Floats
    classes: Ints
    true_boxes: Floats
    true_classes: Ints
    counts: NDArray[np.bool_]


def overlaps(one: Floats, other: Floats) -> Floats:
    """Intersection over union of each of (n, 4) with each of (m, 4): (n, m)."""
    low = np.maximum(one[:, None, :2], other[None, :, :2])
    high = np.minimum(one[:, None, 2:], other[None, :, 2:])
    common = np.clip(high - low, 0, None).prod(axis=-1)
    areas = (one[:, 2:] - one[:, :2]).prod(axis=1)
    other_areas = (other[:, 2:] - other[:, :2]).prod(axis=1)
    both = areas[:, None] + other_areas[None] - common
    return np.asarray(common / np.maximum(both, 1e-9))


def match(picture: Judged) -> Ints:
    """(n,) for each detection, the index of the matching object of its class, or -1.

    Detections are matched in order of falling confidence, each to the free object that it overlaps
    most; an object matches at most one detection.
    """
    found = np.full(len(picture.boxes), -1, np.int64)
    same = picture.classes[:, None] == picture.true_classes[None]
    shared = np.where(same, overlaps(picture.boxes, picture.true_boxes), 0.0)
    for index in np.argsort(-picture.scores, kind="stable"):
        if shared.shape[1] and shared[index].max() >= ENOUGH:
            found[index] = shared[index].argmax()
            shared[:, found[index]] = 0.0
    return found


def average_precision(right: NDArray[np.bool_], asked: int) -> float:
    """Area under the precision-recall curve, with interpolated precision.

    Interpolated precision is the best at the same or any higher recall.

    Args:
        right: whether each detection is right, in order of falling confidence.
        asked: number of objects to be found; the result is nan if there are none.
    """
    if not asked:
        return float("nan")
    hits = np.cumsum(right)
    precision = hits / np.arange(1, len(right) + 1)
    best = np.maximum.accumulate(precision[::-1])[::-1]
    return float((best * right).sum() / asked)


@dataclass(frozen=True, slots=True)
class ClassReport:
    """The metrics of one class; recall and precision are at a least confidence.

    `asked` is the number of objects of the class that count.
    """

    asked: int
    average_precision: float
    recall: float
    precision: float


def by_class(pictures: Sequence[Judged], classes: int, least: float) -> list[ClassReport]:
    """The metrics of each class; `least` is the least confidence for recall and precision."""
    matches = [match(picture) for picture in pictures]
    return [_report(pictures, matches, number, least) for number in range(classes)]


def _report(
    pictures: Sequence[Judged], matches: Sequence[Ints], number: int, least: float
) -> ClassReport:
    scores, right = [], []
    asked = 0
    for picture, found in zip(pictures, matches, strict=True):
        asked += int((picture.counts & (picture.true_classes == number)).sum())
        for index in np.flatnonzero(picture.classes == number):
            if found[index] < 0 or picture.counts[found[index]]:
                scores.append(float(picture.scores[index]))
                right.append(bool(found[index] >= 0))
    order = np.argsort(-np.array(scores), kind="stable")
    hits = np.array(right, np.bool_)[order]
    sure = hits[np.array(scores)[order] >= least]
    return ClassReport(
        asked,
        average_precision(hits, asked),
        float(sure.sum() / asked) if asked else float("nan"),
        float(sure.mean()) if len(sure) else float("nan"),
    )


def confusion(pictures: Sequence[Judged], classes: int, least: float) -> Ints:
    """The confusion matrix (classes + 1, classes + 1): counts by true class and predicted class.

    Boxes are matched regardless of class, in order of falling confidence. The last row counts
    detections without an object, the last column objects without a detection.
    """
    table = np.zeros((classes + 1, classes + 1), np.int64)
    for picture in pictures:
        order = np.argsort(-picture.scores, kind="stable")
        sure = order[picture.scores[order] >= least]
        shared = overlaps(picture.boxes[sure], picture.true_boxes)
        free = np.ones(len(picture.true_boxes), np.bool_)
        for row, found in zip(shared, picture.classes[sure], strict=True):
            offered = np.where(free, row, 0.0)
            if len(row) and offered.max() >= ENOUGH:
                thing = int(offered.argmax())
                free[thing] = False
                if picture.counts[thing]:
                    table[picture.true_classes[thing], found] += 1
            elif not len(row) or row.max() < ENOUGH:
                table[classes, found] += 1
        for missed in picture.true_classes[free & picture.counts]:
            table[missed, classes] += 1
    return table
