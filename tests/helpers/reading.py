"""Commands as a test lays them down, so that the tree is tested whatever the grammar can read.

"put | mug | from sofa | to desk": the verb, the thing, words for where it is and where it is to go.
"""

import io
from collections.abc import Callable, Iterable
from dataclasses import replace
from pathlib import Path
from typing import Any

from executive.app.parts import Parts, mission_tree
from executive.app.session import Session
from executive.config import load_settings
from executive.events import Inbox
from executive.interfaces import Tree
from executive.language.grammar import EnglishInterpreter
from executive.replay.replaying import Replay, replay
from executive.types import Command, CommandKind, Goal, PutDown
from executive.user import Scripted
from sim.fake import FakeWorld
from trees.context import MissionContext


class LaidDown(EnglishInterpreter):
    """Reads these, and all else as ever."""

    def command(self, words: str) -> Command | None:
        if "|" not in words:
            return super().command(words)
        kind, target, *places = (part.strip() for part in words.split("|"))
        named = {way: place for way, _, place in (place.partition(" ") for place in places)}
        return Command(CommandKind(kind), target, words, named.get("from", ""), named.get("to", ""))


def laid_down(parts: Parts) -> Parts:
    """With this interpreter."""
    return replace(parts, interpreter=LaidDown())


def replayed(run: Path) -> Replay:
    """A recording run again with this interpreter."""

    def build(context: MissionContext) -> Tree:
        return mission_tree(replace(context, interpreter=LaidDown()))

    return replay(run, build)


def session_of(runs: Path, answers: Iterable[str | None] = (), **settings: Any) -> Session:
    """A session with a person who answers so; in the instant world, if nothing else is set."""
    inbox = Inbox()
    made = load_settings(**{"world": "fake", "llm": "none", "runs": runs, **settings})
    user = Scripted(inbox, answers)
    return Session(made, inbox=inbox, user=user, out=io.StringIO(), change=laid_down)


def session_in(
    runs: Path, answers: Iterable[str | None] = (), **settings: Any
) -> tuple[Session, FakeWorld]:
    """A session in the instant world, and that world."""
    session = session_of(runs, answers, **settings)
    assert isinstance(session.embodiment.truth, FakeWorld)
    return session, session.embodiment.truth


def without_room(*places: str) -> Callable[[Goal], str | None]:
    """A fault: nothing can be put down at these places."""

    def fault(goal: Goal) -> str | None:
        no_room = isinstance(goal, PutDown) and goal.place in places
        return f"there is no free spot on the {goal.place}" if no_room else None

    return fault


def told(session: Session) -> list[str]:
    """All that the robot has said to the person, and asked."""
    user = session.parts.user
    assert isinstance(user, Scripted)
    return [*user.told, *(question.text for question in user.asked)]
