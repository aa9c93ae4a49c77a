"""Whether words tell the robot to stop, wherever they come from.

A false stop costs a command that is said again; a missed one costs a vase. So a stop is heard in
every form that it can have, and what is left out are names ("the door stop") and plain commands.
"""

import re
import tomllib
import unicodedata
from enum import StrEnum
from itertools import groupby, takewhile
from pathlib import Path

from executive.language.phrases import ENGLISH
from executive.text import LONGEST, one_line


class Control(StrEnum):
    """What words may be, beside a command and an answer."""

    STOP = "stop"
    """Be at rest at once."""
    QUIT = "quit"
    """The session ends, and with it whatever runs."""


def control(words: str) -> Control | None:
    """What the words tell the robot at once; None if they are a command, an answer, anything else.

    Case, punctuation, accents, full-width letters and politeness do not count. These say stop (the
    words are in assets/control.toml):

    - a line, or a clause, that begins with an order: "halt", "Find the mug, no, wait"; one in a
      script without blanks may stand anywhere;
    - an urgent word anywhere ("I want you to stop"), unless it belongs to a name ("Find the stop
      sign"), is denied ("don't stop") or is asked about ("Why did you stop?"); at the end, and in
      capitals, or said twice, it is none of these;
    - an urgent word with digits for letters ("st0p"), alone with two neighbours swapped or a letter
      left out ("stpo", "canel"), or letter by letter ("S T O P").
    """
    clauses = [_words(clause) for clause in _CLAUSE_ENDS.split(_plain(words))]
    said = [word for clause in clauses for word in clause]
    bare = [word for word in said if word not in _FILLERS]
    if tuple(bare) in _QUITS:
        return Control.QUIT
    slip = len(bare) == 1 and bare[0] in _SLIPS
    run_on = "".join(said).replace("_", "")
    spelled = run_on in _URGENT or any(order in run_on for order in _ANYWHERE)
    shouted = _SHOUTED.search(words[-LONGEST:]) and not words.isupper()
    ordered = any(map(_is_order, (said, *clauses))) or any(map(_is_urgent, clauses))
    return Control.STOP if slip or spelled or shouted or ordered else None


def _plain(words: str) -> str:
    """Lower case, without accents and marks that nobody sees; no more than can be a command."""
    compatible = unicodedata.normalize("NFKC", one_line(words[:LONGEST]))[:LONGEST]
    apart = unicodedata.normalize("NFD", compatible.casefold())
    letters = "".join(c for c in apart if unicodedata.category(c) != "Mn")
    said = _SIGNS.sub(". stop. ", re.sub("[’‘`´ʼ]", "'", letters))
    if not _URGENT.intersection(_WORD.findall(said)):
        said = _INSTEAD.sub("", said)
    return _EAGER.sub(" ", _NO_APOSTROPHE.sub(r"\1'\2", _DISGUISED.sub(_undisguised, said)))


def _undisguised(found: re.Match[str]) -> str:
    """An urgent word in plain letters ("st0p"), anything else as it is."""
    return _SQUEEZED.get(_squeezed(found[0].translate(_LETTERS)), found[0])


def _words(clause: str) -> list[str]:
    """Its words; of urgent ones the plain form ("stoopp", "stopit")."""
    return [part for word in _WORD.findall(clause) for part in _parts(word)]


def _parts(word: str) -> tuple[str, ...]:
    if urgent := _SQUEEZED.get(_squeezed(word)):
        return (urgent,)
    rest = word.removeprefix("stop").strip("_")
    return ("stop", rest) if word.startswith("stop") and rest in _NOTHING_MORE else (word,)


def _squeezed(word: str) -> str:
    """Each letter once where it is repeated."""
    return "".join(letter for letter, _ in groupby(word))


def _is_order(said: list[str]) -> bool:
    """Whether it begins with an order, or is one that must stand alone; fillers may come first."""
    lead = len(list(takewhile(_FILLERS.__contains__, said)))
    starts = [(start, length) for start in range(lead + 1) for length in (1, 2, 3)]
    if any(tuple(said[start : start + length]) in _ORDERS for start, length in starts):
        return True
    return any(
        tuple(said[start : start + length]) in _ALONE
        and all(word in _NOTHING_MORE for word in said[start + length :])
        for start, length in starts
    )


def _is_urgent(clause: list[str]) -> bool:
    """Whether it has an urgent word in it that is no part of a name."""
    first = next((word for word in clause if word not in _FILLERS), "")
    named = first in _BEFORE_NAMES
    if clause and clause[0] in _ASKED:
        return bool(_URGES & set(clause[1:4]) and _URGENT & set(clause))
    return any(
        word in _URGENT and before not in _DENIALS and (not named or before in _TURNS | _URGENT)
        for before, word in zip(["", *clause], clause, strict=False)
    )


_SIGNS = re.compile("[\U0001f6d1\u26d4\U0001f6ab\u270b\U0001f590\u23f9\u23f8]")
"""A stop sign, no entry, a raised hand, the buttons stop and pause."""
_NO_APOSTROPHE = re.compile(r"\b(don|won|can|that|let)(t|s|ll)\b")
_EAGER = re.compile(r"\b(?:can't|cannot|can not|can hardly) wait\b")
"""Who says so does not ask to wait."""
_CLAUSE_ENDS = re.compile(r"[.,;:!?…。、‒–—―−~|()\[\]]|-(?=[-\s])|(?<=\s)[-/>*·•+=&]")
_DISGUISED = re.compile(r"[a-z01345@$]+")
_LETTERS = str.maketrans("01345@$", "oleasas")
_WORD = re.compile(r"[^\W\d_]+(?:['_][^\W\d_]+)*")

_FILE = tomllib.loads((Path(__file__).parent / "assets" / "control.toml").read_text("utf-8"))

_THEN_DO = (
    rf"[,.;:!]? (?=(?:and |so |now |just |please )*(?:{'|'.join(ENGLISH['deeds'].split())})\b)"
)
_INSTEAD = re.compile(
    rf"\b(?:(?:i|have|i've|just) )*changed my mind{_THEN_DO}"
    r"|^\W*(?:(?:no|oh|ok|okay|please|just|and|robot),? )*(?:forget|never mind) (?:about )?"
    rf"(?=(?:the|my|our) (?!(?:{'|'.join(_FILE['all'].split())})\b))"
    rf"|(?:^\W*|[,.;:!?–—-] )(?:forget|never ?mind)(?: (?:about )?(?:it|that))?{_THEN_DO}"
    r"|^\W*i (?:do not|don't|no longer) (?:want|need) (?:it|them|that|this)(?: any ?more| now)?"
    rf"{_THEN_DO}"
)
"""Who says so wants something else, or one thing no more: the rest says what."""


def _phrases(name: str) -> frozenset[tuple[str, ...]]:
    return frozenset(tuple(_WORD.findall(_plain(phrase))) for phrase in _FILE[name])


def _each(name: str) -> frozenset[str]:
    return frozenset(_FILE[name].split())


_URGENT: frozenset[str] = frozenset(_FILE["urgent"])
_SHOUTED = re.compile(rf"\b(?:{'|'.join(_URGENT).upper()})\W*\Z")
_SQUEEZED = {
    _squeezed(word + ending): word
    for word in _URGENT
    for ending in ("", "e", "en", "et", "t", "ing")
}
"""In other languages, too: "stoppe", "halten"."""
_SWAPPED = {
    word[:at] + word[at + 1] + word[at] + word[at + 2 :]
    for word in _URGENT
    for at in range(len(word) - 1)
}
_LEFT_OUT = {
    word[:at] + word[at + 1 :] for word in _URGENT if len(word) > 4 for at in range(len(word))
}
_SLIPS = {"stp"} | _SWAPPED | _LEFT_OUT
_ORDERS, _ALONE, _QUITS = _phrases("orders"), _phrases("alone"), _phrases("quit")
_ANYWHERE = frozenset("".join(phrase) for phrase in _phrases("anywhere"))
_FILLERS = _each("fillers")
_NOTHING_MORE = _FILLERS | _each("after")
_BEFORE_NAMES, _TURNS = _each("before_names"), _each("turns")
_DENIALS, _ASKED, _URGES = _each("denials"), _each("asked"), _each("urges")
