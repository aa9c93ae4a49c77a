"""A tiny mission's records, made by hand: a robot is asked for a sugar box and brings it."""

from collections.abc import Iterator
from datetime import UTC, datetime

import numpy as np

from executive.events import Ended, Started
from executive.records import (
    Entity,
    EventTaken,
    Finished,
    Intervention,
    LlmCall,
    Mishap,
    NodeShape,
    NodeState,
    Note,
    Picture,
    Planned,
    PlannedPath,
    Recalled,
    Record,
    Scene,
    Seen,
    Shape,
    SourceAnswer,
    Tick,
    Transform,
    Transforms,
    TreeShape,
    Utterance,
    Verified,
    WaysTold,
)
from executive.types.commands import CommandKind
from executive.types.geometry import Pose
from executive.types.knowledge import Candidate, Source
from executive.types.llm import ChatRequest, Message, Precedent, RankRequest, Usage
from executive.types.outcome import MissionStatus, Outcome
from executive.types.perception import Box, Detection, Frame, Intrinsics
from executive.types.results import Replied, Scored, Succeeded

STARTED = datetime(2024, 5, 13, 9, 30, tzinfo=UTC)
WORDS = "Bring a sugar_box"
CANDIDATES = (
    Candidate("cupboard", Source.LLM, 0.6),
    Candidate("dining_table", Source.LLM, 0.3),
    Candidate("desk", Source.LLM, 0.1),
)

TREE = TreeShape(
    (
        NodeShape("mission", "", "mission", "sequence", "Sequence"),
        NodeShape("mission/which places", "mission", "which places", "selector", "Selector"),
        NodeShape(
            "mission/which places/ask",
            "mission/which places",
            "ask",
            "behaviour",
            "Ask",
            source="user",
            activity="asking",
        ),
        NodeShape("mission/drive", "mission", "drive", "behaviour", "Visit", stage=True),
        NodeShape("mission/see", "mission", "see", "behaviour", "SeeTarget"),
    )
)


def tick(number: int, tip: str, *statuses: str, candidates: tuple[Candidate, ...] = ()) -> Tick:
    """A tick after which the nodes have these statuses, in the tree's order."""
    return Tick(
        number=number,
        cause="Started" if number == 0 else "Succeeded",
        tip=tip,
        nodes=tuple(
            NodeState(node.path, status, "on the way" if status == "RUNNING" else "")
            for node, status in zip(TREE.nodes, statuses, strict=True)
        ),
        situation={
            "object": "sugar_box",
            "candidates": [
                {"place": c.place, "source": c.source, "probability": c.probability}
                for c in candidates
            ],
            "candidate": {"place": candidates[0].place} if candidates else None,
            "visited": [],
        },
        duration_s=0.0004,
    )


def usage() -> Usage:
    """What a call cost."""
    return Usage(
        model="SmolLM2-135M-Instruct",
        input_tokens=312,
        evaluated_tokens=40,
        prepared_tokens=250,
        prepared_s=1.2,
        output_tokens=21,
        first_token_s=0.2,
        total_s=0.7,
        parameters={"temperature": 0.0, "seed": 7, "grammar": "json"},
    )


def chat_call() -> LlmCall:
    """The model was asked for a list and wrote one."""
    request = ChatRequest(
        "general_pos",
        (
            Message("system", "You help a robot in a home with a kitchen and a study."),
            Message("user", "I am searching for sugar_box. Which places are most probable?"),
        ),
        {"type": "object"},
    )
    return LlmCall(Replied(request, '{"places": ["cupboard", "spice rack"]}', usage()))


def rank_call() -> LlmCall:
    """The model was asked to score three places."""
    request = RankRequest(
        "rank",
        (Message("user", "Where is the sugar_box?"),),
        (Message("user", "Where is the thing?"),),
        ("in the cupboard in the kitchen", "on the dining table", "on the desk in the study"),
        ("cupboard", "dining_table", "desk"),
        (Precedent((Message("user", "Where is the flour?"),), ("cupboard", "desk"), "food"),),
        "food",
    )
    return LlmCall(Scored(request, (2.5, 1.8, 0.7), usage()))


def frame(number: int = 0) -> Frame:
    """A picture of an orange box on a grey floor, looking ahead from 1 m above `x` = 1 m."""
    color = np.full((120, 160, 3), 90, np.uint8)
    color[50:80, 70:100] = (240, 170, 60)
    return Frame(
        number=number,
        color=color,
        depth=np.full((120, 160), 2.0, np.float32),
        intrinsics=Intrinsics(160, 120, 140.0, 140.0, 80.0, 60.0),
        pose=Pose((1.0, 0.0, 1.0), (-0.5, 0.5, -0.5, 0.5)),
    )


def detection() -> Detection:
    """The box in that picture."""
    mask = np.ones((30, 30), np.bool_)
    return Detection("sugar_box", 0.91, Box(70, 50, 30, 30), mask, cut_off=True)


def scene() -> Scene:
    """A floor with a cupboard, and a robot of two bodies."""
    return Scene(
        (
            Entity(
                "home",
                "map",
                (
                    Shape("box", (6.0, 4.0, 0.02), (0.8, 0.78, 0.74, 1.0)),
                    Shape("box", (0.5, 1.2, 1.0), (0.6, 0.4, 0.2, 1.0), Pose((2.5, 0.0, 0.5))),
                ),
            ),
            Entity(
                "robot",
                "base_link",
                (
                    Shape("cylinder", (0.5, 0.5, 0.3), (0.9, 0.9, 0.95, 1.0), Pose((0, 0, 0.15))),
                    Shape("sphere", (0.3, 0.3, 0.3), (0.2, 0.3, 0.8, 1.0), Pose((0, 0, 0.9))),
                ),
            ),
        )
    )


def robot_at(x: float) -> Transforms:
    """The robot has moved along x."""
    return Transforms((Transform("map", "base_link", Pose((x, 0.0, 0.0))),))


def outcome() -> Outcome:
    """It was brought."""
    return Outcome(
        command=WORDS,
        kind=CommandKind.BRING,
        target="sugar_box",
        object="sugar_box",
        status=MissionStatus.DONE,
        reason="",
        source=Source.LLM,
        location="cupboard",
        inquiries=0,
        visited=("cupboard",),
        llm_calls=2,
        candidates=CANDIDATES,
        mission_time_s=6.5,
        thinking_time_s=0.7,
        wall_time_s=3.2,
        run_dir=None,
    )


def mission() -> Iterator[tuple[float, Record]]:
    """All records of the mission with their times (s)."""
    yield 0.0, TREE
    yield 0.0, scene()
    yield 0.0, robot_at(-2.0)
    yield 0.0, Utterance("person", WORDS)
    yield 0.0, EventTaken(Started(WORDS))
    running = "RUNNING"
    yield 0.0, tick(0, "mission/which places/ask", running, running, running, "INVALID", "INVALID")
    yield 0.5, rank_call()
    yield 1.0, chat_call()
    yield 1.0, Verified("general_pos", ("cupboard",), (), ("spice rack",))
    yield 1.5, Recalled("sugar_box", ("memory",), (0.8,), ("counter",), ("memory",), (1.0,))
    yield 1.5, SourceAnswer("calendar", "sugar_box", ("cupboard",))
    yield 1.6, WaysTold("person", ("cupboard", "table"), (4.5, -1.0))
    yield (
        1.7,
        Planned(
            thing="sugar_box",
            decision="look",
            order=("cupboard",),
            ask_after=1,
            seconds=5.0,
            visits=1.0,
            questions=0.1,
            cost=11.0,
            may_ask=True,
            asking_cost=64.5,
            may_look=True,
            looking_cost=11.0,
            places=("cupboard", "table"),
            probabilities=(0.9, 0.05),
            says=("calendar 0.90", "anywhere 0.05"),
            elsewhere=0.05,
            text="I look at cupboard 0.90: asking would cost 64 s and looking on 11 s.",
            away=(5.0, -1.0),
        ),
    )
    done = "SUCCESS"
    yield (
        2.0,
        tick(1, "mission/drive", running, done, done, running, "INVALID", candidates=CANDIDATES),
    )
    yield 2.0, PlannedPath(((-2.0, 0.0, 0.0), (0.0, 0.5, 0.0), (1.0, 0.0, 0.0)))
    for step in range(1, 7):
        yield 2.0 + step / 2, robot_at(-2.0 + step / 2)
    yield 5.0, EventTaken(Ended(3, Succeeded()))
    yield 6.0, Picture(frame())
    yield 6.0, Seen(0, (detection(),))
    yield 6.0, tick(2, "mission/see", done, done, done, done, done, candidates=CANDIDATES)
    yield 6.2, Mishap("moved=sugar_box:desk@6", "the sugar_box is taken to desk")
    yield 6.3, Intervention("Anna", "words", "Here it is.", "Here is the sugar_box.")
    yield 6.5, Utterance("robot", "Here is the sugar_box.")
    yield 6.5, Note("info", "the sugar_box was in the cupboard")
    yield 6.5, Finished(outcome())
