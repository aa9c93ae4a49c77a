"""How the language model is made to read words that are no plain command."""

import json

import pytest
from hypothesis import given
from hypothesis import strategies as st

from executive.testing.bench import ontology
from executive.types import SEARCHING, CommandKind, Scored, Usage
from kb.advice import commands
from kb.advice.reader import Reader

READER = Reader(ontology(True))


def test_the_model_can_choose_among_the_kinds_and_the_known_objects_only() -> None:
    request = READER.inquiry("Come with the hammer!")
    assert request.schema
    assert request.schema["properties"]["kind"]["enum"] == list(SEARCHING)
    assert request.schema["properties"]["object"]["enum"] == list(ontology(True).objects())
    assert "Come with the hammer!" in request.messages[-1].content


def test_the_likeliest_kind_is_taken() -> None:
    request = READER.ranking("Come with the hammer!")
    assert request.options[1] == "I take it in my hand."
    assert request.places == SEARCHING
    assert READER.ranked(Scored(request, (0.1, 0.3, 0.2), Usage())) == CommandKind.TAKE


@pytest.mark.parametrize(
    ("reply", "command"),
    [
        ('{"kind": "bring", "object": "apple"}', (CommandKind.BRING, "apple")),
        (
            'Sure! ```{"kind": "find", "object": "the Sugar Box"}```',
            (CommandKind.FIND, "sugar_box"),
        ),
        ('{"kind": "bring", "object": "crown"}', None),
        ('{"kind": "bring", "object": "fruit"}', None),
        ('{"kind": "steal", "object": "apple"}', None),
        ('{"kind": "bring", "object": ["apple"]}', None),
        ("bring the apple", None),
        ("", None),
    ],
)
def test_only_a_known_kind_with_one_known_object_is_read(
    reply: str, command: tuple[CommandKind, str] | None
) -> None:
    assert READER.read(reply) == command


@given(
    st.text()
    | st.dictionaries(st.sampled_from(["kind", "object", "x"]), st.text() | st.none()).map(
        json.dumps
    )
)
def test_whatever_the_model_writes_nothing_is_raised_or_invented(reply: str) -> None:
    command = READER.read(reply)
    assert command is None or command[1] in ontology(True).objects()
    commands.read(reply)
