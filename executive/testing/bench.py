"""A bench for missions in the instant world, with a scripted person and a scripted model."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field, replace
from functools import cache
from typing import Any

from executive.app.embodiment import Setup
from executive.app.parts import (
    Build,
    Change,
    Parts,
    advised,
    as_they_are,
    build_mission,
    mission_tree,
    parameters_of,
)
from executive.app.simulation import fake
from executive.config import KnowledgeSystem, Settings
from executive.events import Event, Inbox, Started
from executive.interfaces.dialogue import User
from executive.interfaces.knowledge import Facts, PlaceSource
from executive.interfaces.perception import Detector
from executive.interfaces.robot import Robot
from executive.language.grammar import EnglishInterpreter
from executive.perception.pipeline import CameraPerception
from executive.records import Record, Tick, Verified
from executive.situation import Situation
from executive.types.goals import Goal
from executive.types.outcome import Outcome
from executive.user import Oracle, Scripted
from kb.llm.scripted import Scripted as ScriptedModel
from kb.ontology.ontology import Ontology
from sim.fake import FakeCamera, FakeWorld
from sim.home.home import Home
from sim.home.home_file import load_home
from sim.home.validation import with_placement
from trees.context import NoFacts


@cache
def four_rooms() -> Home:
    """The packaged home, loaded once."""
    return load_home("four_rooms")


@cache
def ontology(defaults: bool) -> Ontology:
    """What is known in it, with default locations or without."""
    return Ontology(four_rooms().places(), defaults=defaults)


def knowledge_system(llm: bool, remembers: bool) -> KnowledgeSystem:
    """Which of the paper's systems this is."""
    if not llm:
        return KnowledgeSystem.OKB
    return KnowledgeSystem.OKB_LLM_MEM if remembers else KnowledgeSystem.OKB_LLM


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
    search: str = "paper",
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
    detector: Callable[[FakeWorld], Detector] | None = None,
    change: Change = as_they_are,
    build: Build = mission_tree,
) -> Run:
    """Run one mission in the instant world.

    Args:
        words: the command.
        answers: what the person answers, one after the other (None: nothing); without, the person
            is the always-right oracle.
        replies: what the model replies, one after the other.
        llm: whether there is a model.
        remembers: whether the model is given the dialogue so far, as in the paper's third system.
        defaults: whether the ontology knows default locations.
        elicit: `rank` or `generate`.
        search: `paper`: where the robot looks and asks is the same in every home; `plan`: it goes
            by the ways, too, as missions do by default.
        place: where things are, if not where the home file has them.
        fault: says of each goal of the robot why it fails, or None.
        mishaps: what `--fault` orders of the world, as in `moved=mug:desk@1`.
        seed: of what is left to chance.
        during: is called at the start of every goal of the robot, and may post events.
        parameters: limits of patience and effort that are not the usual ones.
        person: makes another person.
        model: makes another scripted model.
        first: events that are posted before the mission starts.
        notebook: keeps the records; without, a new one does.
        facts: a memory; without, nothing is remembered.
        sources: who else knows where things are.
        detector: makes another detector.
        change: puts in other parts.
        build: makes the tree.
    """
    inbox, notebook, situation = Inbox(), notebook or Notebook(), Situation()
    settings = Settings(
        world="fake",
        knowledge=knowledge_system(llm, remembers),
        defaults=defaults,
        elicit=elicit,
        search=search,
        fault=tuple(mishaps),
        seed=seed,
    )
    home = with_placement(four_rooms(), place or {})
    knowledge = ontology(defaults)
    body = fake(Setup(settings, home, inbox, notebook, knowledge))
    world = body.truth
    assert isinstance(world, FakeWorld)
    world.fault = fault
    goals = _noted(body.robot, lambda goal: during(goal, inbox))
    user = person(inbox) if person else _who_answers(answers, inbox, world)
    thinker = None
    if llm:
        thinker = model(inbox) if model else ScriptedModel(replies, inbox)
    perception = body.perception
    if detector:
        perception = CameraPerception(FakeCamera(world), detector(world), inbox, notebook)
    parts = Parts(
        settings=settings,
        home=home,
        inbox=inbox,
        clock=body.clock,
        recorder=notebook,
        robot=body.robot,
        perception=perception,
        user=user,
        knowledge=knowledge,
        model=thinker,
        facts=facts or NoFacts(),
        sources=tuple(sources),
        interpreter=EnglishInterpreter(knowledge.names()),
        in_map=body.in_map,
        parameters=replace(parameters_of(settings), **(parameters or {})),
    )
    executive = build_mission(change(advised(parts)), situation, build)
    for event in (*first, Started(words)):
        inbox.post(event)
    executive.run()
    outcome = situation.outcome(mission_time_s=body.clock.now(), wall_time_s=0.0, run_dir=None)
    return Run(outcome, world, user, thinker, notebook, goals, inbox, situation)


def _noted(robot: Robot, during: Callable[[Goal], None]) -> list[Goal]:
    """The goals that the robot is given from now on; `during` is called when each has begun."""
    goals: list[Goal] = []
    start = robot.start

    def start_and_note(goal: Goal) -> int:
        goals.append(goal)
        request = start(goal)
        during(goal)
        return request

    robot.start = start_and_note  # type: ignore[method-assign]
    return goals


def _who_answers(answers: Iterable[str | None] | None, inbox: Inbox, world: FakeWorld) -> User:
    """Who gives these answers; without any, the oracle."""
    if answers is None:
        return Oracle(inbox, world.resting_place)
    return Scripted(inbox, answers)
