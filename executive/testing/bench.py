"""A test bench: runs missions in the instant world, with a scripted person and model."""

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
    """The ontology of the packaged home, with or without default locations."""
    return Ontology(four_rooms().places(), defaults=defaults)


def knowledge_system(llm: bool, remembers: bool) -> KnowledgeSystem:
    """The paper's system with these properties."""
    if not llm:
        return KnowledgeSystem.OKB
    return KnowledgeSystem.OKB_LLM_MEM if remembers else KnowledgeSystem.OKB_LLM


@dataclass
class Notebook:
    """A Recorder that keeps all records in memory."""

    records: list[Record] = field(default_factory=list)

    def record(self, record: Record) -> None:
        """Keep a record."""
        self.records.append(record)

    def all(self, kind: type) -> list[Any]:
        """All records of this type, in order."""
        return [record for record in self.records if isinstance(record, kind)]


@dataclass
class Run:
    """One mission that was run, with its collaborators and records."""

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
        """Names in the model's replies that the verification dropped."""
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
        answers: the person's answers, in order (None: no answer comes); if not given, the person
            is the oracle, who is always right.
        replies: the model's replies, in order.
        llm: whether there is a model.
        remembers: whether prompts contain the dialogue so far, as in the paper's third system.
        defaults: whether the ontology has default locations.
        elicit: `rank` or `generate`.
        search: `paper`: looks and questions do not depend on distances; `plan`: they do, as in
            missions by default.
        place: where things are, if not where the home file has them.
        fault: returns why a goal of the robot fails; None if it does not.
        mishaps: faults of the world, as given to `--fault`: `moved=mug:desk@1`.
        seed: seed of all random choices.
        during: called at the start of every goal of the robot; may post events.
        parameters: parameters of the behaviours that differ from the usual ones.
        person: makes another person.
        model: makes another scripted model.
        first: events to post before the mission starts.
        notebook: keeps the records; if not given, a new one does.
        facts: a memory; if not given, nothing is remembered.
        sources: further knowledge sources.
        detector: makes another detector.
        change: replaces parts.
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
    goals = _note_goals(body.robot, lambda goal: during(goal, inbox))
    user = person(inbox) if person else _answering_person(answers, inbox, world)
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


def _note_goals(robot: Robot, during: Callable[[Goal], None]) -> list[Goal]:
    """The list of goals that the robot gets from now on; calls `during` after each start."""
    goals: list[Goal] = []
    start = robot.start

    def start_and_note(goal: Goal) -> int:
        goals.append(goal)
        request = start(goal)
        during(goal)
        return request

    robot.start = start_and_note  # type: ignore[method-assign]
    return goals


def _answering_person(answers: Iterable[str | None] | None, inbox: Inbox, world: FakeWorld) -> User:
    """The person: scripted with these answers, or the oracle if None are given."""
    if answers is None:
        return Oracle(inbox, world.resting_place)
    return Scripted(inbox, answers)
