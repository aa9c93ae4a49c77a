"""Verbs know themselves: what a verb means is declared once, and all who need it find it."""

import pytest

from executive.language.grammar import EnglishInterpreter
from executive.types.commands import SEARCHING, CommandKind
from executive.types.home import DELIVERY, PERSON
from trees.deeds import DEEDS


def test_every_kind_of_command_is_done_by_one_deed() -> None:
    assert sorted(deed.kind for deed in DEEDS) == sorted(CommandKind)


@pytest.mark.parametrize("kind", SEARCHING)
def test_every_verb_about_a_thing_is_a_word_that_is_read(kind: CommandKind) -> None:
    command = EnglishInterpreter().command(f"{kind} the mug")
    assert command
    assert (command.kind, command.target) == (kind, "mug")


def test_a_verb_says_what_becomes_of_the_thing() -> None:
    ends = {kind: (kind.means.grasps, kind.means.ends_at) for kind in CommandKind}
    assert ends[CommandKind.FIND] == (False, PERSON)
    assert ends[CommandKind.TAKE] == (True, None)
    assert ends[CommandKind.BRING] == (True, DELIVERY)
    carrying = [kind for kind in CommandKind if kind.means.carries]
    assert carrying == [CommandKind.BRING, CommandKind.PUT, CommandKind.PUT_BACK]
