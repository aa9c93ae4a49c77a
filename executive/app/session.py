"""The composition root: builds the parts from the settings and runs missions with them.

Nothing else knows all the rooms of the house. What takes long to import is imported where it is
needed: the model prepares meanwhile.
"""

import json
import logging
import sys
import time
from collections.abc import Callable, Sequence
from datetime import UTC, datetime
from importlib.metadata import version
from pathlib import Path
from typing import TextIO

from executive.app.parts import OURS, Advise, Grounds, build_advisor, build_context
from executive.app.run_folder import new_folder, to_json, write
from executive.app.sources import written
from executive.clock import SimulatedClock
from executive.config import Settings
from executive.errors import InputError
from executive.events import THE_PERSON, Broke, Ended, Inbox, Started, StopRequested
from executive.guards import GuardedModel, GuardedRecorder, GuardedRobot, GuardedSource, in_words
from executive.interfaces import (
    Camera,
    Detector,
    Knowledge,
    LanguageModel,
    PlaceSource,
    Recorder,
    Robot,
    SimulatedHome,
    User,
)
from executive.language.control import control
from executive.loop import Executive, who_interrupts
from executive.perception.pipeline import CameraPerception
from executive.records import EventTaken, Finished
from executive.situation import Ending, Situation
from executive.text import one_line, too_long, writable
from executive.types import Answered, Halt, MissionStatus, Outcome
from executive.user import NOTHING_TO_STOP, Console, Nobody, Oracle
from kb.advice.prompts import Prompts
from kb.facts import FactStore
from kb.llm.key import Key
from kb.llm.llama import LlamaCpp, embedded_model
from kb.llm.server.server import Server
from kb.ontology.ontology import Ontology
from logs.recorder import FanOut, Sink
from logs.recording.sink import McapSink
from sim.fake import FakeCamera, FakeDetector, FakeRobot, FakeWorld
from sim.faults.fake import FaultyFakeRobot
from sim.faults.injector import FaultInjector, FaultyCamera, FaultyDetector
from sim.faults.orders import parse_faults, refuse_physical
from sim.home.home import Home, home_text, load_home
from sim.objects.objects import load_objects
from sim.objects.ycb import with_scans
from trees.mission import mission
from trees.tree import MissionTree

log = logging.getLogger(__name__)

PACKAGES = ("py-trees", "pybullet", "llama-cpp-python", "owlready2", "rerun-sdk", "mcap")


class Session:
    """The parts that outlive a mission (world, knowledge, model, person); runs one at a time."""

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
        advise: Advise = build_advisor,
    ) -> None:
        """Build everything; `user` and `model` replace what the settings name.

        The robot's words go to `out` (default: standard error). Missions that are not `recorded`
        leave no folder; `sinks` are told everything in either case, and closed after each mission.
        `sources` know where things are, and are asked in this order, after the robot's own memory.
        `advise` makes the adviser; `policy` is what its recordings call it.

        Raises:
            ExecutiveError: if a setting, the home, the ontology or the model file is wrong.
        """
        self.settings = settings
        self._view = view
        self._recorded = recorded
        self._sinks = tuple(sinks)
        self._policy = policy
        self.inbox = inbox or Inbox()
        self.home = load_home(settings.home).with_placement(settings.place)
        prompts = Prompts.load(settings.prompts)
        self._used = files_used(settings)
        self.recorder = FanOut(lambda: self.clock.now(), live=view)
        self.model = model or build_model(settings, self.inbox)
        self.knowledge = Ontology(
            self.home.places(),
            defaults=settings.defaults,
            files=settings.kb,
            person=settings.person,
        )
        for warning in self.knowledge.warnings():
            log.warning("%s", warning)
        self.facts = FactStore(settings.memory, learns=settings.learn)
        guarded = GuardedModel(self.model, self.inbox, self.recorder) if self.model else None
        self.grounds = Grounds(
            settings,
            self.home,
            self.knowledge,
            guarded,
            prompts,
            self.facts,
            tuple(GuardedSource(source, self.recorder) for source in sources),
        )
        self.advice = advise(self.grounds)
        self.injector = build_injector(settings, self.home, self.recorder, lambda: self.clock.now())
        self.world, self.robot, camera, detector = build_simulation(
            settings, self.home, self.inbox, self.recorder, self.knowledge, gui, self.injector
        )
        self.clock = SimulatedClock(self.inbox, self.world)
        self.perception = CameraPerception(camera, detector, self.inbox, self.recorder)
        self.user = user or build_user(
            settings, self.inbox, self.world.resting_place, out or sys.stderr
        )
        self._in_hand: str | None = None
        self._restless = False
        self.ticks = 0
        """How often the tree of the last mission was ticked."""
        self.folder: Path | None = None
        """Where the last mission left its recording."""
        self.stopped_by = ""
        """Who said stop in the last mission, or just after it; empty if nobody did.

        Of several, the first who was not the person: that one ends the session, too.
        """

    def run(self, words: str) -> Outcome:
        """One mission, from words to its outcome, with its own run folder if it is recorded.

        Words that are too long are refused at once; words that say stop are a mission that is over.
        Whatever fails, there is an outcome, and the robot is told to halt. What came in before the
        mission counts only if it was a stop; what comes after it does not count for the next one.

        Raises:
            InputError: if the run's folder cannot be made.
            KeyboardInterrupt: if someone says stop by signal a second time.
        """
        began = time.monotonic()
        self.stopped_by, self.folder = "", None
        if why := too_long(words):
            stops = (e.by for e in self.inbox.take_all() if isinstance(e, StopRequested))
            self.stopped_by = next(stops, "")  # there is nothing to stop
            return refused(why)
        words = one_line(writable(words))
        started = datetime.now(UTC)
        folder = new_folder(self.settings.runs, started, words) if self._recorded else None
        self.folder = folder
        situation = Situation.at_start(words, in_hand=self._in_hand, restless=self._restless)
        try:
            self._carry_out_safely(situation, folder, started)
        finally:
            self._in_hand, self._restless = situation.hand.in_hand, situation.ending.restless
            outcome = situation.outcome(
                mission_time_s=self._mission_time(),
                wall_time_s=time.monotonic() - began,
                run_dir=str(folder) if folder else None,
            )
            try:
                GuardedRecorder(self.recorder).record(Finished(outcome))
                if folder:
                    write(folder / "outcome.json", to_json(outcome) + "\n")
            finally:
                self._close_logs()
        return outcome

    def _close_logs(self) -> None:
        """Finish the recording; someone impatient ends the program, but not the recording."""
        try:
            self.recorder.close()
        except KeyboardInterrupt:
            self.recorder.close()
            raise

    def _carry_out_safely(
        self, situation: Situation, folder: Path | None, started: datetime
    ) -> None:
        """What fails before the tree is there to hear of it ends the mission, too."""
        try:
            self._begin(folder, started)
            self._carry_out(situation)
        except BaseException as error:
            if not situation.ending.is_over:
                self._break_off(situation, error)
            if not isinstance(error, Exception):
                raise

    def _break_off(self, situation: Situation, error: BaseException) -> None:
        """End a mission that had not begun; the robot is told to halt nevertheless."""
        log.debug("the mission could not begin", exc_info=error)
        recorder = GuardedRecorder(self.recorder)
        broke = Broke(f"internal error: {in_words(error)}")
        end = broke if isinstance(error, Exception) else StopRequested(who_interrupts(error))
        for event in (Started(situation.request.words), end):
            situation.fold(event)
            recorder.record(EventTaken(event))
        GuardedRobot(self.robot, self.inbox, recorder).start(Halt())
        self.inbox.drop_all()
        situation.ending.stay_restless()

    def _mission_time(self) -> float:
        """The mission time (s); 0 if the clock cannot tell."""
        try:
            return self.clock.now()
        except Exception:
            return 0.0

    def _begin(self, folder: Path | None, started: datetime) -> None:
        """Open the logs, and tell them what is where."""
        self.inbox.drop_all()
        self.clock.restart()
        logs: list[Sink] = []
        try:
            logs = self._logs(folder, started) if folder else []
        except Exception as error:
            log.warning("the mission goes on without logs: %s", in_words(error))
        self.recorder.open([*logs, *self._sinks], started)
        if self.injector:
            self.injector.begin()
        try:
            self.world.describe()
        except Exception as error:
            log.warning("the world cannot be drawn in the log: %s", in_words(error))

    def _carry_out(self, situation: Situation) -> None:
        """Have the tree decide, from the words on."""
        context = build_context(
            self.grounds,
            self.advice,
            situation,
            inbox=self.inbox,
            clock=self.clock,
            recorder=self.recorder,
            robot=self.robot,
            perception=self.perception,
            user=self.user,
        )
        executive = Executive(
            MissionTree(mission(context)),
            situation,
            pending=context.pending,
            inbox=self.inbox,
            clock=self.clock,
            robot=self.robot,
            recorder=self.recorder,
        )
        self.inbox.post(Started(situation.request.words))
        if control(situation.request.words):
            self.inbox.post(StopRequested(f"{THE_PERSON} before anything began"))
            context.user.tell(NOTHING_TO_STOP)
        try:
            executive.run()
        finally:
            self.ticks = executive.ticks
            others = [by for by in executive.stops if by != THE_PERSON]
            self.stopped_by = next(iter(others or executive.stops), "")

    def next_command(self, prompt: str = "") -> str | None:
        """Prompt, and wait for the person to type a command; None if the input or session ends.

        Raises:
            KeyboardInterrupt: if a signal says stop.
        """
        assert isinstance(self.user, Console)
        request = self.user.listen(prompt)
        while True:
            self.clock.wait(None)
            events = self.inbox.take_all()
            command: str | None = None
            for event in events:
                if isinstance(event, StopRequested):
                    if event.by != THE_PERSON:
                        raise KeyboardInterrupt
                    command = None  # it was taken back at once
                elif isinstance(event, Ended) and event.request == request:
                    if not isinstance(event.result, Answered):
                        return None
                    command = event.result.text
            if command is not None:
                return command
            if not self.inbox.is_open(request):
                request = self.user.listen(prompt)

    def close(self) -> None:
        """Free the model, the simulator and the file of facts."""
        if self.model:
            self.model.close()
        self.facts.close()
        self.world.close()

    def _logs(self, folder: Path, started: datetime) -> list[Sink]:
        write(folder / "config.toml", self._used["config.toml"].decode())
        attachments = {
            **self._used,
            **self.knowledge.files(),
            "facts.json": json.dumps(self.facts.beliefs()).encode(),
        }
        if sources := self.grounds.sources:
            attachments["sources.json"] = written(sources, self.knowledge.objects())
        metadata = {
            "requests_before": str(self.inbox.last),
            "in_hand": self._in_hand or "",
            "restless": str(self._restless),
            "seed": str(self.settings.seed),
            "model": self.grounds.model.name if self.grounds.model else "none",
            "thinks": str(bool(self.grounds.model)),
            "policy": self._policy,
            **{name: version(name) for name in PACKAGES},
        }
        from logs.viewer.sink import RerunSink

        return open_sinks(
            lambda: McapSink(folder / "mission.mcap", started, attachments, metadata),
            lambda: RerunSink(folder / "mission.rrd", view=self._view),
        )


def files_used(settings: Settings) -> dict[str, bytes]:
    """What a recording keeps of the settings, as it is now: by name, the files' contents."""
    prompts = {"prompts.toml": settings.prompts.read_bytes()} if settings.prompts else {}
    return {
        "config.toml": settings.to_toml().encode(),
        "home.toml": home_text(settings.home).encode(),
        **prompts,
    }


def refused(why: str) -> Outcome:
    """The outcome of words that are not read."""
    situation = Situation(ending=Ending(MissionStatus.NOT_UNDERSTOOD, why))
    return situation.outcome(mission_time_s=0.0, wall_time_s=0.0, run_dir=None)


def open_sinks(*makers: Callable[[], Sink]) -> list[Sink]:
    """The logs that can be opened; for the others a warning, because the mission goes on."""
    sinks = []
    for make in makers:
        try:
            sinks.append(make())
        except Exception as error:
            why = in_words(error)
            log.warning("a log cannot be opened, the mission goes on without it: %s", why)
    return sinks


def build_injector(
    settings: Settings, home: Home, recorder: Recorder, now: Callable[[], float]
) -> FaultInjector | None:
    """The faults that the settings order; None if there are none.

    Raises:
        InputError: if one of them is none, or not of this home and world.
    """
    faults = parse_faults(settings.fault, home)
    if settings.world == "fake":
        refuse_physical(faults)
    return FaultInjector(faults, recorder, now, settings.seed) if faults else None


def build_simulation(
    settings: Settings,
    home: Home,
    inbox: Inbox,
    recorder: Recorder,
    knowledge: Knowledge,
    gui: bool = False,
    injector: FaultInjector | None = None,
) -> tuple[SimulatedHome, Robot, Camera, Detector]:
    """The world that the settings name, with its robot and the robot's senses."""
    world: SimulatedHome
    robot: Robot
    camera: Camera
    detector: Detector
    if settings.world == "fake":
        world = instant = FakeWorld(home, inbox, recorder)
        robot = FaultyFakeRobot(instant, injector) if injector else FakeRobot(instant)
        camera, detector = FakeCamera(instant), FakeDetector(instant)
        camera = FaultyCamera(camera, injector) if injector else camera
    else:
        from executive.perception.detector import LEARNED, OnnxDetector
        from sim.world import PhysicsWorld

        models = load_objects()
        world = physics = PhysicsWorld(
            home,
            with_scans(models, settings.ycb) if settings.ycb else models,
            inbox,
            recorder,
            seed=settings.seed,
            gui=gui,
            camera_hz=settings.camera_hz,
            injector=injector,
        )
        robot, camera, detector = physics.robot, physics.camera, physics.detector
        if settings.detector != "simulated":
            file = LEARNED if settings.detector == "learned" else Path(settings.detector)
            detector = OnnxDetector(file, knowledge.objects_named)
    if injector:
        detector = FaultyDetector(detector, injector, tuple(home.objects))
    return world, robot, camera, detector


def build_model(settings: Settings, inbox: Inbox) -> LanguageModel | None:
    """The language model that the settings name; it loads while the rest is built."""
    if not settings.uses_llm:
        return None
    if settings.llm.startswith("http"):
        if settings.elicitation == "rank":
            raise InputError(
                "setting 'elicit'", "a server cannot rank places", "use --elicit generate"
            )
        return Server(
            settings.llm,
            inbox,
            model=settings.llm_model,
            api_key=Key.from_environment(),
            n_ctx=settings.context_tokens,
            timeout_s=settings.llm_timeout_s,
            temperature=settings.temperature,
            top_p=settings.top_p,
            max_tokens=settings.max_tokens,
            seed=settings.seed,
            grammar=settings.grammar,
        )
    model = LlamaCpp(
        embedded_model() if settings.llm == "embedded" else Path(settings.llm),
        inbox,
        n_ctx=settings.context_tokens,
        temperature=settings.temperature,
        top_p=settings.top_p,
        max_tokens=settings.max_tokens,
        seed=settings.seed,
        threads=settings.threads,
        gpu_layers=settings.gpu_layers,
        grammar=settings.grammar,
    )
    if settings.elicitation == "rank" and not model.can_rank:
        model.close()
        raise InputError("setting 'elicit'", "this model cannot rank", "use --elicit generate")
    return model


def build_user(
    settings: Settings, inbox: Inbox, where: Callable[[str], str | None], out: TextIO
) -> User:
    """The person that the settings name."""
    match settings.user:
        case "console":
            return Console(inbox, out=out)
        case "oracle":
            return Oracle(inbox, where, settings.seed, out)
        case "none":
            return Nobody(inbox, out)
