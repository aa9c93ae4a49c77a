"""What a mission means is declared: no name of a behaviour decides what is told of it."""

from collections.abc import Iterable, Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from outcome_cases import favouring, listing
from sample_mission import STARTED

from executive.campaign.observer import Observed
from executive.records import LlmCall, Record, Tick, TreeShape, Verified
from executive.testing.bench import run_mission
from executive.types.goals import Goal, Pick
from logs.questions.decision import why_text
from logs.questions.why import why
from logs.recorder import Stamp
from logs.recording.reader import Run
from logs.recording.sink import McapSink


def misses(goal: Goal) -> str | None:
    return "missed" if isinstance(goal, Pick) else None


MISSIONS: list[tuple[str, dict[str, Any]]] = [
    ("Bring a power_drill.", {}),
    (
        "Take an aple.",
        {
            "defaults": False,
            "answers": ["yes", "desk"],
            "replies": [favouring("bed", "dining_table")],
            "fault": misses,
            "mishaps": ["moved=apple:desk@20"],
        },
    ),
    (
        "Find an apple.",
        {"defaults": False, "elicit": "generate", "replies": [listing("bed", "dining_table")]},
    ),
]
"""Of the ontology; of the ranking model, and the person when the thing is gone; of a list."""
MARK = "~"


def renamed(record: Record) -> Record:
    """The record of a mission whose behaviours all have other names and other classes."""
    match record:
        case TreeShape(nodes):
            return TreeShape(
                tuple(
                    replace(
                        node,
                        path=marked(node.path),
                        parent=marked(node.parent),
                        name=marked(node.name),
                        class_name="Renamed",
                    )
                    for node in nodes
                )
            )
        case Tick(nodes=nodes, tip=tip):
            states = tuple(replace(node, path=marked(node.path)) for node in nodes)
            return replace(record, nodes=states, tip=marked(tip))
        case _:
            return record


def marked(path: str) -> str:
    return "/".join(name + MARK if name else "" for name in path.split("/"))


def told(folder: Path, records: Iterable[Record]) -> tuple[str, dict[str, float]]:
    """Why the robot did it, and what it spent its time with."""
    folder.mkdir()
    sink, observed = McapSink(folder / "mission.mcap", STARTED, {}, {}), Observed()
    for second, record in enumerate(records):
        observed.write(Stamp(second, 0), record)
        if isinstance(record, TreeShape | Tick | LlmCall | Verified):
            sink.write(Stamp(second, 0), record)
    sink.close()
    return why_text(why(Run(folder))), observed.seconds


@pytest.mark.parametrize(("words", "given"), MISSIONS)
def test_with_other_names_the_same_is_told(
    words: str, given: dict[str, Any], tmp_path: Path
) -> None:
    records = run_mission(words, **given).notebook.records
    text, seconds = told(tmp_path / "as_it_was", records)
    other_text, other_seconds = told(tmp_path / "renamed", map(renamed, records))
    assert MARK in other_text
    assert other_text.replace(MARK, "") == text
    assert other_seconds == seconds


def settled(ticks: list[Tick], shape: TreeShape) -> Iterator[tuple[str, str]]:
    """Whom new candidates are from, and who spoke last when they came up."""
    sources = {node.path: node.source for node in shape.nodes}
    known, earlier = [], dict[str, str]()
    for tick in ticks:
        spoke = [
            sources[node.path]
            for node in tick.nodes
            if node.status == "SUCCESS" != earlier.get(node.path) and sources[node.path]
        ]
        if tick.situation["candidates"] != known:
            known = tick.situation["candidates"]
            yield known[0]["source"], spoke[-1]
        earlier = {node.path: node.status for node in tick.nodes}


@pytest.mark.parametrize(("words", "given"), MISSIONS)
def test_who_says_where_the_thing_may_be_is_who_spoke(words: str, given: dict[str, Any]) -> None:
    run = run_mission(words, **given)
    (shape,) = run.notebook.all(TreeShape)
    told = list(settled(run.ticks, shape))
    assert told
    assert all(source == spoke for source, spoke in told)
