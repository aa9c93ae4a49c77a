"""A bench for missions in the instant world, with a scripted person and a scripted model."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from functools import cache
from typing import Any

from executive.app.parts import near_person
from executive.clock import SimulatedClock
from executive.events import Event, Inbox, Started
from executive.interfaces import Detector, Facts, PlaceSource, User
from executive.language.grammar import EnglishInterpreter
from executive.loop import Executive
from executive.perception.pipeline import CameraPerception
from executive.records import Record, Tick, Verified
from executive.situation import Situation
from executive.types import Goal, Outcome
from executive.user import Oracle, Scripted
from kb.advice.advisor import advise
from kb.llm.scripted import Scripted as ScriptedModel
from kb.ontology.ontology import Ontology
from sim.fake import FakeCamera, FakeDetector, FakeRobot, FakeWorld
from sim.faults.fake import FaultyFakeRobot
from sim.faults.injector import FaultInjector, FaultyCamera, FaultyDetector
from sim.faults.orders import parse_faults
from sim.home.home import Home, load_home
from trees.context import MissionContext, NoFacts, Parameters
from trees.mission import mission
from trees.tree import MissionTree


@cache
def four_rooms() -> Home:
    """The packaged home, loaded once."""
    return load_home("four_rooms")


@cache
def ontology(defaults: bool) -> Ontology:
    """What is known in it, with default locations or without."""
    return Ontology(four_rooms().places(), defaults=defaults)


@dataclass
class Notebook:
    """A Recorder that keeps everything."""

    records: list[Record] = field(default_factory=list)

    def record(self, record: Record) -> None:
        """Keep it."""
        self.records.append(record)

    def all(self, kind: type) -> list[Any]:
        """All records of this type, in their order."""
        return [record for record in self.records if isinstance(record, kind)]


@dataclass
class Run:
    """One mission that was run, and everybody who took part."""

    outcome: Outcome
    world: FakeWorld
    user: User
    model: ScriptedModel | None
    notebook: Notebook
    goals: list[Goal]
    inbox: Inbox
    situation: Situation

    @property
    def ticks(self) -> list[Tick]:
        """Every tick of the tree."""
        return self.notebook.all(Tick)

    @property
    def dropped(self) -> list[str]:
        """Names in the model's replies that were not let through."""
        return [name for verdict in self.notebook.all(Verified) for name in verdict.dropped]


def run_mission(
    words: str,
    *,
    answers: Iterable[str | None] | None = None,
    replies: Iterable[Any] = (),
    llm: bool = True,
    remembers: bool = True,
    defaults: bool = True,
    elicit: str = "rank",
    place: dict[str, str] | None = None,
    fault: Callable[[Goal], str | None] = lambda goal: None,
    mishaps: Iterable[str] = (),
    seed: int = 0,
    during: Callable[[Goal, Inbox], None] = lambda goal, inbox: None,
    parameters: dict[str, Any] | None = None,
    person: Callable[[Inbox], User] | None = None,
    model: Callable[[Inbox], ScriptedModel] | None = None,
    first: Iterable[Event] = (),
    notebook: Notebook | None = None,
    facts: Facts | None = None,
    sources: Iterable[PlaceSource] = (),
    detector: Callable[[FakeWorld], Detector] = FakeDetector,
) -> Run:
    """Run one mission; without `answers` the person is the always-right oracle.

    `mishaps` are ordered as with `--fault`. `during` is called at the start of every goal of the
    robot, and may post events; `first` are posted before the mission starts.
    """
    inbox, notebook, situation = Inbox(), notebook or Notebook(), Situation()
    home = four_rooms().with_placement(place or {})
    world = FakeWorld(home, inbox, notebook, fault)
    clock = SimulatedClock(inbox, world)
    camera, goals = FakeCamera(world), []
    recogniser = detector(world)
    robot = FakeRobot(world)
    if mishaps:
        faults = FaultInjector(parse_faults(mishaps, home), notebook, clock.now, seed)
        robot = FaultyFakeRobot(world, faults)
        camera = FaultyCamera(camera, faults)  # type: ignore[assignment]
        recogniser = FaultyDetector(recogniser, faults, tuple(home.objects))
    start = robot.start

    def start_and_note(goal: Goal) -> int:
        goals.append(goal)
        request = start(goal)
        during(goal, inbox)
        return request

    robot.start = start_and_note  # type: ignore[method-assign]
    user: User
    if person:
        user = person(inbox)
    elif answers is None:
        user = Oracle(inbox, world.resting_place)
    else:
        user = Scripted(inbox, answers)
    thinker = None
    if llm:
        thinker = model(inbox) if model else ScriptedModel(replies, inbox)
    knowledge = ontology(defaults)
    context = MissionContext(
        situation=situation,
        clock=clock,
        recorder=notebook,
        interpreter=EnglishInterpreter(),
        knowledge=knowledge,
        robot=robot,
        perception=CameraPerception(camera, recogniser, inbox, notebook),
        user=user,
        model=thinker,
        advice=advise(knowledge, thinker, remembers=remembers) if thinker else None,
        parameters=Parameters(elicit=elicit, **(parameters or {})),
        facts=facts or NoFacts(),
        sources=tuple(sources),
        near_person=near_person(home),
    )
    executive = Executive(
        MissionTree(mission(context)),
        situation,
        pending=context.pending,
        inbox=inbox,
        clock=clock,
        robot=robot,
        recorder=notebook,
    )
    for event in (*first, Started(words)):
        inbox.post(event)
    executive.run()
    outcome = situation.outcome(mission_time_s=clock.now(), wall_time_s=0.0, run_dir=None)
    return Run(outcome, world, user, thinker, notebook, goals, inbox, situation)
