"""A place is known by the preposition before it, whatever else is said."""

import pytest

from executive.language.placed import placed
from executive.testing.bench import ontology


@pytest.mark.parametrize(
    ("words", "places"),
    [
        ("Somebody hid it in the living room from me", ("living room", "")),
        ("I want it from the desk to the sofa", ("desk", "sofa")),
        ("off to the bookshelf in the bedroom with it", ("", "bookshelf in the bedroom")),
        ("I am able to lift it", ("", "")),
        ("The kitchen is big", ("", "")),
        ("in the attic", ("", "")),
        ("", ("", "")),
    ],
)
def test_places_are_found_behind_prepositions(words: str, places: tuple[str, str]) -> None:
    assert placed(words, ontology(True).is_place) == places
