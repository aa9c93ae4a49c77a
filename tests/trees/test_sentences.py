"""How what the robot says ends."""

import pytest

from trees.telling import sentence


@pytest.mark.parametrize(
    ("said", "whole"),
    [("the lid is shut", "the lid is shut."), ("is it shut?", "is it shut?"), ("no.", "no.")],
)
def test_a_sentence_ends_once(said: str, whole: str) -> None:
    assert sentence(said) == whole
