"""Sentences that the grammar makes itself, however odd: none of them is too much for the reader."""

import re

from hypothesis import given, settings
from hypothesis import strategies as st
from lark import Token

from executive.language.grammar import EnglishInterpreter
from executive.language.reader import english

PARSER = english().parser
AHEAD = re.compile(r"\(\?[=!][^()]*(?:\([^()]*\)[^()]*)*\)")
"""What has to follow, or must not: the next word is drawn by the grammar."""


def words_of(name: str, pattern: str) -> st.SearchStrategy[str]:
    if name in ("WORD", "NAME"):
        return st.sampled_from(("mug", "desk", "red", "anna"))
    return st.from_regex(AHEAD.sub("", pattern), fullmatch=True)


WORDS = {each.name: words_of(each.name, each.pattern.to_regexp()) for each in PARSER.terminals}
read = EnglishInterpreter()


@given(st.data())
@settings(max_examples=200, deadline=None)
def test_what_the_grammar_allows_is_read_or_refused_and_nothing_is_raised(data) -> None:
    parsing, said = PARSER.parse_interactive(""), list[str]()
    for _ in range(data.draw(st.integers(1, 12))):
        allowed = sorted(parsing.accepts() - {"$END"})
        if not allowed:
            break
        terminal = data.draw(st.sampled_from(allowed))
        said.append(data.draw(WORDS[terminal]))
        parsing.feed_token(Token(terminal, said[-1]))
    words = " ".join(said)
    assert read.command(words) is None or not read.remark(words)
