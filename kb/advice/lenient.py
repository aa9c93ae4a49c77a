r"""JSON as language models write it, read in one pass.

Beside JSON itself: text around it, code fences, trailing commas, comments, single and typographic
quotes, names without quotes, tuples, and escapes that JSON does not know (`counter\_wagon`).
Nothing is completed or corrected: a value has to have its closing bracket, and no word is returned
that is not there.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass, field

DEEPEST = 16
"""Brackets in brackets; what lies deeper is no answer."""

_WIDE = {wide: chr(ord(wide) - 0xFEE0) for wide in "｛｝［］（）：，"}
"""Marks as they are written among Chinese and Japanese letters."""
_CLOSES = {"{": "}", "[": "]", "(": ")"}
"""Round ones, as Python has them, count within others only: text is full of them."""
_OPENING = re.compile(r"[{\[｛［]")
_SPACE = re.compile(r"(?:\s+|//[^\n]*|#[^\n]*|/\*[^*]*+\*/|\.{3}|…)+")
_QUOTES = {
    quote[0]: quote[1:]
    for quote in ('""', "''", "``", "“”", "‘’", "«»", "‹›", "„“”", "「」", "＂＂")
}
"""What begins a string, and what may end it."""
_STRING = re.compile(
    "|".join(
        rf"{begins}([^{ends}\\\n]*+(?:\\.[^{ends}\\\n]*+)*+)[{ends}]"
        for begins, ends in _QUOTES.items()
    )
)
_BARE = re.compile(r"-?\w[\w.+-]*")
_ESCAPE = re.compile(r"\\(?:u([0-9a-fA-F]{4})|(.))", re.DOTALL)
_SHORT = {"n": "\n", "t": "\t", "r": "\r", "b": "\b", "f": "\f"}
_WORDS = frozenset(("true", "false", "null", "none", "nan", "infinity", "undefined"))


class Bare(str):
    """A word without quotes."""

    __slots__ = ()


@dataclass(slots=True)
class _Open:
    """A bracket that is not closed yet. `wants` is what has to come next, beside its close."""

    closes_with: str
    wants: str
    value: list[object] | dict[str, object]
    key: str = field(default="")

    def take(self, value: object) -> bool:
        """Take in a value, or a key; False if neither belongs here."""
        if self.wants == "key" and isinstance(value, str):
            self.key, self.wants = value, ":"
            return True
        if self.wants != "value":
            return False
        if isinstance(self.value, dict):
            self.value[self.key] = value
        else:
            self.value.append(value)
        self.wants = ","
        return True

    def passes(self, mark: str) -> bool:
        """Go on after a comma or a colon; False if it does not belong here."""
        if mark != self.wants:
            return False
        self.wants = "key" if mark == "," and isinstance(self.value, dict) else "value"
        return True

    def closes(self, mark: str) -> bool:
        """Whether this bracket ends it here; a comma before it does no harm."""
        unfinished = self.wants == ":" or (self.wants == "value" and self.closes_with == "}")
        return mark == self.closes_with and not unfinished


def values(text: str) -> Iterator[tuple[int, object]]:
    """Every object and list in a text with where it ends, inner ones before outer ones.

    Never raises; takes time in proportion to the text.
    """
    at, stack = 0, list[_Open]()
    unclosed: dict[str, int] = {}
    while True:
        if not stack:
            found = _OPENING.search(text, at)
            if found is None:
                return
            at = found.start()
        elif space := _SPACE.match(text, at):
            at = space.end()
        if at == len(text):
            return
        end = _step(text, at, stack, unclosed)
        if end is None:
            at += not _OPENING.match(text, at)
            continue
        if text[at] in "}])｝］）":
            closed = stack.pop().value
            yield end, closed
            if stack and not stack[-1].take(closed):
                stack.clear()
        at = end


def _step(text: str, at: int, stack: list[_Open], unclosed: dict[str, int]) -> int | None:
    """Take in what is here and return where it ends; None, and an empty stack, if it is amiss."""
    mark = _WIDE.get(text[at], text[at])
    if mark in _CLOSES and len(stack) < DEEPEST and (not stack or stack[-1].wants == "value"):
        stack.append(_Open("}", "key", {}) if mark == "{" else _Open(_CLOSES[mark], "value", []))
        return at + 1
    if mark in ",:":
        fits, end = stack[-1].passes(mark), at + 1
    elif mark in "}])":
        fits, end = stack[-1].closes(mark), at + 1
    else:
        scalar = _scalar(text, at, unclosed)
        fits, end = (stack[-1].take(scalar[0]), scalar[1]) if scalar else (False, at)
    if not fits:
        stack.clear()
    return end if fits else None


def _scalar(text: str, at: int, unclosed: dict[str, int]) -> tuple[object, int] | None:
    """A string, word or number that begins here, and its end.

    `unclosed` is for quotes that nothing closes in their line: where such a line ends. They are not
    looked at again.
    """
    found = _STRING.match(text, at) if at >= unclosed.get(text[at], 0) else None
    if not found and text[at] in _QUOTES:
        end = text.find("\n", at)
        unclosed[text[at]] = end if end >= 0 else len(text)
    if found:
        return _ESCAPE.sub(_escaped, found[found.lastindex or 0]), found.end()
    if found := _BARE.match(text, at):
        word = found[0]
        nothing = word.lower() in _WORDS or not word[0].isalpha()
        return None if nothing else Bare(word), found.end()
    return None


def _escaped(found: re.Match[str]) -> str:
    """What an escape stands for; one that JSON does not know stands for its character."""
    if code := found[1]:
        return chr(int(code, 16))
    return _SHORT.get(found[2], found[2])
