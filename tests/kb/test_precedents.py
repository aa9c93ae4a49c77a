"""What is known of other things says where a new one may be."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from kb.llm.precedents import LEAST, TEMPERATURES, likelihood_weight, log_expected, shares

SHELF, FRIDGE, SOFA = range(3)
FOOD, TOOL = np.eye(8)[0], np.eye(8)[1]


def expected(asked, known, places, kinds=None, alike=()):
    """Probabilities of shelf, fridge and sofa."""
    at = shares(places, ("shelf", "fridge", "sofa"))
    states = np.array([asked, *known], dtype=float)
    likely = np.exp(log_expected(states, kinds or [""] * len(states), at, alike))
    return likely / likely.sum()


def test_a_thing_is_expected_where_things_like_it_are():
    places = [["fridge"]] * 10 + [["shelf"]] * 10
    known = [FOOD] * 10 + [TOOL] * 10
    assert expected(FOOD, known, places).argmax() == FRIDGE
    assert expected(TOOL, known, places).argmax() == SHELF


def test_a_thing_like_nothing_that_is_known_is_expected_where_most_things_are():
    known = [FOOD, FOOD, FOOD, TOOL]
    places = [["fridge"], ["fridge"], ["fridge"], ["shelf"]]
    probabilities = expected(np.mean(known, axis=0), known, places)
    assert probabilities.argmax() == FRIDGE
    assert probabilities.min() > 0.1


def test_one_thing_that_is_known_decides_little():
    probabilities = expected(FOOD, [FOOD], [["fridge"]])
    assert probabilities[FRIDGE] < 3 * probabilities[SOFA]


def test_things_of_the_same_class_are_more_alike():
    known, places = [FOOD] * 12 + [TOOL] * 12, [["fridge"]] * 12 + [["shelf"]] * 12
    neither, kinds = np.eye(8)[5], ["food"] * 12 + ["tool"] * 12
    of_no_class = expected(neither, known, places)
    of_a_class = expected(neither, known, places, ["food", *kinds])
    assert of_no_class[FRIDGE] == pytest.approx(of_no_class[SHELF])
    assert of_a_class[FRIDGE] > 1.2 * of_a_class[SHELF]


def test_a_thing_with_two_places_is_half_at_each():
    assert shares([["sofa", "shelf"], ["cellar"]], ("shelf", "fridge", "sofa")).tolist() == [
        [0.5, 0.0, 0.5],
        [0.0, 0.0, 0.0],
    ]


def test_where_things_were_seen_only_once_like_places_are_expected_too():
    known, places = [FOOD, FOOD, TOOL, TOOL], [["shelf"], ["shelf"], ["sofa"], ["sofa"]]
    kinds = [("Shelf", "kitchen"), ("Shelf", "lobby"), ("Sofa", "lobby")]
    apart, alike = (expected(FOOD, known, places, None, given) for given in ((), kinds))
    assert alike[FRIDGE] > 1.2 * apart[FRIDGE]  # here it is a shelf, too


def test_what_is_known_of_like_things_may_be_noise():
    chance = np.random.default_rng(0)
    known = chance.normal(size=(30, 8))
    places = [[("shelf", "fridge", "sofa")[i]] for i in chance.integers(0, 3, 30)]
    probabilities = expected(known[0], known, places)
    assert probabilities.max() < 0.6


def test_where_like_things_are_always_together_the_answer_is_sure():
    known = [FOOD] * 20 + [TOOL] * 20
    places = [["fridge"]] * 20 + [["shelf"]] * 20
    assert expected(FOOD, known, places).max() > 0.9


def test_the_more_is_known_the_less_counts_what_the_model_would_say():
    assert likelihood_weight(100) < likelihood_weight(0)


states = arrays(float, (4, 3), elements=st.floats(-1e6, 1e6))


@given(states)
def test_no_place_is_ever_ruled_out_or_beyond_all_others(vectors):
    at = shares([["shelf"], ["fridge"], ["shelf", "sofa"]], ("shelf", "fridge", "sofa"))
    found = log_expected(vectors, ["a", "", "b", "a"], at)
    assert np.isfinite(found).all()
    assert np.ptp(found) <= -np.log(LEAST) / TEMPERATURES.min()
