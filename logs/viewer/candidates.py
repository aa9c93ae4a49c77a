"""In rerun: a ball above each candidate place, the order of the search, and the sighting."""

from collections.abc import Iterable, Mapping, Sequence
from itertools import product
from typing import Any

import numpy as np
import rerun as rr

from executive.geometry import matrix_of
from executive.records import Entity, Planned, Shape
from executive.types.geometry import Vector3
from logs.viewer.states import State, states

CANDIDATES = "candidates"
TARGET = "target"
ORDER = "order"

COLORS = {
    State.OPEN: (90, 150, 255),
    State.CURRENT: (242, 169, 59),
    State.EMPTY: (229, 83, 75),
    State.BEEN: (139, 148, 158),
    State.UNREACHED: (139, 148, 158),
    State.FOUND: (63, 185, 80),
}
_RADIUS_M, _ABOVE_M = 0.16, 0.35
_TARGET_RADIUS_M = 0.10
_ORDER_COLOR, _ORDER_RADIUS_M = (90, 150, 255), 0.03
_CORNERS = np.array(list(product((-0.5, 0.5), repeat=3)))
"""Corners of a cube with edge 1."""


class CandidatesView:
    """Draws the places of each tick; logs only what has changed."""

    def __init__(self, stream: rr.RecordingStream) -> None:
        """Nothing is drawn yet."""
        self._stream = stream
        self._above: dict[str, Vector3] = {}
        self._shown: Mapping[str, State] = {}
        self._sighting: list[float] = []
        for path in (CANDIDATES, TARGET, ORDER):
            stream.log(path, rr.CoordinateFrame("map"), static=True)

    def place(self, entities: Iterable[Entity]) -> None:
        """Remember where the furniture is: all entities in `map`, without their meshes."""
        for entity in entities:
            shapes = [shape for shape in entity.shapes if shape.kind != "mesh"]
            if entity.frame_id == "map" and shapes:
                self._above[entity.name] = _above(shapes)

    def plan(self, planned: Planned) -> None:
        """Log the planned order of the search, as a line from place to place."""
        points = [self._above[place] for place in planned.order if place in self._above]
        lines = [points] if len(points) > 1 else []
        drawn = rr.LineStrips3D(lines, colors=_ORDER_COLOR, radii=_ORDER_RADIUS_M)
        self._stream.log(ORDER, drawn)

    def show(self, situation: Mapping[str, Any]) -> None:
        """Log the state of each candidate, and where the thing was seen."""
        drawn = {place: s for place, s in states(situation).items() if place in self._above}
        if drawn != self._shown:
            self._shown = drawn
            self._stream.log(CANDIDATES, _balls([self._above[p] for p in drawn], drawn))
        sighting = list(situation.get("sighting") or ())
        if sighting != self._sighting:
            self._sighting = sighting
            color = COLORS[State.FOUND]
            seen = [sighting] if sighting else []
            name = [str(situation.get("object"))] if sighting else []
            balls = rr.Points3D(seen, radii=_TARGET_RADIUS_M, colors=color, labels=name)
            self._stream.log(TARGET, balls)


def _balls(middles: list[Vector3], drawn: Mapping[str, State]) -> rr.Points3D:
    """One point for each candidate; labelled if it is current, or ended the search."""
    named = (State.CURRENT, State.FOUND)
    return rr.Points3D(
        middles,
        radii=_RADIUS_M,
        colors=[COLORS[state] for state in drawn.values()],
        labels=[place if state in named else "" for place, state in drawn.items()],
        show_labels=True,
    )


def _above(shapes: Sequence[Shape]) -> Vector3:
    """A point in `map` (m) above the middle of shapes."""
    turns = np.stack([matrix_of(shape.pose.orientation) for shape in shapes])
    boxes = _CORNERS * np.array([shape.size for shape in shapes])[:, np.newaxis]
    middles = np.array([shape.pose.position for shape in shapes])[:, np.newaxis]
    corners = (boxes @ turns.transpose(0, 2, 1) + middles).reshape(-1, 3)
    low, high = corners.min(axis=0), corners.max(axis=0)
    x, y, _ = ((low + high) / 2).tolist()
    return x, y, float(high[2]) + _ABOVE_M
