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

from executive.clock import SimulatedClock
from executive.command import EnglishInterpreter
from executive.config import Settings
from executive.errors import InputError
from executive.events import Ended, Inbox, Started, StopRequested
from executive.interfaces import (
    Advisor,
    Camera,
    Detector,
    Knowledge,
    LanguageModel,
    Recorder,
    Robot,
    SimulatedHome,
    User,
)
from executive.loop import Executive
from executive.perception import Eyes
from executive.records import Finished
from executive.rules import rules
from executive.runs import new_folder, to_json, write
from executive.situation import Situation
from executive.types import Answered, Outcome, Vector3
from executive.user import Console, Nobody, Oracle
from kb.advisor import PlaceAdvisor
from kb.facts import FactStore
from kb.key import Key
from kb.llama import LlamaCpp, embedded_model
from kb.ontology import Ontology
from kb.prompts import Prompts
from kb.server import Server
from logs.mcap_sink import McapSink
from logs.recorder import FanOut, Sink
from sim.fake import FakeCamera, FakeDetector, FakeRobot, FakeWorld
from sim.faults import parse_faults, refuse_physical
from sim.faulty_fake import FaultyFakeRobot
from sim.home import Home, home_text, load_home
from sim.mishaps import FaultyCamera, FaultyDetector, Mishaps
from sim.objects import load_objects
from sim.ycb import with_scans
from trees.mission import mission
from trees.team import Team
from trees.tree import MissionTree

log = logging.getLogger(__name__)

ANYTHING = "thing"
"""What the model prepares to be asked for."""

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
    ) -> None:
        """Build everything; `user` and `model` replace what the settings name.

        The robot's words go to `out` (default: standard error). Missions that are not `recorded`
        leave no folder; `sinks` are told everything in either case, and closed after each mission.

        Raises:
            ExecutiveError: if a setting, the home, the ontology or the model file is wrong.
        """
        self.settings = settings
        self._view = view
        self._recorded = recorded
        self._sinks = tuple(sinks)
        self.inbox = inbox or Inbox()
        self.home = load_home(settings.home).with_placement(settings.place)
        prompts = Prompts.load(settings.prompts)
        self.model = model or build_model(settings, self.inbox)
        self.knowledge = Ontology(
            self.home.places(),
            defaults=settings.defaults,
            files=settings.kb,
            person=settings.person,
        )
        self.facts = FactStore(settings.memory, learns=settings.learn)
        self.advisor = build_advisor(settings, self.knowledge, self.model, prompts, self.facts)
        self.recorder = FanOut(lambda: self.clock.now(), live=view)
        self.mishaps = build_mishaps(settings, self.home, self.recorder, lambda: self.clock.now())
        self.world, self.robot, camera, detector = build_simulation(
            settings, self.home, self.inbox, self.recorder, self.knowledge, gui, self.mishaps
        )
        self.clock = SimulatedClock(self.inbox, self.world)
        self.eyes = Eyes(camera, detector, self.inbox, self.recorder)
        self.user = user or build_user(
            settings, self.inbox, self.world.resting_place, out or sys.stderr
        )
        self._in_hand: str | None = None
        self.ticks = 0
        """How often the tree of the last mission was ticked."""
        self.folder: Path | None = None
        """Where the last mission left its recording."""

    def run(self, words: str) -> Outcome:
        """One mission, from words to its outcome, with its own run folder if it is recorded."""
        began = time.monotonic()
        started = datetime.now(UTC)
        folder = new_folder(self.settings.runs, started, words) if self._recorded else None
        self.folder = folder
        self._in_hand = self._in_hand if self.robot.holding else None
        self.clock.restart()
        logs = self._logs(folder, started) if folder else []
        self.recorder.open([*logs, *self._sinks], started)
        if self.mishaps:
            self.mishaps.begin()
        self.world.describe()
        situation = Situation(words=words, in_hand=self._in_hand)
        tree = MissionTree(mission(self._team(situation)))
        executive = Executive(
            tree,
            situation,
            inbox=self.inbox,
            clock=self.clock,
            robot=self.robot,
            recorder=self.recorder,
        )
        self.inbox.post(Started(words))
        try:
            executive.run()
            self.ticks = executive.ticks
            self._in_hand = situation.in_hand
            outcome = situation.outcome(
                mission_time_s=self.clock.now(),
                wall_time_s=time.monotonic() - began,
                run_dir=str(folder) if folder else None,
            )
            self.recorder.record(Finished(outcome))
        finally:
            self.recorder.close()
        if folder:
            write(folder / "outcome.json", to_json(outcome) + "\n")
        return outcome

    def next_command(self) -> str | None:
        """Wait for the person to type a command; None at the end of input.

        Raises:
            KeyboardInterrupt: if the person says stop instead.
        """
        assert isinstance(self.user, Console)
        request = self.user.listen()
        while True:
            self.clock.wait(None)
            events = self.inbox.take_all()
            if any(isinstance(event, StopRequested) for event in events):
                raise KeyboardInterrupt
            for event in events:
                if isinstance(event, Ended) and event.request == request:
                    answer = event.result
                    return answer.text if isinstance(answer, Answered) else None

    def close(self) -> None:
        """Free the model, the simulator and the file of facts."""
        if self.model:
            self.model.close()
        self.facts.close()
        self.world.close()

    def _team(self, situation: Situation) -> Team:
        settings = self.settings
        return Team(
            situation=situation,
            clock=self.clock,
            recorder=self.recorder,
            interpreter=EnglishInterpreter(),
            knowledge=self.knowledge,
            robot=self.robot,
            eyes=self.eyes,
            user=self.user,
            model=self.model,
            advisor=self.advisor,
            rules=rules(settings),
            facts=self.facts,
            place_at=self._place_at,
        )

    def _place_at(self, point: Vector3) -> str | None:
        """Where things are by the robot's map; in the instant world they have no true position."""
        return None if self.settings.world == "fake" else furniture_at(self.home, point)

    def _logs(self, folder: Path, started: datetime) -> list[Sink]:
        config = self.settings.to_toml()
        write(folder / "config.toml", config)
        attachments = {
            "config.toml": config.encode(),
            "home.toml": home_text(self.settings.home).encode(),
            **self.knowledge.files(),
            "facts.json": json.dumps(self.facts.beliefs()).encode(),
        }
        metadata = {
            "requests_before": str(self.inbox.last),
            "in_hand": self._in_hand or "",
            "seed": str(self.settings.seed),
            "model": self.model.name if self.model else "none",
            **{name: version(name) for name in PACKAGES},
        }
        from logs.rerun_sink import RerunSink

        return working(
            lambda: McapSink(folder / "mission.mcap", started, attachments, metadata),
            lambda: RerunSink(folder / "mission.rrd", view=self._view),
        )


def furniture_at(home: Home, point: Vector3) -> str | None:
    """The furniture that has this point of `map` (metres) above its outline; None if none has."""
    pieces = (*home.furniture, home.delivery)
    return next((piece.name for piece in pieces if piece.is_below(point)), None)


def working(*makers: Callable[[], Sink]) -> list[Sink]:
    """The logs that can be opened; for the others a warning, because the mission goes on."""
    sinks = []
    for make in makers:
        try:
            sinks.append(make())
        except (OSError, RuntimeError) as error:
            log.warning("a log cannot be opened, the mission goes on without it: %s", error)
    return sinks


def build_mishaps(
    settings: Settings, home: Home, recorder: Recorder, now: Callable[[], float]
) -> Mishaps | None:
    """The faults that the settings order; None if there are none.

    Raises:
        InputError: if one of them is none, or not of this home and world.
    """
    faults = parse_faults(settings.fault, home)
    if settings.world == "fake":
        refuse_physical(faults)
    return Mishaps(faults, recorder, now, settings.seed) if faults else None


def build_simulation(
    settings: Settings,
    home: Home,
    inbox: Inbox,
    recorder: Recorder,
    knowledge: Knowledge,
    gui: bool = False,
    mishaps: Mishaps | None = None,
) -> tuple[SimulatedHome, Robot, Camera, Detector]:
    """The world that the settings name, with its robot and the robot's senses."""
    world: SimulatedHome
    robot: Robot
    camera: Camera
    detector: Detector
    if settings.world == "fake":
        world = instant = FakeWorld(home, inbox, recorder)
        robot = FaultyFakeRobot(instant, mishaps) if mishaps else FakeRobot(instant)
        camera, detector = FakeCamera(instant), FakeDetector(instant)
        camera = FaultyCamera(camera, mishaps) if mishaps else camera
    else:
        from executive.detector import LEARNED, OnnxDetector
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
            mishaps=mishaps,
        )
        robot, camera, detector = physics.robot, physics.camera, physics.detector
        if settings.detector != "simulated":
            file = LEARNED if settings.detector == "learned" else Path(settings.detector)
            detector = OnnxDetector(file, knowledge.objects_named)
    if mishaps:
        detector = FaultyDetector(detector, mishaps, tuple(home.objects))
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


def build_advisor(
    settings: Settings,
    knowledge: Ontology,
    model: LanguageModel | None,
    prompts: Prompts,
    facts: FactStore,
) -> Advisor | None:
    """Who puts questions to the model, which begins to prepare for them; None without a model."""
    if model is None:
        return None
    advisor = PlaceAdvisor(
        knowledge,
        model,
        remembers=settings.remembers,
        top=settings.top,
        prompts=prompts,
        facts=facts,
    )
    ask = advisor.ranking if settings.elicitation == "rank" else advisor.inquiry
    model.prepare(ask(ANYTHING, ()))
    return advisor


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
