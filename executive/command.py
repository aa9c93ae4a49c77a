"""Words to commands: the small English that a person uses to a robot."""

import re

from executive.types import Command, Kind

_VERBS: dict[str, Kind] = {
    "find": Kind.FIND,
    "locate": Kind.FIND,
    "look for": Kind.FIND,
    "search for": Kind.FIND,
    "where is": Kind.FIND,
    "where are": Kind.FIND,
    "take": Kind.TAKE,
    "grab": Kind.TAKE,
    "grasp": Kind.TAKE,
    "pick up": Kind.TAKE,
    "bring": Kind.BRING,
    "fetch": Kind.BRING,
    "get": Kind.BRING,
    "give": Kind.BRING,
    "deliver": Kind.BRING,
}
_COMMAND = re.compile(
    r"(?:please |robot |could you |can you |would you |will you |hey )*"
    rf"(?P<verb>{'|'.join(_VERBS)}) "
    r"(?:(?:me|us) )?(?:(?:a|an|the|my|some|any|one) )*"
    r"(?P<target>(?!(?:a|an|the|me|us|my|some|any|one)$).+?)"
    r"(?: (?:to|for) me| here| please| now)*"
)
_DECLINES = re.compile(
    r"\b(?:don'?t|do not|dunno|no idea|not sure|nowhere|nothing|none|never ?mind|cannot|can'?t)\b"
    r"|^(?:no|nope|\?*)$"
)


class EnglishInterpreter:
    """Reads commands such as "Bring a sugar_box", "Could you fetch me the mug, please?"."""

    def command(self, words: str) -> Command | None:
        """The request in the words, or None if there is none."""
        match = _COMMAND.fullmatch(_plain(words))
        if match is None:
            return None
        return Command(_VERBS[match["verb"]], match["target"], words)

    def declines(self, answer: str) -> bool:
        """Whether an answer says that the person does not know or will not say."""
        return bool(_DECLINES.search(_plain(answer)))


def _plain(words: str) -> str:
    """Lower case, one space between words, no punctuation at the ends or after a clause."""
    text = re.sub(r"[,;:!.?]+(?=\s|$)", " ", words.lower().replace("’", "'"))
    return " ".join(text.split())
