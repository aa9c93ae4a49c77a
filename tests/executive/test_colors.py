"""Colours have the names that people give them."""

import pytest

from executive.colors import COLORS, color_name


@pytest.mark.parametrize(
    ("shown", "name"),
    [
        ("ff0000", "red"),
        ("ffa500", "orange"),
        ("ffff00", "yellow"),
        ("00ff00", "green"),
        ("336699", "blue"),
        ("800080", "purple"),
        ("ffc0cb", "pink"),
        ("8b4513", "brown"),
        ("000000", "black"),
        ("808080", "grey"),
        ("ffffff", "white"),
    ],
)
def test_a_color_has_the_name_of_the_nearest(shown: str, name: str) -> None:
    assert color_name(*(channel / 255 for channel in bytes.fromhex(shown))) == name
    assert name in COLORS
