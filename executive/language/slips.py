"""What was probably meant: a slip in the word for a deed ("bing me an apple"), or none at all."""

import re
from collections.abc import Iterator

from rapidfuzz.distance import OSA

from executive.language.meaning import Answer, Unread
from executive.language.reader import Reader

SHORTEST = 3
LONG = 6
"""From so many letters on, two of them may be wrong."""
_AT_FIRST = re.compile("^(?:(?:(?:and|but) )?first(?: of all)?,? )?")
"""What may come before a deed: "first the mug, then the pear"."""


def without_slips(reader: Reader, words: str) -> Iterator[str]:
    """What was probably meant, if the word at which reading ended, or that before, is a slip."""
    said = reader.read(words)
    spoken = reader.plain(words).split()
    if reader.denial(words) or not spoken:
        return
    if isinstance(said, Unread):
        at = spoken.index(said.at) if said.at in spoken else len(spoken)
        suspects = {max(at - 1, 0), min(at, len(spoken) - 1)}
    elif isinstance(said, Answer) and said.things:
        suspects = {0}
    else:
        return
    for suspect in sorted(suspects):
        if deed := _near(spoken[suspect], reader.deeds):
            yield " ".join([*spoken[:suspect], deed, *spoken[suspect + 1 :]])


def brought(reader: Reader, words: str) -> Iterator[str]:
    """What was probably meant, if things are named and nothing is said of what to do with them."""
    said = reader.read(words)
    names = isinstance(said, Answer) and said.choice is None and said.things
    if names and not reader.denial(words):
        yield _AT_FIRST.sub(r"\g<0>bring ", reader.plain(words), count=1)


def put_there(reader: Reader, words: str) -> Iterator[str]:
    """What was probably meant, if a thing is wished to be somewhere: "I want it on the desk"."""
    if isinstance(reader.read(words), Unread) and (wish := reader.wish.match(reader.plain(words))):
        yield f"put {reader.plain(words)[wish.end() :]}"


def _near(word: str, deeds: tuple[str, ...]) -> str:
    """The deed that a word is a slip of; empty if it is of none, or is one."""
    most = 0 if len(word) < SHORTEST else 1 if len(word) < LONG else 2
    best = min(deeds, key=lambda deed: OSA.distance(word, deed))
    return best if 0 < OSA.distance(word, best) <= most else ""
