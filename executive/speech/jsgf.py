"""The grammar for pocketsphinx: sentences to a robot, with the names of a home."""

import re
import tomllib
from collections.abc import Callable, Sequence
from importlib.resources import files

from executive.language.phrases import ENGLISH
from executive.speech.interfaces import Vocabulary

_ASSETS = files("executive.speech").joinpath("assets")
_WORDS = tomllib.loads(_ASSETS.joinpath("english.toml").read_text("utf-8"))
TEMPLATE = _ASSETS.joinpath("english.jsgf").read_text("utf-8")
LITTLE = frozenset(_WORDS["little"].split())
"""Function words, which say little about what to do."""
OTHER_NAMES = frozenset(_WORDS["other_names"].split())
OTHER_DEEDS = frozenset(ENGLISH["unable"].split())
"""Names of things that this home may not have, and verbs for what the robot cannot do: people may
say them all the same."""
_SYNTAX = re.compile(r"<[^>]*>|//.*|#JSGF.*|grammar \w+;|\bpublic\b")
_WORD = re.compile(r"[a-z'-]+")


def grammar(
    vocabulary: Vocabulary, is_known: Callable[[str], bool], *, others: bool = False
) -> tuple[str, tuple[str, ...]]:
    """The grammar in JSGF, and the names left out because they have a word that is not `is_known`.

    With `others`, it also has `OTHER_NAMES` and `OTHER_DEEDS`, as far as they are known.
    """
    every = (*vocabulary.things, *vocabulary.places)
    unheard = tuple(name for name in every if not all(map(is_known, name.split())))
    things = [name for name in vocabulary.things if name not in unheard]
    own = {word for name in every for word in name.split()}
    rules = {
        "thing_name": things,
        "vowel_name": [name for name in things if name[0] in "aeiou"],
        "place_name": [name for name in vocabulary.places if name not in unheard],
        "other_name": [w for w in sorted(OTHER_NAMES - own) if others and is_known(w)],
        "other_deed": [w for w in sorted(OTHER_DEEDS) if others and is_known(w)],
    }
    text = TEMPLATE
    for name, words in rules.items():
        text = _with_rule(text, name, words)
    return text, unheard


def words_of_template() -> frozenset[str]:
    """All words of the grammar's template."""
    return frozenset(_WORD.findall(_SYNTAX.sub(" ", TEMPLATE)))


def _with_rule(text: str, name: str, words: Sequence[str]) -> str:
    """Set the alternatives of a rule; if there are none, remove references to it."""
    if words:
        return f"{text}<{name}> = {' | '.join(words)};\n"
    return re.sub(rf"\| (\w+ )?<{name}>", "", text)
