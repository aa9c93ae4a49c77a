import io
from collections.abc import Callable
from pathlib import Path

from executive.app.parts import Change, as_they_are
from executive.app.session import Session
from executive.config import KnowledgeSystem, Settings
from executive.events import Event, Inbox, StopRequested
from executive.replay.replaying import replay
from executive.types.goals import Goal
from executive.types.outcome import Outcome
from logs.recording.reader import Run
from sim.fake import FakeWorld

OKB = {
    "world": "fake",
    "search": "paper",
    "llm": "none",
    "knowledge": KnowledgeSystem.OKB,
    "user": "oracle",
}


class House:
    """A session in the instant world whose parts can be told to misbehave."""

    def __init__(self, runs: Path, change: Change = as_they_are) -> None:
        self.inbox = Inbox()
        self.session = Session(
            Settings(**{**OKB, "runs": runs}),  # type: ignore[arg-type]
            inbox=self.inbox,
            out=io.StringIO(),
            change=change,
        )
        self.goals: list[Goal] = []
        self.during: Callable[[Goal], None] = lambda goal: None
        self._start = self.session.parts.robot.start
        self.session.parts.robot.start = self._noted  # type: ignore[method-assign]

    def _noted(self, goal: Goal) -> int:
        self.goals.append(goal)
        self.during(goal)
        return self._start(goal)

    @property
    def world(self) -> FakeWorld:
        assert isinstance(self.session.world, FakeWorld)
        return self.session.world

    def stop_at(self, *kinds: type[Goal], by: str = "the person") -> None:
        def stop(goal: Goal) -> None:
            if isinstance(goal, kinds):
                self.inbox.post(StopRequested(by))

        self.during = stop

    def run(self, words: str = "Take a power_drill") -> Outcome:
        """Run a mission; whatever became of it, all is in order afterwards."""
        outcome = self.session.run(words)
        assert not self.inbox.awaits_anything
        assert not self.inbox.has_events
        assert self.session.folder
        again = replay(self.session.folder)
        assert (again.parting, again.notes) == (None, ())
        return outcome

    def events(self) -> list[Event]:
        assert self.session.folder
        return [at.value for at in Run(self.session.folder).events()]
