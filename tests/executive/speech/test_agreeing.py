"""A yes that other ears heard is certain only where the local ones hear it, too."""

import numpy as np
import pytest

from executive.language.grammar import EnglishInterpreter
from executive.speech.agreeing import Agreeing
from executive.speech.interfaces import Reading
from executive.speech.sound import Sound

SOUND = np.zeros(16, dtype=np.int16)
ENGLISH = EnglishInterpreter()


class Hears:
    """Ears that heard this, whatever was said."""

    def __init__(self, text: str, *, sure: bool) -> None:
        self.name, self.asked = text, 0
        self.reading = Reading(text, text, 0.9, sure)

    def hear(self, sound: Sound) -> Reading:
        self.asked += 1
        return self.reading

    def close(self) -> None:
        pass


@pytest.mark.parametrize(
    ("first", "second", "certain", "sure"),
    [
        ("Yes.", "yes", True, True),
        ("No.", "no", True, True),
        ("Yes.", "yes", False, False),
        ("Yes.", "no", True, False),
        ("Yes.", "bring the mug", False, False),
        ("Bring the mug.", "yes", True, False),
    ],
)
def test_both_have_to_hear_the_same_answer(
    first: str, second: str, certain: bool, sure: bool
) -> None:
    ears = Agreeing(Hears(first, sure=True), Hears(second, sure=certain), ENGLISH.agrees)
    reading = ears.hear(SOUND)
    assert (reading.by, reading.text, reading.sure) == (first, first, sure)


def test_the_second_is_asked_about_answers_only() -> None:
    second = Hears("yes", sure=True)
    Agreeing(Hears("Bring the mug.", sure=False), second, ENGLISH.agrees).hear(SOUND)
    assert second.asked == 0
