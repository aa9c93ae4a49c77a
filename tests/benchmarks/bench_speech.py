"""What pocketsphinx makes of commands that espeak-ng speaks: what is asked back, and how rightly.

python tests/benchmarks/bench_speech.py                    # 70 commands in three voices
python tests/benchmarks/bench_speech.py --part dev         # those that SURE was chosen by
python tests/benchmarks/bench_speech.py --part answers     # how certain a yes or a no is
python tests/benchmarks/bench_speech.py --part stops       # how well a stop is spotted
python tests/benchmarks/bench_speech.py --part dialogue --number 200 --keep FILE.jsonl
                                                           # asked back, answered yes or no, done

What is in FILE.jsonl already is not spoken again.
"""

import argparse
import json
import random
import sys
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "helpers"))

from dialogue import Spoken, Told
from speaking import VOICES, four_rooms, say

from executive.language.control import control
from executive.language.grammar import EnglishInterpreter
from executive.speech.jsgf import LITTLE
from executive.speech.sound import Sound
from executive.speech.sphinx import PocketsphinxEars
from executive.speech.spotting import StopSpotter

THINGS = [
    "apple",
    "banana",
    "orange",
    "peach",
    "pear",
    "strawberry",
    "cracker box",
    "sugar box",
    "pudding box",
    "mustard bottle",
    "tomato soup can",
    "potted meat can",
    "mug",
    "pitcher",
    "spatula",
    "bleach cleanser",
    "hammer",
    "power drill",
    "adjustable wrench",
    "scissors",
    "tennis ball",
    "wood blocks",
]
PLACES = [
    "kitchen",
    "living room",
    "bedroom",
    "lobby",
    "high table",
    "refrigerator",
    "dining table",
    "coffee table",
    "sofa",
    "bed",
    "desk",
    "sideboard",
]
DEV = [
    "bring me the {t}",
    "fetch the {t} from the {p}",
    "find the {t}",
    "where is the {t}",
    "pick up the {t}",
    "put the {t} on the {p}",
    "get me a {t}",
    "is the {t} on the {p}",
    "what is on the {p}",
    "do not touch the {t}",
    "don't take the {t}",
    "bring the {t} and the {u}",
    "put it on the {p}",
    "throw the {t}",
    "bring the umbrella",
    "find my keys",
    "never bring the {t}",
    "please put the {t} back",
    "open the window",
    "clear the {p}",
    "nobody should take the {t}",
    "go to the {p}",
]
TEST = [
    "bring the {t}",
    "bring me the {t} please",
    "could you fetch the {t}",
    "bring me the {t} from the {p}",
    "find the {t} in the {p}",
    "look for the {t}",
    "take the {t}",
    "grab the {t} from the {p}",
    "take the {t} to the {p}",
    "put the {t} back",
    "do not bring the {t}",
    "don't find the {t}",
    "leave the {t} alone",
    "bring a {t}",
    "get the {t} out of the {p}",
    "bring the telephone",
    "find the elephant",
    "take the newspaper to the {p}",
    "i would rather not have the {t}",
    "bring everything but the {t}",
    "turn on the light",
    "place the {t} on the {p}",
    "find the {t} and the {u}",
    "show me the {t}",
    "please find the {t}",
    "stop",
]
ANSWERS = ("yes", "no", "yes please", "okay")
PARTS = ("test", "dev", "answers", "stops", "dialogue")
STOPS = [
    "stop",
    "stop it",
    "please stop",
    "robot stop",
    "stop now",
    "no stop",
    "stop stop stop",
    "bring the mug no stop",
]


def sentences(forms: list[str], number: int, seed: int) -> Iterator[str]:
    """So many of these forms, with things and places by chance."""
    chance = random.Random(seed)
    for index in range(number):
        thing, other, place = chance.choice(THINGS), chance.choice(THINGS), chance.choice(PLACES)
        yield forms[index % len(forms)].format(t=thing, u=other, p=place)


def deed(interpreter: EnglishInterpreter, words: str) -> list[tuple[object, ...]]:
    """What the robot would do: deed, thing and places; "a" or "the" does not matter."""
    return [
        (one.kind, one.target, one.source, one.goal, one.exceptions, one.number, one.among)
        for together in interpreter.commands(words)
        for one in together
    ]


def judge(part: str, number: int, voices: Sequence[str]) -> Counter[str]:
    """Speak, hear, and count what came of it."""
    ears, interpreter, counts = PocketsphinxEars(four_rooms()), EnglishInterpreter(), Counter()
    forms, seed = (TEST, 42) if part == "test" else (DEV, 7)
    for words in sentences(forms, number, seed):
        for voice in voices:
            reading = ears.hear(say(words, voice))
            meant, heard = deed(interpreter, words), deed(interpreter, reading.text)
            if reading.sure:
                verdict = "DONE UNASKED" if heard else "TAKEN FOR AN ANSWER"
            elif not reading.text:
                verdict = "asked to repeat"
            else:
                verdict = "asked back rightly" if heard == meant else "asked back wrongly"
            counts[verdict] += 1
            print(
                f"{verdict:18} {reading.confidence:.3f} {voice:9} {words} | {reading.text}",
                flush=True,
            )
    return counts


def means_the_same(interpreter: EnglishInterpreter, one: str, other: str) -> bool:
    """Whether a person takes the one for the other: as deeds, or word for word where it is none."""
    deeds = deed(interpreter, one), deed(interpreter, other)
    if any(deeds):
        return deeds[0] == deeds[1]
    if control(one) or control(other):
        return control(one) == control(other)
    telling = [[word for word in said.split() if word not in LITTLE] for said in (one, other)]
    return telling[0] == telling[1]


def became(interpreter: EnglishInterpreter, words: str, told: Told) -> str:
    """The verdict on one command."""
    if told.done:
        if all(means_the_same(interpreter, words, done) for done in told.done):
            return "done as said" if told.asked else "stopped as said"
        return "STOPPED, NOT SAID" if told.done == ["stop"] else "WRONG DEED"
    if not told.asked:
        return "asked to repeat"
    right = means_the_same(interpreter, words, told.asked[-1])
    return "asked back rightly, the yes not certain" if right else "asked back wrongly, not done"


def answerer(
    interpreter: EnglishInterpreter, meant: str, voice: str, chance: random.Random
) -> Callable[[str], tuple[str, Sound]]:
    """A person who says yes to what they meant, and no to anything else; now faster, now slower."""

    def answer(asked: str) -> tuple[str, Sound]:
        said = "yes" if means_the_same(interpreter, meant, asked) else "no"
        return said, say(said, voice, chance.randrange(130, 200))

    return answer


def dialogue(number: int, voices: Sequence[str], kept: Path) -> Counter[str]:
    """Speak, be asked back, answer in the same voice, and count what was done."""
    ears, interpreter = PocketsphinxEars(four_rooms()), EnglishInterpreter()
    lines = kept.read_text("utf-8").splitlines() if kept.exists() else []
    counts = Counter(json.loads(line)["became"] for line in lines)
    every = [(voice, words) for words in sentences(TEST, number, 42) for voice in voices]
    for at, (voice, words) in enumerate(every):
        if at < len(lines):
            continue
        answer = answerer(interpreter, words, voice, random.Random(at))
        told = Spoken(ears, interpreter).command(say(words, voice), answer)
        verdict = became(interpreter, words, told)
        counts[verdict] += 1
        row = {"voice": voice, "words": words, "became": verdict, **vars(told)}
        with kept.open("a", encoding="utf-8") as file:
            print(json.dumps(row), file=file)
        print(f"{at + 1:4} of {len(every)}  {verdict:20} {voice:9} {words} | {told}", flush=True)
    return counts


def answers() -> Counter[str]:
    """How often a yes or a no is certain, and how often one is taken for the other."""
    ears, interpreter, counts = PocketsphinxEars(four_rooms()), EnglishInterpreter(), Counter()
    for words in ANSWERS:
        for voice in VOICES:
            reading = ears.hear(say(words, voice))
            same = interpreter.agrees(reading.text) == interpreter.agrees(words)
            verdict = "not certain" if not reading.sure else "certain" if same else "WRONG"
            counts[verdict] += 1
            print(f"{verdict:12} {reading.confidence:.3f} {voice:9} {words} | {reading.text}")
    return counts


def stops() -> Counter[str]:
    """How often a stop is spotted, and how often where there is none."""
    counts: Counter[str] = Counter()
    for words in (*STOPS, *sentences(TEST, len(TEST) - 1, 42)):
        for voice in VOICES:
            spotter, sound = StopSpotter(), say(words, voice)
            blocks = [sound[at : at + 1600] for at in range(0, len(sound), 1600)]
            found = any([spotter.hears_stop(block) for block in blocks])
            counts[f"{'stop' if words in STOPS else 'other'}: {'spotted' if found else 'not'}"] += 1
    return counts


def main() -> None:
    """Print the counts."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--part", choices=PARTS, default="test")
    parser.add_argument("--number", type=int, default=70)
    parser.add_argument(
        "--voice", action="append", help="of espeak-ng; repeatable (default: three)"
    )
    parser.add_argument("--keep", type=Path, default=Path("dialogue.jsonl"))
    options = parser.parse_args()
    match options.part:
        case "stops":
            counts = stops()
        case "answers":
            counts = answers()
        case "dialogue":
            counts = dialogue(options.number, options.voice or VOICES, options.keep)
        case part:
            counts = judge(part, options.number, options.voice or VOICES)
    for verdict, count in sorted(counts.items()):
        print(f"{count:5} {count / counts.total():6.1%}  {verdict}")


if __name__ == "__main__":
    main()
