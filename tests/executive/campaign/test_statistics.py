"""Means, intervals and tests, against what is known."""

import pytest

from executive.campaign.report.cells import interval
from executive.campaign.report.statistics import holm, pairwise, signed_rank, stars, summarize


def test_mean_and_sd_are_of_all_missions() -> None:
    summary = summarize({"a": [1, 2], "b": [3, 6]})
    assert summary
    assert (summary.n, summary.mean) == (4, 3.0)
    assert summary.sd == pytest.approx(2.1602, abs=1e-4)


def test_repetitions_do_not_narrow_the_interval() -> None:
    once = summarize({"a": [0], "b": [1], "c": [4]})
    often = summarize({"a": [0] * 50, "b": [1] * 50, "c": [4] * 50})
    assert once
    assert often
    assert (once.low, once.high) == (often.low, often.high) == (0.0, 4.0)


def test_a_single_command_has_no_interval_however_often_it_is_repeated() -> None:
    one, two = summarize({"a": [1, 2, 6]}), summarize({"a": [1, 2, 6], "b": [9]})
    assert one
    assert two
    assert interval(one, 1) == "-"
    assert interval(two, 1) == "3.0 to 9.0"


def test_no_missions_have_no_summary() -> None:
    assert summarize({}) is None


def test_six_pairs_that_all_differ_alike_have_the_exact_p() -> None:
    assert signed_rank([1, 2, 3, 4, 5, 6]) == pytest.approx(2 / 2**6)


def test_pairs_that_do_not_differ_say_nothing() -> None:
    assert signed_rank([0.0, 0.0]) == 1.0
    assert signed_rank([0, 0, 1, 2, 3, 4, 5, 6]) == pytest.approx(2 / 2**6)


def test_many_ties_are_tested_without_complaint() -> None:
    assert signed_rank([1.0] * 80 + [0.0] * 10) < 1e-6


def test_holm_corrects_step_by_step() -> None:
    assert holm([0.01, 0.04, 0.03]) == pytest.approx([0.03, 0.06, 0.06])


def test_only_units_that_both_have_are_compared() -> None:
    [one] = pairwise({"a": {1: 2.0, 2: 5.0}, "b": {2: 4.0, 3: 9.0}})
    assert (one.pairs, one.difference) == (1, 1.0)


def test_stars_are_as_in_the_papers_figures() -> None:
    assert [stars(p) for p in (0.009, 0.01, 0.049, 0.05)] == ["**", "*", "*", ""]
