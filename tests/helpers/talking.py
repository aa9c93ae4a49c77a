"""Sessions with a scripted person, and what the robot says in them."""

import io
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

from executive.app.session import Session
from executive.config import load_settings
from executive.events import Inbox
from executive.types.goals import Goal, PutDown
from executive.user import Scripted
from sim.fake import FakeWorld


def session_of(runs: Path, answers: Iterable[str | None] = (), **settings: Any) -> Session:
    """A session with a person who answers so; in the instant world, if nothing else is set."""
    inbox = Inbox()
    made = load_settings(**{"world": "fake", "llm": "none", "runs": runs, **settings})
    user = Scripted(inbox, answers)
    return Session(made, inbox=inbox, user=user, out=io.StringIO())


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
