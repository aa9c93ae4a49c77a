import pytest
from hypothesis import given
from hypothesis import strategies as st

from executive.belief import ANYWHERE, ELSEWHERE, Statement, believe, in_order

HOME = ("desk", "sofa", "cabinet", "shelf")
WEIGHTS = st.lists(
    st.tuples(st.sampled_from(HOME), st.floats(0, 1)), unique_by=lambda pair: pair[0]
).map(tuple)
STATEMENTS = st.lists(
    st.builds(
        Statement,
        st.sampled_from(["memory", "ontology", "llm"]),
        WEIGHTS,
        st.sampled_from([0.3, 0.9, 1.0]),
        st.booleans(),
    ),
    max_size=4,
)
LEFT = st.dictionaries(st.sampled_from(HOME), st.floats(0, 1))


@given(STATEMENTS, LEFT)
def test_whatever_was_said_and_seen_all_sums_to_one(statements, left):
    belief = believe(statements, HOME, left)
    total = sum(likely.probability for likely in belief.places) + belief.elsewhere
    assert total == pytest.approx(1)
    assert {likely.place for likely in belief.places} == set(HOME)


@given(STATEMENTS, LEFT)
def test_the_shares_of_the_sources_are_the_probability(statements, left):
    for likely in believe(statements, HOME, left).places:
        shares = sum(share.probability for share in likely.shares)
        assert shares == pytest.approx(likely.probability)


def test_with_nothing_said_all_places_are_alike():
    belief = believe([], HOME)
    assert [likely.probability for likely in belief.places] == pytest.approx([0.2375] * 4)
    assert belief.elsewhere == pytest.approx(ELSEWHERE)
    assert belief.places[0].source == ANYWHERE


def test_a_source_takes_as_much_as_it_is_trusted_and_leaves_the_rest_to_others():
    memory = Statement("memory", in_order(["desk"]), 0.9)
    ranking = Statement("llm", (("sofa", 3.0), ("desk", 1.0)), 1.0)
    desk = believe([memory, ranking], HOME).of("desk")
    assert {s.source: s.probability for s in desk.shares} == pytest.approx(
        {"memory": 0.9, "llm": 0.1 * 0.95 / 4}
    )
    assert desk.source == "memory"


def test_the_default_locations_are_ordered_by_who_says_something_of_every_place():
    usual = Statement("ontology", (("desk", 1.0), ("sofa", 1.0)), 0.95, orders=False)
    ranking = Statement("llm", (("sofa", 0.3), ("desk", 0.1), ("cabinet", 0.6)), 1.0)
    belief = believe([usual, ranking], HOME)
    assert [likely.place for likely in belief.places[:2]] == ["sofa", "desk"]
    assert belief.places[0].source == "ontology"


def test_weights_that_do_not_order_alone_count_beside_those_of_who_says_something_of_all():
    usual = Statement("ontology", (("desk", 0.75), ("sofa", 0.25)), 0.9, orders=False)
    ranking = Statement("llm", (("sofa", 2.0), ("desk", 1.0)), 1.0)
    belief = believe([usual, ranking], ("desk", "sofa"), elsewhere=0.0)
    assert belief.of("desk").shares[0].probability == pytest.approx(0.9 * 0.75 / (0.75 + 0.5))


def test_a_look_in_vain_leaves_what_the_look_may_have_missed():
    belief = believe([], ("desk", "sofa"), {"desk": 0.02}, elsewhere=0.0)
    assert belief.of("desk").probability == pytest.approx(0.02 / 1.02)
    assert belief.places[0].place == "sofa"


def test_what_everybody_rules_out_is_nowhere():
    belief = believe([], ("desk",), {"desk": 0.0}, elsewhere=0.0)
    assert belief.elsewhere == 1.0
    assert belief.of("desk").probability == 0.0


def test_a_place_that_only_a_source_names_is_a_place():
    memory = Statement("memory", in_order(["delivery"]), 0.9)
    assert believe([memory], HOME).places[0].place == "delivery"


def test_what_a_source_says_of_places_that_do_not_count_is_left_to_others():
    said = Statement("habits", (("desk", 1.0), ("attic", 3.0)), 0.8)
    assert said.of(lambda place: place != "attic") == Statement("habits", (("desk", 1.0),), 0.2)
    assert said.of(lambda place: place == "bed").trust == 0
