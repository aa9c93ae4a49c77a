"""One composition: whoever makes a mission makes it of `Parts`, with the same function."""

import io
import re
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from executive.app import parts
from executive.app.parts import Parts
from executive.app.session import Session
from executive.campaign import blocks
from executive.config import KnowledgeSystem, Settings, load_settings
from executive.errors import ExecutiveError, InputError
from executive.events import Inbox
from executive.language.spoken import Spoken
from executive.replay import replay
from executive.testing.bench import run_mission
from executive.types.commands import Commands
from kb.facts import FactStore
from kb.llm.scripted import Scripted
from trees.__main__ import build

QUICK: dict[str, Any] = {"world": "fake", "user": "oracle", "llm": "none"}
SOURCE = Path(parts.__file__).parents[2]
PACKAGES = ("executive", "trees", "kb", "sim", "logs")


@pytest.fixture
def made(monkeypatch: pytest.MonkeyPatch) -> list[Any]:
    """Every context that is made from now on."""
    contexts: list[Any] = []
    make = parts.build_context

    def noted(*given: Any) -> Any:
        contexts.append(make(*given))
        return contexts[-1]

    monkeypatch.setattr(parts, "build_context", noted)
    return contexts


def test_session_replay_campaign_bench_and_show_make_missions_alike(
    made: list[Any], tmp_path: Path
) -> None:
    with Session(Settings(**QUICK, runs=tmp_path), out=io.StringIO()) as session:
        run = session.run("Find the mug").run_dir
    assert len(made) == 1
    replay(Path(run or ""))
    assert len(made) == 2
    run_mission("Find the mug")
    assert len(made) == 3
    list(blocks.run(blocks.Block(load_settings(**QUICK), ("Find the mug",))))
    assert len(made) == 4
    build("okb", "rank")
    assert len(made) == 5


def test_a_session_that_is_closed_runs_no_mission() -> None:
    with Session(Settings(**QUICK), recorded=False, out=io.StringIO()) as session:
        pass
    session.close()
    with pytest.raises(ExecutiveError, match="this session is closed"):
        session.run("Find the mug")


def test_nobody_else_makes_a_context() -> None:
    files = (file for package in PACKAGES for file in (SOURCE / package).rglob("*.py"))
    makers = [file for file in files if re.search(r"\bMissionContext\(", file.read_text())]
    assert makers == [Path(parts.__file__)]


def test_a_part_that_is_put_in_reaches_the_behaviours_of_session_and_bench() -> None:
    asked: list[str] = []

    class Attentive:
        def commands(self, words: str, spoken: Spoken, *, holds: bool) -> Commands:
            asked.append(words)
            return ()

        def __getattr__(self, name: str) -> Any:
            return lambda *answer: None

    def change(before: Parts) -> Parts:
        return replace(before, interpreter=Attentive())

    with Session(Settings(**QUICK), recorded=False, out=io.StringIO(), change=change) as session:
        session.run("Find the mug")
    run_mission("Find the hammer", llm=False, change=change)
    assert asked == ["Find the mug", "Find the hammer"]


# --- what a session opens, it closes ---


class Counted(Scripted):
    closed = 0

    def close(self) -> None:
        self.closed += 1


def test_a_model_that_was_given_stays_open(tmp_path: Path) -> None:
    inbox = Inbox()
    model = Counted([], inbox)
    settings = Settings(**{**QUICK, "llm": "embedded"})
    with Session(settings, inbox=inbox, model=model, recorded=False, out=io.StringIO()):
        pass
    assert model.closed == 0


def test_a_model_that_was_opened_is_closed_once_also_if_the_body_cannot_be_built(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    model = Counted([], Inbox())
    monkeypatch.setattr("executive.app.building.model_for_missions", lambda *given: model)
    settings = Settings(**{**QUICK, "knowledge": KnowledgeSystem.OKB_LLM, "fault": ("crate=2,2",)})
    with pytest.raises(InputError, match="this needs --world physics"):
        Session(settings, recorded=False)
    assert model.closed == 1


def test_a_session_closes_what_it_opened_once(monkeypatch: pytest.MonkeyPatch) -> None:
    closed = []
    monkeypatch.setattr(FactStore, "close", lambda self: closed.append("facts"))
    with Session(Settings(**QUICK), recorded=False, out=io.StringIO()) as session:
        pass
    session.close()
    assert closed == ["facts"]


def test_sessions_of_one_home_share_what_is_known_of_it(tmp_path: Path) -> None:
    one, other = (_knowledge(tmp_path) for _ in range(2))
    assert one is other


def test_a_file_that_has_changed_is_read_again(tmp_path: Path) -> None:
    file = tmp_path / "mine.ttl"
    ours = "https://example.org/mine"
    lines = f"<{ours}> a <http://www.w3.org/2002/07/owl#Ontology> .\n"
    contents = []
    for more in ("", "# more\n"):
        file.write_text(lines + more)
        contents.append(_knowledge(tmp_path, kb=(file,)).files()["mine.ttl"])
    assert contents == [lines.encode(), (lines + "# more\n").encode()]


def _knowledge(folder: Path, **settings: Any) -> Any:
    with Session(load_settings(**QUICK, runs=folder, **settings)) as session:
        return session.parts.knowledge
