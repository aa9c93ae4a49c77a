"""How the language model is made to read words that are no plain command."""

import json

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from executive.language.grammar import EnglishInterpreter
from executive.testing.bench import ontology
from executive.types.commands import SEARCHING, CommandKind
from executive.types.llm import Usage
from executive.types.results import Scored
from kb.advice.commands import DEEDS
from kb.advice.reader import Reader

READER = Reader(ontology(True))


def test_the_model_can_choose_among_what_exists_only() -> None:
    request = READER.inquiry("Come with the hammer!")
    assert request.schema
    task = request.schema["properties"]["tasks"]["items"]["properties"]
    assert set(SEARCHING) < set(task["kind"]["enum"])
    assert {*ontology(True).objects(), "fruit", ""} <= set(task["object"]["enum"])
    assert task["to"]["enum"][:3] == ["", "me", "cabinet_kitchen"]
    assert "living_room" in task["from"]["enum"]
    assert "Come with the hammer!" in request.messages[-1].content
    assert "cabinet_kitchen" in request.messages[0].content


def test_the_likeliest_kind_is_taken() -> None:
    request = READER.ranking("Come with the hammer!")
    assert request.options[1] == "I take it in my hand."
    assert request.places == SEARCHING
    assert READER.ranked(Scored(request, (0.1, 0.3, 0.2), Usage())) == CommandKind.TAKE


def task(kind: str, **given: object) -> dict[str, object]:
    """A task of a reply; `source` and `goal` are written `from` and `to`."""
    written = {"source": "from", "goal": "to"}
    return {"kind": kind, **{written.get(name, name): value for name, value in given.items()}}


@pytest.mark.parametrize(
    ("tasks", "plain"),
    [
        ([task("bring", object="mug", source="desk")], "bring me the mug from the desk"),
        ([task("Find", object="the Sugar Box", number=1)], "find the sugar box"),
        ([task("put", object="mug", goal="kitchen")], "bring the mug to the kitchen"),
        ([task("put", object="mug", goal="me")], "bring the mug to me"),
        ([task("take", object="fruit")], "take the fruit"),
        ([task("bring", object="apple", number=2)], "bring me 2 apples"),
        ([task("bring", object="fruit", number="all")], "bring me all the fruits"),
        ([task("put back", object="mug")], "put the mug back"),
        ([task("put_down")], "put it down"),
        ([task("go", goal="living_room")], "go to the living room"),
        ([task("go", goal="me")], "come here"),
        (
            [task("take", object="mug"), task("go", goal="desk")],
            "take the mug, then go to the desk",
        ),
        ([task("bring", object="crown")], ""),
        ([task("bring", object="mug", source="attic")], ""),
        ([task("bring", object="mug"), task("bring", object="crown")], ""),
        ([task("bring", object="mug", number=100)], ""),
        ([task("bring", object="mug", number=True)], ""),
        ([task("put", object="mug")], ""),
        ([task("find", object="mug", goal="desk")], ""),
        ([task("go", object="mug", goal="desk")], ""),
        ([task("bring")], ""),
        ([task("steal", object="apple")], ""),
        ([task("bring", object=["apple"])], ""),
        ([], ""),
    ],
)
def test_tasks_with_what_exists_are_said_in_plain_words_and_others_are_not(
    tasks: list[dict[str, object]], plain: str
) -> None:
    assert READER.read(json.dumps({"tasks": tasks})) == plain


def test_a_single_task_is_read_as_models_wrote_it_once() -> None:
    assert READER.read('Sure! ```{"kind": "find", "object": "apple"}```') == "find the apple"
    assert READER.read("bring the apple") == READER.read("") == ""


NAMES = ontology(True).names()
PLACES = ("", "desk", "cabinet_kitchen", "living_room", "me")
TASKS = st.builds(
    lambda kind, thing, source, goal: task(kind, object=thing, source=source, goal=goal),
    st.sampled_from(DEEDS),
    st.sampled_from(("", *ontology(True).objects(), "fruit")),
    st.sampled_from(PLACES[:-1]),
    st.sampled_from(PLACES),
)


@given(TASKS)
def test_the_grammar_reads_of_a_task_what_the_model_wrote(asked: dict[str, object]) -> None:
    plain = READER.read(json.dumps({"tasks": [asked]}))
    assume(plain)
    command = EnglishInterpreter(NAMES).command(plain)
    assert command
    moves = asked["kind"] in ("bring", "take") and asked["to"] not in ("", "me")
    comes = asked["kind"] == "put" and asked["to"] == "me"
    assert command.kind == ("put" if moves else "bring" if comes else asked["kind"])
    known = ontology(True)
    if asked["object"]:
        assert known.objects_named(command.target) == known.objects_named(str(asked["object"]))
    assert known.places_named(command.source) == known.places_named(str(asked["from"]))
    if asked["to"] not in ("", "me"):
        assert known.places_named(command.goal) == known.places_named(str(asked["to"]))


@given(
    st.text()
    | st.dictionaries(st.sampled_from(["kind", "object", "tasks", "x"]), st.text() | st.none()).map(
        json.dumps
    )
)
def test_whatever_the_model_writes_nothing_is_raised(reply: str) -> None:
    assert not READER.read(reply) or READER.read(reply).split()[0] in ("find", "take", "bring")
