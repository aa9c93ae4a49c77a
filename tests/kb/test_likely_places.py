"""What default locations say of a home that they were not recorded for."""

from itertools import chain
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from ontologies import OWL

from executive.testing.bench import ontology
from executive.types.home import Place
from kb.ontology.ontology import Ontology
from kb.ontology.usual import standing_for

KINDS = (("Shelf", "Lobby"), ("Table", "Kitchen"), ("Desk", "Bedroom"))
NAMES = ("a", "b", "c", "d", "e")
HOMES = st.dictionaries(st.sampled_from(NAMES), st.sampled_from(KINDS)).map(
    lambda kinds: [Place(name, kind, room, room) for name, (kind, room) in kinds.items()]
)
NAMED = st.dictionaries(st.sampled_from(NAMES), st.sampled_from((*KINDS, None)), max_size=4)


def shelf(name: str, room: str = "lobby", room_kind: str = "Lobby") -> Place:
    return Place(name, "Shelf", room, room_kind)


@given(HOMES, NAMED, st.floats(0, 1))
def test_the_default_locations_stand_for_places_of_the_home_and_never_for_more_than_all(
    home, named, meant
):
    shares = standing_for(named, home, dict.fromkeys(named, meant))
    assert set(shares) <= {place.name for place in home}
    assert sum(shares.values()) <= 1 + 1e-9


@given(st.integers(1, 9), st.floats(0, 1))
def test_among_its_like_a_default_location_gets_what_it_is_meant_and_a_fair_part_of_the_rest(
    count, meant
):
    home = [shelf(f"shelf_{number}") for number in range(count)]
    shares = standing_for({"shelf_0": ("Shelf", "Lobby")}, home, {"shelf_0": meant})
    assert shares["shelf_0"] == pytest.approx(meant + (1 - meant) / count)
    assert sum(shares.values()) == pytest.approx(1)


@pytest.mark.parametrize("thing", ontology(True).objects())
def test_in_the_home_of_the_survey_all_is_said_of_the_names(thing):
    usual = ontology(True).usual_places(thing)
    assert ontology(True).likely_places(thing) == pytest.approx(
        dict.fromkeys(usual, 1 / max(len(usual), 1))
    )


def test_in_another_home_a_name_is_worth_the_share_of_the_names_that_are_here():
    known = Ontology([shelf("shelf_lobby"), shelf("shelf_2_lobby"), shelf("s", "den", "Office")])
    one_of_eight = 1 / 8
    assert known.likely_places("hammer") == pytest.approx(
        {
            "shelf_lobby": one_of_eight + (1 - one_of_eight) / 2,
            "shelf_2_lobby": (1 - one_of_eight) / 2,
        }
    )


def test_what_is_not_here_by_name_is_said_of_its_kind_in_its_kind_of_room():
    known = Ontology([Place("wagon_2", "Wagon", "kitchen", "Kitchen")])
    assert known.usual_places("bleach_cleanser") == ()
    assert known.likely_places("bleach_cleanser") == pytest.approx({"wagon_2": 1 / 2})


def test_a_file_of_ones_own_means_the_home_whose_furniture_it_names(tmp_path: Path):
    content = """<owl:Class rdf:about="http://robot-executive.org/household.owl#ColoredWoodBlocks">
      <household:hasDefaultLocation>
        <household:Shelf rdf:about="http://robot-executive.org/home.owl#shelf_2_lobby"/>
      </household:hasDefaultLocation></owl:Class>"""
    file = tmp_path / "own.owl"
    file.write_text(OWL.format(content))
    known = Ontology([shelf("shelf_lobby"), shelf("shelf_2_lobby")], files=[file])
    assert known.likely_places("colored_wood_blocks") == {"shelf_2_lobby": 1.0}


def test_without_defaults_nothing_is_likely_anywhere():
    known = ontology(False)
    assert not list(chain.from_iterable(map(known.likely_places, known.objects())))
