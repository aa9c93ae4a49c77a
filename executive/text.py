"""Text from outside, made fit to be written down, and fit to be shown."""

import unicodedata

_HIDDEN = frozenset({"Cc", "Cf", "Cs", "Co", "Cn", "Zl", "Zp"})
"""Unicode categories of what is not seen: controls, marks of direction, line separators, ..."""


def writable(text: str) -> str:
    """The text with whole characters only: every log is UTF-8, which has no halves.

    A byte that is no UTF-8, or half of a surrogate pair (JSON may spell one), becomes U+FFFD; two
    halves that came one after the other become the character that they are.
    """
    return text.encode("utf-16", "surrogatepass").decode("utf-16", "replace")


def printable(text: object) -> str:
    r"""The text on one line, as a terminal may have it.

    What a terminal would obey, or what nobody sees (control characters, marks of direction, line
    breaks), is spelled out as Python does: `\x1b`, `\n`, `\u202e`.
    """
    return "".join(_spelled(c) if _is_hidden(c) else c for c in str(text))


def _is_hidden(character: str) -> bool:
    return not character.isprintable() and unicodedata.category(character) in _HIDDEN


def _spelled(character: str) -> str:
    return character.encode("unicode_escape").decode("ascii")
