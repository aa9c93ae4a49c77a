"""What may be the thing but is not sure is looked at twice, and not remembered."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace

from executive.testing.bench import Run, run_mission
from executive.types.commands import CommandKind
from executive.types.goals import LookAt
from executive.types.outcome import MissionStatus
from executive.types.perception import Box, Detection, Frame
from kb.facts import FactStore
from sim.fake import FakeDetector, FakeWorld


@dataclass
class Unsure:
    """Sees all that is there, each thing with the confidences given, one after the other."""

    world: FakeWorld
    confidences: Mapping[str, Iterator[float]]
    sees: FakeDetector = field(init=False)

    def __post_init__(self) -> None:
        self.sees = FakeDetector(self.world)

    def detect(self, frame: Frame) -> tuple[Detection, ...]:
        return tuple(
            replace(seen, confidence=next(self.confidences.get(seen.label, iter(())), 1.0))
            for seen in self.sees.detect(frame)
        )


def run(words: str, facts: FactStore | None = None, **confidences: list[float]) -> Run:
    sequences = {name: iter(values) for name, values in confidences.items()}
    return run_mission(
        words,
        llm=False,
        facts=facts,
        answers=["the dining_table"] * 2,
        detector=lambda world: Unsure(world, sequences),
    )


def looks(run: Run) -> list[LookAt]:
    return [goal for goal in run.goals if isinstance(goal, LookAt)]


def test_what_is_sure_at_the_second_look_is_found() -> None:
    mission = run("Find an apple", apple=[0.3, 0.8])
    assert mission.outcome.status == MissionStatus.DONE
    aimed, closer = looks(mission)
    assert aimed == LookAt("dining_table")
    assert closer.place == "dining_table"
    assert closer.point is not None
    assert mission.situation.search.detection
    assert mission.situation.search.detection.confidence == 0.8


def test_what_is_sure_at_once_is_looked_at_once() -> None:
    assert len(looks(run("Find an apple", apple=[0.6]))) == 1


def test_what_stays_doubtful_is_neither_found_nor_said_to_be_elsewhere() -> None:
    facts = FactStore()
    mission = run("Find an apple", facts, apple=[0.3] * 20)
    assert mission.outcome.status == MissionStatus.NOT_DONE
    assert mission.outcome.location is None
    told = {(fact.kind, fact.object) for fact in facts.all()}
    assert ("seen", "apple") not in told
    assert ("missed", "apple") not in told


def test_doubtful_things_on_the_way_are_not_remembered_sure_ones_are() -> None:
    facts = FactStore()
    mission = run("Take an apple", facts, banana=[0.4] * 20)
    assert mission.outcome.kind == CommandKind.TAKE
    assert facts.places_of("cracker_box") == ("dining_table",)
    assert facts.places_of("banana") == ()


def test_a_second_look_that_shows_nothing_counts_as_a_look_in_vain() -> None:
    class Flicker(Unsure):
        def detect(self, frame: Frame) -> tuple[Detection, ...]:
            seen = super().detect(frame)
            return tuple(d for d in seen if d.label != "apple" or d.confidence > 0.2)

    facts = FactStore()
    run_mission(
        "Find an apple",
        llm=False,
        facts=facts,
        answers=["the dining_table", None],
        detector=lambda world: Flicker(world, {"apple": iter([0.3] + [0.1] * 20)}),
    )
    assert ("missed", "apple") in {(fact.kind, fact.object) for fact in facts.all()}


def test_what_is_cut_off_in_the_picture_is_looked_at_straight() -> None:
    class AtTheEdge(FakeDetector):
        def detect(self, frame: Frame) -> tuple[Detection, ...]:
            """The first time, all that is there is at the left edge."""
            shown = tuple(super().detect(frame))
            if frame.number > 0:
                return shown
            return tuple(replace(d, box=Box(0, 50, d.box.width, d.box.height)) for d in shown)

    mission = run_mission("Find an apple", llm=False, detector=AtTheEdge)
    aimed, closer = looks(mission)
    assert mission.outcome.status == MissionStatus.DONE
    assert (aimed.point, closer.place) == (None, aimed.place)
    assert closer.point is not None
    assert mission.situation.search.detection
    assert not mission.situation.search.detection.cut_off
