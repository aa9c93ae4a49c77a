"""Reads what a person says, by the grammar of a language; see `assets/english.lark`."""

import re
from collections.abc import Iterable
from functools import cached_property
from pathlib import Path

from lark import Lark, UnexpectedInput
from lark.exceptions import VisitError

from executive.language.building import Builder, Unfit
from executive.language.meaning import Relation, Said, Unread
from executive.text import one_line, too_long

ENGLISH = Path(__file__).parent / "assets" / "english.lark"
NO_NAME = r"(?!)x"

SHORT_FORMS = {
    "can't": "can not",
    "cannot": "can not",
    "won't": "will not",
    "shan't": "shall not",
    "what's": "what is",
    "where's": "where is",
    "who's": "who is",
    "there's": "there is",
    "it's": "it is",
    "that's": "that is",
    "how's": "how is",
    "i'm": "i am",
    "i'd": "i would",
    "i've": "i have",
    "let's": "let us",
    "they're": "they are",
    "you're": "you are",
    "gimme": "give me",
}
_SHORT = re.compile(r"\b(?:" + "|".join(map(re.escape, SHORT_FORMS)) + r")(?!\w)")
NUMBERS = dict(
    zip(
        ["two", "three", "four", "five", "six", "seven", "eight", "nine", "ten"],
        range(2, 11),
        strict=True,
    )
) | {
    "first": 1,
    "second": 2,
    "third": 3,
    "fourth": 4,
    "fifth": 5,
    "last": -1,
    "number one": 1,
    "number two": 2,
    "number three": 3,
}
RELATIONS = {
    **dict.fromkeys(("on top of", "on to", "onto", "on", "upon"), Relation.ON),
    **dict.fromkeys(("inside of", "inside", "into", "in", "within"), Relation.IN),
    **dict.fromkeys(("at", "by"), Relation.AT),
    **dict.fromkeys(("next to", "beside", "near", "close to", "around"), Relation.NEXT_TO),
    **dict.fromkeys(("under", "below"), Relation.UNDER),
}


class Reader:
    """Reads English."""

    def __init__(self, names: Iterable[str] = ()) -> None:
        """Know names that have words in them which mean something else: "salt and pepper"."""
        self._names = tuple(sorted({plain(name) for name in names if name.strip()}))

    def read(self, words: str) -> Said:
        """What the words mean; what cannot be read is `Unread`, and says where."""
        if too_long(words):
            return Unread(words)
        text = plain(words)
        try:
            return self._builder.transform(self._parser.parse(text))
        except UnexpectedInput as error:
            at = re.split(r"[ ,]", text[max(error.pos_in_stream or 0, 0) :])[0]
            return Unread(words, at, denies(text))
        except VisitError as error:
            if not isinstance(error.orig_exc, Unfit):
                raise
            return Unread(words, str(error.orig_exc), denies(text))

    @cached_property
    def _parser(self) -> Lark:
        known = "|".join(map(re.escape, sorted(self._names, key=len, reverse=True))) or NO_NAME
        grammar = ENGLISH.read_text("utf-8") + f"\nNAME.5: /(?:{known})(?=[ ,]|$)/\n"
        return Lark(grammar, start="said", parser="lalr", maybe_placeholders=False)

    @cached_property
    def _builder(self) -> Builder:
        return Builder(NUMBERS, RELATIONS)


def plain(words: str) -> str:
    """Lower case, one space between words, no punctuation but the comma, no short forms.

    A full stop between sentences is a comma. What stands in underscores and hyphens is words.
    """
    text = one_line(words).lower().replace("’", "'").replace("_", " ").replace("-", " ")
    text = _SHORT.sub(lambda match: SHORT_FORMS[match[0]], text)
    text = re.sub(r"n't\b", " not", text)
    text = re.sub(r"[.!?;:\"“”]+(?=\s|$)", ",", text)
    text = re.sub(r"(?:\s*,)+\s*", ", ", text)
    return " ".join(text.split()).strip(", ")


def denies(text: str) -> bool:
    """Whether plain words have a negation among them."""
    return re.search(r"\b(?:not|no|never|none|nothing|without|neither|nor)\b", text) is not None
