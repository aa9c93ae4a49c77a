import io
from collections.abc import Callable
from pathlib import Path
from typing import Any

from executive.app.parts import Change, as_they_are
from executive.app.session import Session
from executive.config import KnowledgeSystem, Settings
from executive.events import Inbox
from executive.types.goals import Goal
from executive.user import Scripted
from kb.llm.scripted import Scripted as ScriptedModel
from sim.fake import FakeWorld


def knowledge(llm: bool, remembers: bool) -> KnowledgeSystem:
    if not llm:
        return KnowledgeSystem.OKB
    return KnowledgeSystem.OKB_LLM_MEM if remembers else KnowledgeSystem.OKB_LLM


def recorded(
    runs: Path,
    words: str,
    *,
    answers: Any = None,
    replies: Any = (),
    llm: bool = True,
    remembers: bool = True,
    fault: Callable[[Goal], str | None] = lambda goal: None,
    during: Callable[[Goal, Inbox], None] = lambda goal, inbox: None,
    change: Change = as_they_are,
    **settings: Any,
) -> Path:
    """Run a mission in the instant world as the program does; return its folder."""
    inbox = Inbox()
    session = Session(
        Settings(
            world="fake",
            user="oracle",
            runs=runs,
            knowledge=knowledge(llm, remembers),
            **{"search": "paper", **settings},
        ),
        inbox=inbox,
        user=None if answers is None else Scripted(inbox, answers),
        model=ScriptedModel(replies, inbox) if llm else None,
        out=io.StringIO(),
        change=change,
    )
    assert isinstance(session.world, FakeWorld)
    session.world.fault = fault
    start = session.parts.robot.start

    def start_and_note(goal: Goal) -> int:
        request = start(goal)
        during(goal, inbox)
        return request

    session.parts.robot.start = start_and_note  # type: ignore[method-assign]
    outcome = session.run(words)
    session.close()
    return Path(outcome.run_dir or "")
