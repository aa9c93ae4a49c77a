"""Small talk and questions for help at the door: answered, and no mission."""

import json
import os

import pytest

from executive.__main__ import main

pytestmark = pytest.mark.usefixtures("own_folder_and_signals")

QUICK = ["--world", "fake", "--llm", "none", "--user", "none"]


@pytest.mark.parametrize(
    ("words", "answer"),
    [
        ("Hello!", "Hello!"),
        ("Thanks", "You are welcome."),
        ("help", "I can find, take, bring"),
        ("What can you do?", "Say for example 'Find the apple'"),
        ("Where is the sofa?", "The sofa is in the living room."),
        ("Where is the bedroom?", "In the bedroom there is the bed, the desk and the bookshelf"),
        (
            "Where do you keep the scissors?",
            "The scissors are usually on the desk or the sideboard.",
        ),
        ("Where are you?", "I am with you. At rest: I wait for what you say."),
        ("What colour is the mug?", "It is red, to drink from,"),
        ("What are the scissors for?", "They are orange and silver, to cut with and for paper."),
        ("Which fruits do you know?", "I know the apple, the banana,"),
        ("What is a unicorn?", "I know no 'unicorn'."),
        ("The mug and the pear are on the bed", "I remember that the pear is on the bed."),
    ],
)
def test_is_answered_without_a_run_folder(
    words: str, answer: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main([*QUICK, words]) == 0
    said = capsys.readouterr()
    assert answer in said.err
    assert (said.out, os.listdir()) == ("", [])


def test_who_reads_outcomes_gets_one_for_whatever_is_said(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert main([*QUICK, "--json", "Hello!"]) == 0
    assert json.loads(capsys.readouterr().out)["reason"] == "Hello!"
