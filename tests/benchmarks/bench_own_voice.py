"""What the ears and the spotter make of the robot's own voice, and of who speaks over it.

python tests/benchmarks/bench_own_voice.py          # the robot alone
python tests/benchmarks/bench_own_voice.py --over   # a person who speaks over its words
"""

import argparse
import random
import sys
from collections import Counter
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from executive.speech.doubt import is_own
from executive.speech.interrupting import Interrupting
from executive.speech.microphone import from_files
from executive.speech.sound import Sound
from executive.speech.sphinx import PocketsphinxEars
from executive.speech.spotting import StopSpotter

sys.path.insert(0, str(Path(__file__).parents[1] / "helpers"))

from speaking import VOICES, four_rooms, say

OWN_VOICE = "en"
"""The one of espeak-ng's that speaks if none is named."""
OWN = [
    "What can I do for you?",
    "Here is the mug from the coffee table.",
    "I come back.",
    "I do not know where the apple was; it belongs on the high table or the dining table.",
    "I have seen it, and come back.",
    "I have the mug, and bring it.",
    "I know no elephant. Which thing do you mean?",
    "I look for the apple on the dining table, then the high table: it is usually there.",
    "I look for the hammer on the shelf in the lobby: that is its place.",
    "I look for the scissors on the desk: I remember them there.",
    "I look on the desk.",
    "I put the scissors on the sideboard.",
    "I see the scissors on the desk.",
    "I take the scissors to the sideboard.",
    "Sorry: I know no elephant, and you could not tell me.",
    "The apple is on the dining table in the living room already.",
    "The pear is on the high table in the kitchen.",
    "I did not find the power drill on the shelf. Where is the power drill?",
    "Which fruit do you mean: apple, banana, orange, peach, pear or strawberry?",
    "Did you say: bring the tennis ball?",
    "Did you say: put the mug on the desk?",
    "Please say yes or no: find the pitcher?",
    "I did not understand you. Please say it again.",
    "Halting. What you said before is forgotten.",
    "There is nothing to halt: I am at rest.",
]


def own_words() -> Counter[str]:
    """What the ears and the spotter make of the robot's own voice, which the microphone hears."""
    ears, counts = PocketsphinxEars(four_rooms()), Counter[str]()
    for words in OWN:
        sound, spotter = say(words, OWN_VOICE), StopSpotter()
        if any([spotter.hears_stop(sound[at : at + 1600]) for at in range(0, len(sound), 1600)]):
            counts["a stop, spotted"] += 1
            print(f"a stop, spotted: {words}", flush=True)
        heard = ears.hear(sound).text
        verdict = (
            "its own" if heard and is_own(heard, words) else "asked back" if heard else "nothing"
        )
        counts[verdict] += 1
        print(f"{verdict}: {words} | {heard}", flush=True)
    return counts


def over() -> Counter[str]:
    """A person who speaks over the robot's words: is a stop spotted, and does it fall silent?"""
    counts, chance = Counter[str](), random.Random(1)
    own = [say(words, OWN_VOICE).astype(float) for words in OWN]
    for at, sound in enumerate(own):
        before = own[:at] or own[-2:]
        for words in ("stop", "bring me the mug from the kitchen"):
            person = say(words, chance.choice(VOICES)).astype(float)
            start = chance.randrange(max(1, len(sound) - len(person)))
            for louder in (0, 1, 2, 4):
                mixed = np.zeros(max(len(sound), start + len(person)))
                mixed[: len(sound)] += sound
                mixed[start : start + len(person)] += louder * person
                heard = blocks_of(mixed / 5)  # none of them is clipped
                spotter = StopSpotter()
                case = f"'{words}', {louder} times as loud"
                counts[f"{case}: spotted"] += any([spotter.hears_stop(one) for one in heard])
                counts[f"{case}: silent"] += gives_way(before, heard)
                print(f"{at + 1} of {len(own)}: {case}", flush=True)
    return counts


def gives_way(before: Sequence[NDArray[np.float64]], heard: Sequence[Sound]) -> bool:
    """Whether the robot, which has said something before, falls silent."""
    interrupting = Interrupting()
    said = [block for sound in before for block in blocks_of(sound / 5)]
    found = [
        interrupting.add(float(np.sqrt(np.mean(block.astype(float) ** 2))), 0.1, speaking=True)
        for block in (*said, *heard)
    ]
    return any(found[len(said) :])


def blocks_of(sound: NDArray[np.float64]) -> list[Sound]:
    """As the microphone gives it."""
    return list(from_files([sound.astype(np.int16)], wait=lambda seconds: None))


def main() -> None:
    """Print the counts, of 25 each."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--over", action="store_true")
    counts = over() if parser.parse_args().over else own_words()
    for verdict, count in sorted(counts.items()):
        print(f"{count:5}  {verdict}")


if __name__ == "__main__":
    main()
