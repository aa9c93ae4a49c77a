"""Words that ask for an empty hand: "put it down", "put the mug down", "empty your hand"."""

from executive.types import HELD

_POLITE = ("please", "robot", "hey", "hello", "now", "then", "and", "just")
_ASKING = ("could you", "can you", "would you", "will you", "i'd like you to", "i want you to")
_EMPTY = frozenset({"empty your hand", "empty your hands", "empty the hand", "let go", "let it go"})
_PUT = ("put", "set", "place")
_DROP = ("drop ", "release ", "let go of ")
_HELD = frozenset({"", "it", "that", "this", "them", "those", "thing", "what you hold"})
_ARTICLES = ("a", "an", "the", "my", "that", "this", "your")


def to_put_down(plain: str) -> str | None:
    """What is to be put down (`HELD`: whatever is in the hand); None if that is not asked for.

    Args:
        plain: the words in lower case, with single spaces and no punctuation at their ends.
    """
    words = _without_manners(plain)
    if words in _EMPTY:
        return HELD
    verb, _, rest = words.partition(" ")
    if verb in _PUT:
        if rest == "down" or rest.startswith("down "):
            return _thing(rest.removeprefix("down"))
        return _thing(rest.removesuffix(" down")) if rest.endswith(" down") else None
    dropped = next((rest for verb in _DROP if (rest := words.removeprefix(verb)) != words), None)
    return None if dropped is None else _thing(dropped)


def _thing(words: str) -> str | None:
    """What the words name; None if they go on to say where to, which is more than this can do."""
    if words.strip() in _HELD:
        return HELD
    names = words.split()
    while len(names) > 1 and names[0] in _ARTICLES:
        del names[0]
    said = {"on", "in", "to", "next", "into", "at", "by", "there", "here"} & set(names)
    return None if said else " ".join(names) if names[0] not in _HELD else HELD


def _without_manners(plain: str) -> str:
    words = plain.split()
    while words:
        asking = next((a.split() for a in _ASKING if words[: len(a.split())] == a.split()), [])
        if words[0] in _POLITE:
            del words[0]
        elif asking:
            del words[: len(asking)]
        elif words[-1] in _POLITE:
            del words[-1]
        else:
            break
    return " ".join(words)
