"""What is known of other things says where a new one may be."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from kb.llm.precedents import LEAST, log_expected, shares, usual

SHELF, FRIDGE, SOFA = range(3)
FOOD, TOOL = np.eye(8)[0], np.eye(8)[1]


def expected(asked, known, places, kinds=None):
    """Probabilities of shelf, fridge and sofa."""
    at = shares(places, ("shelf", "fridge", "sofa"))
    states = np.array([asked, *known], dtype=float)
    return np.exp(log_expected(states, kinds or [""] * len(states), at))


def test_a_thing_is_expected_where_things_like_it_are():
    places = [["fridge"]] * 10 + [["shelf"]] * 10
    known = [FOOD] * 10 + [TOOL] * 10
    assert expected(FOOD, known, places).argmax() == FRIDGE
    assert expected(TOOL, known, places).argmax() == SHELF


def test_a_thing_like_nothing_that_is_known_is_expected_where_most_things_are():
    known = [FOOD, FOOD, FOOD, TOOL]
    places = [["fridge"], ["fridge"], ["fridge"], ["shelf"]]
    middle = np.mean(known, axis=0)
    at = shares(places, ("shelf", "fridge", "sofa"))
    assert expected(middle, known, places) == pytest.approx(usual(at))


def test_one_thing_that_is_known_decides_little():
    probabilities = expected(FOOD, [FOOD], [["fridge"]])
    assert probabilities[FRIDGE] < 2 * probabilities[SOFA]


def test_things_of_the_same_class_are_more_alike():
    known, places = [FOOD, TOOL], [["fridge"], ["shelf"]]
    neither = np.eye(8)[5]
    of_no_class = expected(neither, known, places)
    of_a_class = expected(neither, known, places, ["food", "food", "tool"])
    assert of_no_class[FRIDGE] == pytest.approx(of_no_class[SHELF])
    assert of_a_class[FRIDGE] > 1.2 * of_a_class[SHELF]


def test_a_thing_with_two_places_is_half_at_each():
    assert shares([["sofa", "shelf"], ["cellar"]], ("shelf", "fridge", "sofa")).tolist() == [
        [0.5, 0.0, 0.5],
        [0.0, 0.0, 0.0],
    ]


states = arrays(float, (4, 3), elements=st.floats(-1e6, 1e6))


@given(states)
def test_no_place_is_ever_ruled_out_or_beyond_all_others(vectors):
    at = shares([["shelf"], ["fridge"], ["shelf", "sofa"]], ("shelf", "fridge", "sofa"))
    found = log_expected(vectors, ["a", "", "b", "a"], at)
    assert np.isfinite(found).all()
    assert (found >= np.log(LEAST)).all()
