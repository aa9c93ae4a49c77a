"""Text from outside, made fit to be written down, and fit to be shown; and counts in words."""

import re
import unicodedata

LONGEST = 1000
"""Characters of the longest command or answer that is read."""

_KEYS = re.compile(r"\x1b(?:\[[0-?]*[ -/]*[@-~]|O[A-DFHP-S])")
"""What a terminal sends for a key that is no letter, and would obey if it were printed."""

_HIDDEN = frozenset({"Cc", "Cf", "Cs", "Co", "Cn", "Zl", "Zp"})
"""Unicode categories of what is not seen: controls, marks of direction, line separators, ..."""
_BREAKS = frozenset({"Cc", "Zl", "Zp"})


def writable(text: str) -> str:
    """The text with whole characters only: every log is UTF-8, which has no halves.

    A byte that is no UTF-8, or half of a surrogate pair (JSON may spell one), becomes U+FFFD; two
    halves that came one after the other become the character that they are.
    """
    return text.encode("utf-16", "surrogatepass").decode("utf-16", "replace")


def one_line(text: str) -> str:
    """What was said, as one line of what can be seen: no controls, no marks of direction."""
    apart = "".join(" " if unicodedata.category(c) in _BREAKS else c for c in _KEYS.sub("", text))
    return " ".join("".join(c for c in apart if not _is_hidden(c)).split())


def too_long(words: str) -> str:
    """Why words are not read, as a clause; empty if they are."""
    begin = unicodedata.normalize("NFKC", words[: LONGEST + 1])  # some letters stand for 18
    long = len(begin) > LONGEST
    return f"what you said is too long, I read at most {LONGEST:,} characters" * long


def counted(number: int, noun: str) -> str:
    """So many of them: `1 call`, `2 calls`."""
    return f"{number} {noun}" if number == 1 else f"{number} {noun}s"


def printable(text: object) -> str:
    r"""The text on one line, as a terminal may have it.

    What a terminal would obey, or what nobody sees (control characters, marks of direction, line
    breaks), is spelled out as Python does: `\x1b`, `\n`, `\u202e`.
    """
    shown = str(text)
    if shown.isprintable():
        return shown
    return "".join(_spelled(c) if _is_hidden(c) else c for c in shown)


def _is_hidden(character: str) -> bool:
    return not character.isprintable() and unicodedata.category(character) in _HIDDEN


def _spelled(character: str) -> str:
    return character.encode("unicode_escape").decode("ascii")
