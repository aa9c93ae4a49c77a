"""What is said of things and places is said in words."""

import pytest

from executive.language.wording import Wording, as_said
from executive.testing.bench import ontology
from executive.types.home import DELIVERY, SOMETHING, Called, Place
from kb.ontology.ontology import Ontology
from kb.ontology.speaking import places_called, thing_called

say = Wording(ontology(True).called)


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("sugar_box", "the sugar box"),
        ("high_table", "the high table"),
        ("cabinet_kitchen", "the cabinet in the kitchen"),
        ("bookshelf_bedroom", "the bookshelf in the bedroom"),
        ("shelf_lobby", "the shelf in the lobby"),
        ("fruit", "fruit"),
        (DELIVERY, "the delivery table"),
        (SOMETHING, "something"),
        ("of_nobody", "the of nobody"),
    ],
)
def test_names_are_said_in_words(name: str, words: str) -> None:
    assert say.the(name) == words


def test_a_label_is_what_is_said_without_an_article() -> None:
    assert say.label("cabinet_kitchen") == "cabinet in the kitchen"
    assert say.label("high_table") == "high table"


def test_the_room_is_said_where_it_helps_and_never_twice() -> None:
    assert say.at("counter_wagon") == "on the counter wagon"
    assert say.at_in_full("counter_wagon") == "on the counter wagon in the kitchen"
    assert say.at_in_full("cabinet_kitchen") == "in the cabinet in the kitchen"
    assert say.at_in_full(DELIVERY) == "on the delivery table"


def test_words_agree_with_what_is_plural() -> None:
    assert say.are("scissors") == "the scissors are"
    assert (say.are("mug"), say.it("mug"), say.it("scissors")) == ("the mug is", "it", "them")


def test_of_several_places_the_preposition_is_said_when_it_changes() -> None:
    places = ("sofa", "bed", "refrigerator")
    assert say.at_each(places) == ["on the sofa", "the bed", "in the refrigerator"]


def place(name: str, room: str, room_kind: str = "Bedroom") -> Place:
    return Place(name, "Desk", room, room_kind)


def test_places_that_share_a_name_are_told_apart_by_the_room() -> None:
    called = places_called([place("desk", "bedroom"), place("desk_study", "study", "Office")])
    both = Wording(called.get)
    assert both.the("desk") == "the desk in the bedroom"
    assert both.the("desk_study") == "the desk in the study"


@pytest.mark.parametrize(
    ("name", "room", "words"),
    [
        ("bathroom_cabinet", "bathroom", "on the bathroom cabinet"),
        ("nightstand_bedroom_2", "bedroom", "on nightstand 2 in the bedroom"),
        ("dining_table_dining_room", "dining_room", "on the dining table in the dining room"),
        ("kitchen_table_kitchen", "kitchen", "on the kitchen table"),
        ("bed_1", "bedroom_1", "on the bed in bedroom 1"),
        ("anna's_desk", "bedroom", "on anna's desk in the bedroom"),
    ],
)
def test_odd_names_of_furniture_make_sentences(name: str, room: str, words: str) -> None:
    assert Wording(places_called([place(name, room)]).get).at_in_full(name) == words


@pytest.mark.parametrize(
    ("label", "words"),
    [
        ("the wobbly table", "on the wobbly table in the attic"),
        ("My desk", "on My desk in the attic"),
        ("theatre chest", "on the theatre chest in the attic"),
    ],
)
def test_a_label_that_has_an_article_is_given_no_other(label: str, words: str) -> None:
    home = [Place("desk_1", "Desk", "room_2", "Bedroom", label, "the attic")]
    assert Wording(places_called(home).get).at_in_full("desk_1") == words


@pytest.mark.parametrize(
    ("label", "words"),
    [("TV remote", "TV remote"), ("Tennis Ball", "tennis ball"), ("LivingRoom", "living room")],
)
def test_a_label_is_said_as_one_writes_words(label: str, words: str) -> None:
    assert thing_called(label) == Called(words)


def test_what_is_said_of_a_place_is_understood_as_that_place() -> None:
    places = [
        *ontology(True).places(),
        *(place("desk_office", "office", "Office"), place("shelf_2_bedroom", "bedroom")),
    ]
    known = Ontology(places)
    words = Wording(known.called)
    for one in places:
        assert known.places_named(words.the(one.name)) == (one.name,)
        assert known.places_named(words.at_in_full(one.name)) == (one.name,)


def test_a_home_may_give_labels_which_are_understood_too() -> None:
    labelled = Place("desk_1", "Desk", "room_2", "Bedroom", "Anna's desk", "Anna's room")
    known = Ontology([labelled, place("desk_2", "bedroom")])
    words = Wording(known.called)
    assert words.at_in_full("desk_1") == "on Anna's desk in Anna's room"
    assert known.places_named("on Anna's desk in Anna's room") == ("desk_1",)
    assert known.places_named("in Anna's room") == ("desk_1",)
    assert known.places_named("the desk_1") == ("desk_1",)


def test_what_is_said_of_a_thing_is_understood_as_that_thing() -> None:
    for name in ontology(True).objects():
        assert ontology(True).objects_named(say.the(name)) == (name,)


def test_reasons_of_those_who_only_know_names_are_put_in_words() -> None:
    reason = "there is no free spot on the cabinet_kitchen for the sugar_box, says my_driver"
    told = "there is no free spot on the cabinet in the kitchen for the sugar box, says my_driver"
    assert say.in_words(reason) == told
    assert say.in_words("no room on the delivery") == "no room on the delivery table"


@pytest.mark.parametrize(
    ("text", "read", "said"),
    [
        ("Bring it to Anna, please", "anna", "Anna"),
        ("Put the mug UNDER the desk", "under desk", "UNDER the desk"),
        ("Put it on Anna's desk", "anna's desk", "Anna's desk"),
        ("Take a sugar_box", "sugar box", "sugar_box"),
        ("Find it", "hammer", "hammer"),
        ("", "", ""),
    ],
)
def test_what_a_person_said_is_quoted_as_they_said_it(text: str, read: str, said: str) -> None:
    assert as_said(text, read) == said
