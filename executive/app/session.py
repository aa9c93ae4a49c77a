"""A session: runs missions one after another, with parts that outlive them."""

import logging
import sys
import time
from collections.abc import Callable, Iterable, Sequence
from contextlib import ExitStack
from dataclasses import replace
from datetime import UTC, datetime
from pathlib import Path
from typing import Self, TextIO

from executive.app.between import Between
from executive.app.building import build_parts
from executive.app.parts import OURS, Build, Change, as_they_are, build_mission, mission_tree
from executive.app.recording import Recording, body_used, files_used
from executive.app.run_folder import new_folder, to_json, write
from executive.app.sources import checked
from executive.app.speaking import speak_aloud
from executive.app.talking import answer, remember
from executive.config import Settings
from executive.errors import ExecutiveError, InputError
from executive.events import THE_PERSON, Broke, Event, Inbox, Started, StopRequested
from executive.guards import GuardedExperience, GuardedRecorder, GuardedRobot, GuardedUser, in_words
from executive.interfaces.dialogue import User
from executive.interfaces.knowledge import PlaceSource
from executive.interfaces.llm import LanguageModel
from executive.interfaces.robot import Robot
from executive.interfaces.simulation import SimulatedHome
from executive.language.control import control
from executive.loop import who_interrupts
from executive.records import EventTaken, Finished
from executive.situation import FIRST, Ending, Situation
from executive.text import one_line, too_long, writable
from executive.types.goals import Halt
from executive.types.outcome import MissionStatus, Outcome
from executive.user import Console, at_rest
from logs.recorder import FanOut, Sink

CLOSED = (
    "this session is closed, and its robot let go of: "
    "run missions inside of its with block, or make a new Session"
)

log = logging.getLogger(__name__)


class Session:
    """Runs missions with parts that outlive them: the body, knowledge, model and person.

    Use it in a `with` block, at the end of which it closes what it has opened.

    Attributes:
        parts: the collaborators of all missions: those that the settings name, after `change`.
        doubt: takes in what a microphone hears; None if there is no person to listen to.
        heard: what the person said too late for the mission in which they said it, the oldest
            first.
        standing: returns the events that each mission begins with in addition to its words: what
            an experimenter has ordered in advance.
        folder: the run folder of the last mission; None if it has none.
        is_recorded: whether the recording of the last mission is complete; if not, warnings have
            said what it lacks.
        ticks: how often the tree of the last mission was ticked.
        stopped_by: who ended the whole session, in the last mission or just after it. It is empty
            if nobody did; a stop by the person or an experimenter ends only the mission.
    """

    def __init__(
        self,
        settings: Settings,
        *,
        inbox: Inbox | None = None,
        user: User | None = None,
        model: LanguageModel | None = None,
        view: bool = False,
        gui: bool = False,
        out: TextIO | None = None,
        recorded: bool = True,
        sinks: Sequence[Sink] = (),
        sources: Sequence[PlaceSource] = (),
        policy: str = OURS,
        change: Change = as_they_are,
        build: Build = mission_tree,
    ) -> None:
        """Build all parts.

        Args:
            settings: which parts to build, and how missions are run.
            inbox: where events come in; by default a new one.
            user: the person, instead of the one that the settings name.
            model: the language model, instead of the one that the settings name.
            view: whether to start the rerun viewer and show missions live.
            gui: whether to show the simulator's own window.
            out: where the robot's words go; by default standard error.
            recorded: whether each mission leaves a run folder.
            sinks: further logs; they get every record, also if not `recorded`, and are closed after
                each mission.
            sources: know where things are; asked in this order, after the robot's own memory.
            policy: the name of `change` in recordings.
            change: replaces parts; a replay of the recordings must be given the same.
            build: makes the tree of each mission; a replay must be given the same, too.

        Raises:
            ExecutiveError: if a setting, a source, the home, the ontology or the model file is
                wrong.
        """
        self.settings = settings
        self.inbox = inbox or Inbox()
        self.recorder = FanOut(lambda: self.parts.clock.now(), live=view)
        used = files_used(settings)
        given = checked(sources)
        with ExitStack() as opened:
            self.embodiment, parts = build_parts(
                settings,
                self.inbox,
                self.recorder,
                opened,
                user=user,
                model=model,
                out=out or sys.stderr,
                gui=gui,
            )
            self.parts = change(replace(parts, sources=given))
            checked(self.parts.sources)
            self.doubt = speak_aloud(self.parts, opened)
            self._recording: Recording | None = None
            if recorded:
                used |= body_used(self.parts)
                self._recording = Recording(used, self.parts, policy, view)
            self._opened = opened.pop_all()
        self._sinks = tuple(sinks)
        self._build = build
        self._between = Between(self.inbox, self.parts.clock)
        self.heard = self._between.heard
        self.standing: Callable[[], Iterable[Event]] = tuple
        self._before = FIRST
        """What earlier missions hand on to the next."""
        self._closed = False
        # of the last mission
        self.folder: Path | None = None
        self.is_recorded = True
        self.ticks = 0
        self.stopped_by = ""

    @property
    def robot(self) -> Robot:
        """The robot, as its adapter made it."""
        return self.parts.robot

    @property
    def world(self) -> SimulatedHome | None:
        """The simulated world, with the truth that the robot does not know; None if it is real."""
        return self.embodiment.truth

    def __enter__(self) -> Self:
        """Everything is open already."""
        return self

    def __exit__(self, *_: object) -> None:
        """Close."""
        self.close()

    def close(self) -> None:
        """Close what the session has opened: the body, the file of facts, the model.

        No mission can be run afterwards.
        """
        self._closed = True
        self._opened.close()

    def run(self, words: str) -> Outcome:
        """Run one mission, from words to its outcome, in a run folder of its own.

        Words that need no mission are answered (see `talk`), and words that are too long are
        refused; neither leaves a folder. Words that say stop are a mission that ends at once.
        Whatever fails, there is an outcome, and the robot is told to halt. Of the events that came
        before the mission only a stop counts, and none of its own is left for the next mission.

        Raises:
            ExecutiveError: if the session is closed.
            InputError: if the folder of the first mission cannot be made. If that of a later one
                cannot, the mission runs without.
            KeyboardInterrupt: if a signal says stop for the second time.
        """
        if self._closed:
            raise ExecutiveError(CLOSED)
        began = time.monotonic()
        self.stopped_by, self.folder = "", None
        if why := too_long(words):
            taken = self.inbox.take_all()  # there is nothing to stop
            self.stopped_by = _for_good(e for e in taken if isinstance(e, StopRequested))
            return without_mission(MissionStatus.NOT_UNDERSTOOD, why)
        words = one_line(writable(words))
        if not control(words) and (said := self.talk(words)):
            return without_mission(MissionStatus.DONE, said)
        if self.parts.experience:
            GuardedExperience(self.parts.experience, self.recorder).learn()
        started = datetime.now(UTC)
        if self._recording:
            self.folder = self._new_folder(started, words)
        situation = Situation.at_start(words, self._before)
        try:
            self._carry_out_safely(situation, started)
        finally:
            outcome = self._end(situation, began)
        self._before = remember(words, outcome, self.parts, self._before)
        return outcome

    def _new_folder(self, started: datetime, words: str) -> Path | None:
        """A new run folder; None, with a warning, if a later one than the first cannot be made.

        By then the robot is in use, and goes on without logs.
        """
        try:
            return new_folder(self.settings.runs, started, words)
        except InputError as error:
            if self._before is FIRST:
                raise
            log.warning("the mission goes on without logs: %s", error)
            return None

    def _end(self, situation: Situation, began: float) -> Outcome:
        """Record the outcome of the mission, and keep what the next one needs to know."""
        self._before = situation.at_end(self._before)
        self._leave()
        outcome = situation.outcome(
            mission_time_s=self._mission_time(),
            wall_time_s=time.monotonic() - began,
            run_dir=str(self.folder) if self.folder else None,
        )
        self._before = replace(self._before, last=outcome)
        if outcome.status != MissionStatus.STOPPED:
            self.heard.extend(situation.dialogue.heard)
        try:
            GuardedRecorder(self.recorder).record(Finished(outcome))
            if self.folder and not write(self.folder / "outcome.json", to_json(outcome) + "\n"):
                self.is_recorded = False
        finally:
            self._close_logs()
        return outcome

    def _leave(self) -> None:
        """Tell the body that the mission has ended."""
        try:
            self.embodiment.end()
        except Exception as error:
            log.warning("the world cannot be left in order: %s", in_words(error))

    def _close_logs(self) -> None:
        """Finish the recording; Ctrl-C meanwhile ends the program, but only after that."""
        try:
            self.recorder.close()
        except KeyboardInterrupt:
            self.recorder.close()
            raise
        finally:
            self.is_recorded = self.is_recorded and self.recorder.is_whole

    def _carry_out_safely(self, situation: Situation, started: datetime) -> None:
        """Run the mission; also what fails before its tree is built ends it in order."""
        try:
            self._begin(started)
            self._carry_out(situation)
        except BaseException as error:
            if not situation.ending.is_over:
                self._break_off(situation, error)
            if not isinstance(error, Exception):
                raise

    def _break_off(self, situation: Situation, error: BaseException) -> None:
        """End a mission that could not begin; the robot is told to halt nevertheless."""
        log.debug("the mission could not begin", exc_info=error)
        recorder = GuardedRecorder(self.recorder)
        broke = Broke(f"internal error: {in_words(error)}")
        end = broke if isinstance(error, Exception) else StopRequested(who_interrupts(error))
        for event in (Started(situation.request.words), end):
            situation.fold(event)
            recorder.record(EventTaken(event))
        GuardedRobot(self.parts.robot, self.inbox, recorder).start(Halt())
        self.inbox.drop_all()
        situation.ending.stay_restless()

    def _mission_time(self) -> float:
        """The mission time (s); 0 if the clock raises."""
        try:
            return self.parts.clock.now()
        except Exception:
            return 0.0

    def _begin(self, started: datetime) -> None:
        """Start the clock and the logs, and record the scene."""
        self.inbox.drop_all()
        self.parts.clock.restart()
        logs: list[Sink] = []
        self.is_recorded = self.folder is not None or self._recording is None
        try:
            if self.folder and self._recording:
                before = self._before.to_metadata()
                logs, self.is_recorded = self._recording.sinks(self.folder, started, before)
        except Exception as error:
            log.warning("the mission goes on without logs: %s", in_words(error))
            self.is_recorded = False
        self.recorder.open([*logs, *self._sinks], started)
        try:
            self.embodiment.begin()
        except Exception as error:
            log.warning("the world cannot be drawn in the log: %s", in_words(error))

    def _carry_out(self, situation: Situation) -> None:
        """Build the mission's tree and run it, beginning with the words."""
        executive = build_mission(self.parts, situation, self._build)
        started = Started(situation.request.words)
        for event in (started, *self._between.listened, *self.standing()):
            self.inbox.post(event)
        self._between.listened.clear()
        if control(situation.request.words):  # "stop", and there is nothing to stop
            self.inbox.post(StopRequested(f"{THE_PERSON} before anything began"))
            user = GuardedUser(self.parts.user, self.inbox, self.recorder)
            user.tell(at_rest(situation.request.words))
        try:
            executive.run()
        finally:
            self.ticks = executive.ticks
            self.stopped_by = _for_good(executive.stops)

    def talk(self, words: str) -> str:
        """Answer words that need no mission; return what was said, empty if they do need one.

        They are small talk, questions about the robot or what it knows, and statements about where
        something is, which it remembers.
        """
        said, self._before = answer(words, self.parts, self._before)
        if said:
            self.parts.user.tell(said)
        return said

    def next_command(self, console: Console, prompt: str = "") -> str | None:
        """Prompt the person and wait for a command; None if the input or the session has ended.

        Raises:
            KeyboardInterrupt: if a stop ends the session, as a signal does.
        """
        return self._between.next_command(console, prompt)


def without_mission(status: MissionStatus, said: str) -> Outcome:
    """The outcome of words that needed no mission; `said` is what was answered."""
    situation = Situation(ending=Ending(status, said))
    return situation.outcome(mission_time_s=0.0, wall_time_s=0.0, run_dir=None)


def _for_good(stops: Iterable[StopRequested]) -> str:
    """Who was the first to end the whole session; empty if nobody did."""
    return next((stop.by for stop in stops if stop.ends_session), "")
