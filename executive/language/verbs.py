"""Which words ask for which deed; what there is to do it with follows them."""

from collections.abc import Mapping

from executive.types import CommandKind

WORDS: Mapping[CommandKind, tuple[str, ...]] = {
    CommandKind.FIND: (
        "find",
        "locate",
        "look for",
        "search for",
        "where is",
        "where are",
        "where's",
        "have you seen",
        "i'm looking for",
        "i am looking for",
        "i lost",
        "i have lost",
        "i can't find",
        "i cannot find",
    ),
    CommandKind.TAKE: (
        "take",
        "grab",
        "grasp",
        "pick",
        "pick up",
        "hold",
        "hold on to",
        "hang on to",
        "get hold of",
        "lift",
        "lift up",
    ),
    CommandKind.BRING: (
        "bring",
        "fetch",
        "get",
        "give",
        "deliver",
        "hand",
        "hand over",
        "pass",
        "carry",
        "let me have",
        "i'd like",
        "i'd like to have",
        "i would like",
        "i would like to have",
        "i want",
        "i need",
        "can i have",
        "could i have",
        "may i have",
        "can i get",
        "could i get",
        "may i get",
    ),
}
"""Of putting down there are more ways to speak: `put_down.py` reads them."""
VERBS: Mapping[str, CommandKind] = {words: kind for kind, said in WORDS.items() for words in said}
