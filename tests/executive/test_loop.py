"""The executive ticks on events and deadlines only, stops at any moment, and repeats itself."""

import threading
import time
from collections.abc import Callable

import pytest
from patience import PATIENCE_S, until_still

from executive.clock import SimulatedClock
from executive.errors import ExecutiveError
from executive.events import Inbox, StopRequested
from executive.loop import Executive
from executive.pending import Pending
from executive.records import EventTaken, Note, Tick, TreeShape
from executive.situation import Situation
from executive.testing.bench import Notebook, run_mission
from executive.types.dialogue import Question
from executive.types.goals import DriveTo, Goal, Halt, LookAt, Pick, PutDown
from executive.types.knowledge import Source
from executive.types.llm import RankRequest, Usage
from executive.types.outcome import MissionStatus
from executive.types.results import Answered, Scored
from kb.llm.scripted import Scripted as ScriptedModel
from sim.fake import FakeRobot, FakeWorld
from trees.nodes import Step
from trees.tree import MissionTree


class SlowPerson:
    """Answers from another thread, like a real person, when told to."""

    def __init__(self, inbox: Inbox) -> None:
        self.inbox = inbox
        self.asked = threading.Event()
        self.request = 0

    def ask(self, question: Question) -> int:
        self.request = self.inbox.open(real=True)
        self.asked.set()
        return self.request

    def answer(self, text: str) -> None:
        self.inbox.end(self.request, Answered(text))

    def cancel(self, request: int) -> None:
        self.inbox.drop(request)

    def tell(self, text: str) -> None: ...


class SlowModel(ScriptedModel):
    """Ranks in another thread, like a real model, when told to."""

    inbox: Inbox
    asked: threading.Event

    def rank(self, request: RankRequest) -> int:
        self.scored = Scored(request, tuple(range(len(request.options))), Usage())
        self.request = self.inbox.open(real=True)
        self.asked.set()
        return self.request

    def answer(self) -> None:
        self.inbox.end(self.request, self.scored)


def ticks_while(
    asked: threading.Event, notebook: Notebook, answer: Callable[[], None]
) -> list[int]:
    """Count ticks twice, 0.25 s apart, after something was asked; then let it be answered."""
    counts: list[int] = []

    def think() -> None:
        assert asked.wait(PATIENCE_S)
        counts.append(until_still(lambda: len(notebook.all(Tick))))
        time.sleep(0.25)
        counts.append(len(notebook.all(Tick)))
        answer()

    threading.Thread(target=think).start()
    return counts


def test_while_a_person_thinks_there_is_no_tick() -> None:
    notebook, counts = Notebook(), []

    def person(inbox: Inbox) -> SlowPerson:
        person = SlowPerson(inbox)
        counts.append(ticks_while(person.asked, notebook, lambda: person.answer("high table")))
        return person

    run = run_mission("Find a peach.", llm=False, person=person, notebook=notebook)
    [[before, after]] = counts
    assert before == after > 0
    assert run.outcome.status == MissionStatus.DONE
    assert run.outcome.mission_time_s > 0.25, "mission time holds the thinking"
    assert run.outcome.thinking_time_s == 0.0, "which was the person's, not the model's"


def test_while_the_model_thinks_there_is_no_tick() -> None:
    notebook, counts = Notebook(), []

    def model(inbox: Inbox) -> SlowModel:
        model = SlowModel([], inbox)
        model.inbox, model.asked = inbox, threading.Event()
        counts.append(ticks_while(model.asked, notebook, model.answer))
        return model

    began = time.monotonic()
    run = run_mission("Find a peach.", model=model, notebook=notebook)
    [[before, after]] = counts
    assert before == after > 0
    assert run.outcome.source == Source.LLM
    assert 0.25 < run.outcome.thinking_time_s < time.monotonic() - began


def test_every_tick_has_a_cause() -> None:
    run = run_mission("Bring a tennis_ball.")
    assert (
        len(run.ticks) == len({id(tick) for tick in run.ticks}) <= len(run.notebook.all(EventTaken))
    )
    assert all(tick.cause for tick in run.ticks)


@pytest.mark.parametrize("kind", [DriveTo, LookAt, Pick, PutDown])
def test_stop_during_any_action_leaves_the_robot_at_rest(kind: type[Goal]) -> None:
    def stop(goal: Goal, inbox: Inbox) -> None:
        if isinstance(goal, kind):
            inbox.post(StopRequested("the person"))

    run = run_mission("Bring a tennis_ball.", during=stop)
    held = "; I still hold the tennis ball" if run.world.held else ""
    assert (run.outcome.status, run.outcome.reason) == (
        MissionStatus.STOPPED,
        f"stopped by the person{held}",
    )
    assert bool(held) == (kind is PutDown)
    assert isinstance(run.goals[-1], Halt)
    assert not run.world.busy
    assert not run.inbox.awaits_anything


def test_stop_while_the_person_is_asked_withdraws_the_question() -> None:
    def person(inbox: Inbox) -> SlowPerson:
        person = SlowPerson(inbox)

        def stop() -> None:
            assert person.asked.wait(PATIENCE_S)
            inbox.post(StopRequested("Ctrl-C"))

        threading.Thread(target=stop).start()
        return person

    run = run_mission("Find a peach.", llm=False, person=person)
    assert run.outcome.status == MissionStatus.STOPPED
    assert not run.inbox.awaits_anything


def test_stop_before_the_first_tick_is_heard() -> None:
    run = run_mission("Find a peach.", first=[StopRequested("SIGTERM")])
    assert (run.outcome.status, len(run.ticks)) == (MissionStatus.STOPPED, 0)


def test_pre_emption_is_seen_in_the_log() -> None:
    run = run_mission("Find an apple.", defaults=False, replies=[None])
    path = "mission/serve/search/look where it may be/which places/llm ranks places"
    history = [s.status for tick in run.ticks for s in tick.nodes if s.path == path]
    assert history[-1] in ("FAILURE", "INVALID")
    assert "RUNNING" in history


def test_same_seed_and_answers_give_the_same_ticks_and_times() -> None:
    def one() -> list[object]:
        run = run_mission("Find a peach.", answers=["desk", "high table"], llm=False)
        times: list[object] = [run.outcome.mission_time_s]
        return times + [(t.number, t.cause, t.tip, t.nodes, t.situation) for t in run.ticks]

    assert one() == one()


def test_a_goal_that_never_ends_is_given_up() -> None:
    run = run_mission(
        "Take a hammer.",
        parameters={"action_s": 0.1},
        answers=[],
    )
    assert run.outcome.status == MissionStatus.NOT_DONE
    assert "took longer than 0.1 s" in run.outcome.reason


def executive_of(update: Callable[[], None]) -> tuple[Executive, Situation, Notebook]:
    from executive.testing.bench import four_rooms

    class Faulty(Step):
        def __init__(self) -> None:
            super(Step, self).__init__("faulty")

        def update(self):  # type: ignore[no-untyped-def]
            return update()

    inbox, notebook, situation = Inbox(), Notebook(), Situation()
    world = FakeWorld(four_rooms(), inbox, notebook)
    executive = Executive(
        MissionTree(Faulty()),
        situation,
        pending=Pending(),
        inbox=inbox,
        clock=SimulatedClock(inbox, world),
        robot=FakeRobot(world),
        recorder=notebook,
    )
    return executive, situation, notebook


def test_a_behaviour_that_raises_ends_the_mission_with_the_traceback_in_the_log() -> None:
    def broken() -> None:
        raise ValueError("oops")

    executive, situation, notebook = executive_of(broken)
    executive.run()
    assert situation.ending.reason == "internal error: ValueError: oops"
    assert "Traceback" in notebook.all(Note)[0].text
    assert isinstance(notebook.records[0], TreeShape)


def test_an_error_for_the_person_is_told_as_it_is() -> None:
    def broken() -> None:
        raise ExecutiveError("the model file is broken")

    executive, situation, _ = executive_of(broken)
    executive.run()
    assert situation.ending.reason == "the model file is broken"
