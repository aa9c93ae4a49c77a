"""Cleaning of text from outside, for logs and for terminals; and counts in words."""

import re
import unicodedata

LONGEST = 1000
"""The largest length of a command or an answer, in characters."""

_KEYS = re.compile(r"\x1b(?:\[[0-?]*[ -/]*[@-~]|O[A-DFHP-S])")
"""Escape sequences that a terminal sends for special keys, and would interpret if printed."""

_HIDDEN = frozenset({"Cc", "Cf", "Cs", "Co", "Cn", "Zl", "Zp"})
"""Unicode categories of invisible characters: controls, directional marks, separators, ..."""
_BREAKS = frozenset({"Cc", "Zl", "Zp"})


def writable(text: str) -> str:
    """The text as it can be encoded in UTF-8, as in every log.

    An invalid byte, or an unpaired surrogate (JSON can contain one), becomes U+FFFD; a pair of
    surrogates becomes the character that it encodes.
    """
    return text.encode("utf-16", "surrogatepass").decode("utf-16", "replace")


def one_line(text: str) -> str:
    """The words on one line, without invisible characters."""
    apart = "".join(" " if unicodedata.category(c) in _BREAKS else c for c in _KEYS.sub("", text))
    return " ".join("".join(c for c in apart if not _is_hidden(c)).split())


def too_long(words: str) -> str:
    """Why the words are too long, as a clause; empty if they are not."""
    begin = unicodedata.normalize("NFKC", words[: LONGEST + 1])  # one letter may expand to 18
    long = len(begin) > LONGEST
    return f"what you said is too long, I read at most {LONGEST:,} characters" * long


def counted(number: int, noun: str) -> str:
    """A number with its noun: `1 call`, `2 calls`."""
    return f"{number} {noun}" if number == 1 else f"{number} {noun}s"


def printable(text: object) -> str:
    r"""The text on one line, safe for a terminal.

    Invisible characters (controls, directional marks, line breaks) are escaped as in Python:
    `\x1b`, `\n`, `\u202e`.
    """
    shown = str(text)
    if shown.isprintable():
        return shown
    return "".join(_spelled(c) if _is_hidden(c) else c for c in shown)


def _is_hidden(character: str) -> bool:
    return not character.isprintable() and unicodedata.category(character) in _HIDDEN


def _spelled(character: str) -> str:
    return character.encode("unicode_escape").decode("ascii")
