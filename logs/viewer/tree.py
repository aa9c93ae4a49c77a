"""The behaviour tree in rerun: a graph of the active branch, and lanes of what ran when."""

from collections.abc import Callable, Sequence
from functools import cache

import numpy as np
import rerun as rr

from executive.records import NodeShape, Tick, TreeShape

BRANCH = "behaviour_tree/branch"
WHOLE = "behaviour_tree/whole"
LANES = "mission"
EVERY = "behaviours"

COLORS = {
    "INVALID": 0x8B949EFF,
    "RUNNING": 0xF2A93BFF,
    "SUCCESS": 0x3FB950FF,
    "FAILURE": 0xE5534BFF,
}
_STATUS_STYLE = rr.StateConfiguration(
    values=list(COLORS),
    colors=np.array(list(COLORS.values()), np.uint32),
    visible=[status != "INVALID" for status in COLORS],
)
_SIGNS = {"sequence": "→", "selector": "?", "parallel": "||", "decorator": "◇"}
"""Only signs that the viewer's font has: it crashes at others."""

_ROW, _INDENT, _COLUMN, _LETTER, _PADDING = 34.0, 48.0, 170.0, 5.8, 20.0
"""Layout of the graphs (viewer units): a row, a level (in either layout), a letter, a margin."""


Layout = Callable[[Sequence[NodeShape], Sequence[str]], list[tuple[float, float]]]
"""Computes the centres of nodes from the nodes and their labels."""


class TreeView:
    """Draws the ticks of one tree; logs only what has changed."""

    def __init__(self, stream: rr.RecordingStream, tree: TreeShape) -> None:
        """Nothing is drawn yet."""
        self._stream = stream
        self._tree = tree
        stages = [node for node in tree.nodes if node.stage]
        self._lanes = {node.path: _lane(LANES, i, node) for i, node in enumerate(stages, start=1)}
        """The lanes of the stages of the mission."""
        self._every = {node.path: _lane(EVERY, i, node) for i, node in enumerate(tree.nodes)}
        """The lanes of all behaviours."""
        self._shown: dict[str, str] = {}
        """The last logged state of each lane."""
        self._graphs: dict[str, tuple[Sequence[NodeShape], list[int]]] = {}
        """The nodes of each graph, and their colours."""

    def show(self, tick: Tick) -> None:
        """Log what has changed in this tick."""
        statuses = {node.path: node.status for node in tick.nodes}
        self._graph(BRANCH, _branch(self._tree, tick.tip), statuses, _outline)
        self._graph(WHOLE, self._tree.nodes, statuses, _columns)
        place = (tick.situation.get("candidate") or {}).get("place", "")
        self._lane(f"{LANES}/0_doing", tick.tip.rpartition("/")[2])
        self._lane(f"{LANES}/0_place", place)
        for lanes in (self._lanes, self._every):
            for node, lane in lanes.items():
                self._status(lane, statuses[node])

    def _graph(
        self, path: str, nodes: Sequence[NodeShape], statuses: dict[str, str], layout: Layout
    ) -> None:
        colors = [COLORS[statuses[node.path]] for node in nodes]
        before, self._graphs[path] = self._graphs.get(path), (nodes, colors)
        if self._graphs[path] == before:
            return
        colored = np.array(colors, np.uint32)
        if before and before[0] == nodes:
            self._stream.log(path, rr.GraphNodes.from_fields(colors=colored))
            return
        labels = [f"{_SIGNS.get(node.kind, '')} {node.name}".strip() for node in nodes]
        edges = [(node.parent, node.path) for node in nodes if node.parent]
        self._stream.log(
            path,
            rr.GraphNodes(
                [node.path for node in nodes],
                positions=np.array(layout(nodes, labels)),
                colors=colored,
                labels=labels,
                show_labels=True,
            ),
            rr.GraphEdges(np.array(edges).reshape(-1, 2)),
        )

    def _status(self, path: str, status: str) -> None:
        """The lane of a behaviour, which begins when it is first active."""
        if path not in self._shown:
            if status == "INVALID":
                return
            self._stream.log(path, _STATUS_STYLE, static=True)
        self._lane(path, status)

    def _lane(self, path: str, state: str) -> None:
        if state and self._shown.get(path) != state:
            self._shown[path] = state
            self._stream.log(path, _change(state))


@cache
def _change(state: str) -> rr.StateChange:
    """The change to a state; cached, as there are only a few."""
    return rr.StateChange(state=state)


def _lane(folder: str, number: int, node: NodeShape) -> str:
    """The entity path of a behaviour's lane; lanes are drawn in the order of their names."""
    return f"{folder}/{number}_{node.name.replace(' ', '_')}"


def _branch(tree: TreeShape, tip: str) -> list[NodeShape]:
    """The root, and the children of every behaviour on the way down to the tip."""
    on_the_way = f"{tip}/"
    return [n for n in tree.nodes if not n.parent or on_the_way.startswith(f"{n.parent}/")]


def _outline(nodes: Sequence[NodeShape], labels: Sequence[str]) -> list[tuple[float, float]]:
    """From top to bottom, one row each, indented by depth: for a narrow view."""
    return [
        (_depth(node) * _INDENT + (_PADDING + len(label) * _LETTER) / 2, row * _ROW)
        for row, (node, label) in enumerate(zip(nodes, labels, strict=True))
    ]


def _columns(nodes: Sequence[NodeShape], labels: Sequence[str]) -> list[tuple[float, float]]:
    """From left to right, one row for each leaf, parents in the middle of their children."""
    rows: dict[str, list[float]] = {}
    leaves = len(nodes)
    for node in reversed(nodes):
        if node.path not in rows:
            leaves -= 1
            rows[node.path] = [leaves * _ROW]
        rows.setdefault(node.parent, []).append(_middle(rows[node.path]))
    return [(_depth(node) * _COLUMN, _middle(rows[node.path])) for node in nodes]


def _middle(rows: Sequence[float]) -> float:
    return (min(rows) + max(rows)) / 2


def _depth(node: NodeShape) -> int:
    return node.path.count("/")
