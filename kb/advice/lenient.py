r"""Parses JSON as language models write it, in one pass.

In addition to JSON: text around it, code fences, trailing commas, comments, single and typographic
quotes, names without quotes, tuples, and escapes that JSON does not have (`counter\_wagon`).
Nothing is completed or corrected: every value needs its closing bracket, and no word is returned
that is not in the text.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass, field

DEEPEST = 16
"""Maximum nesting; anything deeper is no answer."""

_WIDE = {wide: chr(ord(wide) - 0xFEE0) for wide in "｛｝［］（）：，"}
"""Full-width marks, as in Chinese and Japanese text."""
_CLOSES = {"{": "}", "[": "]", "(": ")"}
"""Round brackets (Python tuples) count only inside others, because they are common in prose."""
_OPENING = re.compile(r"[{\[｛［]")
_SPACE = re.compile(r"(?:\s+|//[^\n]*|#[^\n]*|/\*[^*]*+\*/|\.{3}|…)+")
_QUOTES = {
    quote[0]: quote[1:]
    for quote in ('""', "''", "``", "“”", "‘’", "«»", "‹›", "„“”", "「」", "＂＂")
}
"""Opening quotes, and the quotes that may close them."""
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
    """An open bracket. `wants` is the token that must come next, unless the bracket closes."""

    closes_with: str
    wants: str
    value: list[object] | dict[str, object]
    key: str = field(default="")

    def take(self, value: object) -> bool:
        """Take a value or a key; False if it is not allowed here."""
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
        """Take a comma or a colon; False if it is not allowed here."""
        if mark != self.wants:
            return False
        self.wants = "key" if mark == "," and isinstance(self.value, dict) else "value"
        return True

    def closes(self, mark: str) -> bool:
        """Whether this bracket may close here; a trailing comma is allowed."""
        unfinished = self.wants == ":" or (self.wants == "value" and self.closes_with == "}")
        return mark == self.closes_with and not unfinished


def values(text: str) -> Iterator[tuple[int, object]]:
    """Every object and list in a text, with its end position, inner ones before outer ones.

    Never raises; takes linear time.
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
    """Parse one token and return its end; on an error clear the stack and return None."""
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
    """The string or word at this position, and its end; None if there is none.

    A number, or a word such as `true` or `null`, has the value None.

    `unclosed` maps an opening quote without a closing one to the end of its line: up to there it
    is not searched again.
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
    """The character of an escape; an escape unknown to JSON means the character itself."""
    if code := found[1]:
        return chr(int(code, 16))
    return _SHORT.get(found[2], found[2])
