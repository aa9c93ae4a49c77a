"""Figures for detectors: what is perfect scores 1, and what does not count changes nothing."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from sim.learning.metrics import Judged, average_precision, by_class, confusion, match, overlaps

CLASSES = 3
coordinates = st.integers(0, 60)


@st.composite
def boxes(draw: st.DrawFn, most: int = 5) -> np.ndarray:
    corners = draw(st.lists(st.tuples(coordinates, coordinates), max_size=most))
    sides = [draw(st.tuples(st.integers(4, 30), st.integers(4, 30))) for _ in corners]
    return np.array(
        [(x, y, x + w, y + h) for (x, y), (w, h) in zip(corners, sides, strict=True)], np.float64
    ).reshape(-1, 4)


@st.composite
def pictures(draw: st.DrawFn) -> Judged:
    found, true = draw(boxes()), draw(boxes())
    numbers = st.integers(0, CLASSES - 1)
    scores = [draw(st.floats(0.01, 1.0)) for _ in found]
    return Judged(
        found,
        np.array(scores, np.float64),
        np.array([draw(numbers) for _ in found], np.int64),
        true,
        np.array([draw(numbers) for _ in true], np.int64),
        np.array([draw(st.booleans()) for _ in true], np.bool_),
    )


def judged(found: list, true: list, counts: list[bool] | None = None) -> Judged:
    """Found: (box, score, class); true: (box, class)."""
    return Judged(
        np.array([f[0] for f in found], np.float64).reshape(-1, 4),
        np.array([f[1] for f in found], np.float64),
        np.array([f[2] for f in found], np.int64),
        np.array([t[0] for t in true], np.float64).reshape(-1, 4),
        np.array([t[1] for t in true], np.int64),
        np.array(counts if counts is not None else [True] * len(true), np.bool_),
    )


HERE, THERE = (0, 0, 10, 10), (30, 30, 50, 40)


@given(boxes(), boxes())
def test_overlap_is_a_share_and_whole_with_itself(one: np.ndarray, other: np.ndarray) -> None:
    shared = overlaps(one, other)
    assert shared.shape == (len(one), len(other))
    assert ((shared >= 0) & (shared <= 1)).all()
    assert np.diag(overlaps(one, one)) == pytest.approx(1.0)


@given(pictures())
def test_figures_are_shares(picture: Judged) -> None:
    for report in by_class([picture], CLASSES, 0.3):
        for figure in (report.average_precision, report.recall, report.precision):
            assert np.isnan(figure) or 0 <= figure <= 1


@given(st.lists(pictures(), min_size=1, max_size=3))
def test_who_finds_everything_and_nothing_else_is_perfect(drawn: list[Judged]) -> None:
    apart = [
        Judged(
            p.true_boxes + shift,
            np.full(len(p.true_boxes), 0.9),
            p.true_classes,
            p.true_boxes + shift,
            p.true_classes,
            np.ones(len(p.true_boxes), np.bool_),
        )
        for p in drawn
        for shift in [200 * np.arange(len(p.true_boxes))[:, None]]
    ]
    for report in by_class(apart, CLASSES, 0.5):
        if report.asked:
            assert report.average_precision == report.recall == report.precision == 1
    table = confusion(apart, CLASSES, 0.5)
    assert table.sum() == np.trace(table) == sum(len(p.true_boxes) for p in apart)


@given(pictures(), st.floats(0.0, 1.0))
def test_each_thing_that_counts_is_in_the_confusions_once(picture: Judged, least: float) -> None:
    table = confusion([picture], CLASSES, least)
    for number in range(CLASSES):
        asked = (picture.counts & (picture.true_classes == number)).sum()
        assert table[number].sum() == asked


@given(pictures())
def test_each_thing_is_found_once(picture: Judged) -> None:
    found = match(picture)
    taken = found[found >= 0]
    assert len(set(taken.tolist())) == len(taken)
    assert (picture.true_classes[taken] == picture.classes[found >= 0]).all()


def test_what_does_not_count_is_neither_right_nor_wrong() -> None:
    alone = judged([(HERE, 0.9, 0)], [(HERE, 0)])
    beside = judged([(HERE, 0.9, 0), (THERE, 0.95, 0)], [(HERE, 0), (THERE, 0)], [True, False])
    assert by_class([alone], 1, 0.5) == by_class([beside], 1, 0.5)


def test_finding_nothing_or_only_the_wrong_class_is_worth_nothing() -> None:
    wrong = judged([(HERE, 0.9, 1)], [(HERE, 0)])
    report = by_class([wrong], 2, 0.5)[0]
    assert (report.average_precision, report.recall) == (0, 0)
    assert confusion([wrong], 2, 0.5).tolist() == [[0, 1, 0], [0, 0, 0], [0, 0, 0]]


def test_what_is_found_where_nothing_is_costs_precision() -> None:
    ghost = judged([(HERE, 0.9, 0), (THERE, 0.8, 0)], [(HERE, 0)])
    [report] = by_class([ghost], 1, 0.5)
    assert (report.average_precision, report.recall, report.precision) == (1, 1, 0.5)
    assert confusion([ghost], 1, 0.5).tolist() == [[1, 0], [1, 0]]


def test_the_area_is_under_the_best_precision_from_there_on() -> None:
    assert average_precision(np.array([False, True, True]), asked=4) == pytest.approx(2 / 3 * 2 / 4)
    assert np.isnan(average_precision(np.array([], np.bool_), asked=0))
