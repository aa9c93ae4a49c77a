"""What became of each place, and how rerun draws it."""

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import rerun as rr
from rerun.chunk import RrdReader
from sample_mission import mission

from executive.records import Entity, Planned, Shape
from executive.types.geometry import Pose
from logs.viewer.candidates import COLORS, CandidatesView
from logs.viewer.states import State, states

GREY = (0.5, 0.5, 0.5, 1.0)
FURNITURE = (
    Entity("desk", "map", (Shape("box", (1.0, 0.5, 0.7), GREY, Pose((2.0, 1.0, 0.35))),)),
    Entity("shelf", "map", (Shape("box", (0.4, 0.4, 1.8), GREY, Pose((0.0, 3.0, 0.9))),)),
    Entity("mug", "mug", (Shape("box", (0.1, 0.1, 0.1), GREY),)),
)


def situation(*candidates: str, **known: Any) -> dict[str, Any]:
    return {"object": "mug", "candidates": [{"place": place} for place in candidates], **known}


def test_a_place_is_open_then_current_then_empty_or_found() -> None:
    assert states(situation("desk", "shelf")) == {"desk": State.OPEN, "shelf": State.OPEN}
    looking = situation("desk", "shelf", visited=["desk"], candidate={"place": "shelf"})
    assert states(looking) == {"desk": State.EMPTY, "shelf": State.CURRENT}
    assert states(looking | {"found": {"place": "shelf"}})["shelf"] is State.FOUND
    blocked = situation("desk", unreached={"desk": "a closed door"})
    assert states(blocked) == {"desk": State.UNREACHED}


def test_where_no_one_thing_is_looked_for_nothing_was_looked_for_in_vain() -> None:
    counting = situation("desk", "shelf", object=None, visited=["desk"])
    assert states(counting) == {"desk": State.BEEN, "shelf": State.OPEN}


def drawn(path: Path, entity: str) -> list[dict[str, Any]]:
    """The points of an entity, component by component, without what is static."""
    rows: list[dict[str, Any]] = []
    for chunk in RrdReader(path).stream():
        if str(chunk.entity_path) == f"/{entity}" and not chunk.is_static:
            batch = chunk.to_record_batch()
            names = [name for name in batch.schema.names if name.startswith("Points3D")]
            rows += batch.select(names).to_pylist()
    return rows


def test_balls_hang_over_the_furniture_in_the_colour_of_their_state(tmp_path: Path) -> None:
    stream = rr.RecordingStream("test")
    stream.save(tmp_path / "it.rrd")
    view = CandidatesView(stream)
    view.place(FURNITURE)
    for known in ({}, {}, {"visited": ["desk"]}):
        view.show(situation("desk", "shelf", "moon", **known))
    stream.disconnect()
    first, second = drawn(tmp_path / "it.rrd", "candidates")
    positions = np.array(first["Points3D:positions"])
    np.testing.assert_allclose(positions, [(2.0, 1.0, 1.05), (0.0, 3.0, 2.15)], atol=1e-6)
    assert first["Points3D:colors"] == [rgba(State.OPEN)] * 2
    assert second["Points3D:colors"] == [rgba(State.EMPTY), rgba(State.OPEN)]


def test_where_the_thing_was_seen_is_marked(tmp_path: Path) -> None:
    stream = rr.RecordingStream("test")
    stream.save(tmp_path / "it.rrd")
    view = CandidatesView(stream)
    view.show(situation("desk", object="mug", sighting=[1.0, 2.0, 0.8]))
    stream.disconnect()
    (row,) = drawn(tmp_path / "it.rrd", "target")
    np.testing.assert_allclose(row["Points3D:positions"], [(1.0, 2.0, 0.8)], atol=1e-6)
    assert row["Points3D:labels"] == ["mug"]


def rgba(state: State) -> int:
    red, green, blue = COLORS[state]
    return red << 24 | green << 16 | blue << 8 | 0xFF


def test_the_order_of_a_plan_is_a_line_from_place_to_place(tmp_path: Path) -> None:
    stream = rr.RecordingStream("test")
    stream.save(tmp_path / "it.rrd")
    view = CandidatesView(stream)
    view.place(FURNITURE)
    view.plan(
        replace(next(r for _, r in mission() if isinstance(r, Planned)), order=("shelf", "desk"))
    )
    stream.disconnect()
    chunks = [c for c in RrdReader(tmp_path / "it.rrd").stream() if str(c.entity_path) == "/order"]
    (batch,) = [chunk.to_record_batch() for chunk in chunks if not chunk.is_static]
    (((first, second),),) = batch.column("LineStrips3D:strips").to_pylist()
    np.testing.assert_allclose([first, second], [(0.0, 3.0, 2.15), (2.0, 1.0, 1.05)], atol=1e-6)
