"""Words to commands: the small English that a person uses to a robot."""

import re

from executive.language.put_down import to_put_down
from executive.language.verbs import VERBS
from executive.text import LONGEST, one_line, too_long
from executive.types import Command, CommandKind

_LONGEST_FIRST = "|".join(sorted(VERBS, key=len, reverse=True))
_COMMAND = re.compile(
    r"(?:please |robot |could you |can you |would you |will you |hey |hello "
    r"|(?:i'd like|i would like|i want|i need) you to )*"
    rf"(?P<verb>{_LONGEST_FIRST}) "
    r"(?:(?:me|us|please) )*(?:(?:a|an|the|my|some|any|one) )*"
    r"(?P<target>.+)"
)
_NO_TARGET = frozenset({"a", "an", "the", "me", "us", "my", "some", "any", "one", "on", "up"})
_ENDINGS = (" to me", " for me", " up", " over", " here", " please", " now")
_DECLINES = re.compile(
    r"\b(?:don'?t|do not|dunno|no idea|not sure|nowhere|nothing|none|never ?mind|cannot|can'?t)\b"
    r"|^(?:no|nope|\?*)$"
)


_YES = re.compile(
    r"(?:yes|yeah|yep|yup|y|sure|ok|okay|right|correct|exactly|of course|indeed|please do)\b.*"
)
_NO = re.compile(r"(?:no(?! idea)|not(?! sure)|nope|nah|n|wrong)\b.*")


class EnglishInterpreter:
    """Reads commands such as "Bring a sugar_box", "Could you fetch me the mug, please?"."""

    def command(self, words: str) -> Command | None:
        """The request in the words, or None if there is none."""
        if too_long(words):
            return None
        plain = _plain(words)
        if (held := to_put_down(plain)) is not None:
            return Command(CommandKind.PUT_DOWN, held, words)
        match = _COMMAND.fullmatch(plain)
        if match is None:
            return None
        target = match["target"]
        while target.endswith(_ENDINGS):
            target = target.removesuffix(next(e for e in _ENDINGS if target.endswith(e)))
        return None if target in _NO_TARGET else Command(VERBS[match["verb"]], target, words)

    def declines(self, answer: str) -> bool:
        """Whether an answer says that the person does not know or will not say."""
        return bool(_DECLINES.search(_plain(answer)))

    def agrees(self, answer: str) -> bool | None:
        """Whether an answer says yes or no; None if it says neither."""
        plain = _plain(answer)
        if _YES.fullmatch(plain):
            return True
        return False if _NO.fullmatch(plain) else None


def _plain(words: str) -> str:
    """Lower case, one space between words, no punctuation at the ends or after a clause."""
    text = one_line(words[:LONGEST]).lower().replace("’", "'")
    return " ".join(filter(None, (word.rstrip(",;:!.?") for word in text.split())))
