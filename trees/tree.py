"""A py_trees tree as the executive and the logs see it: paths, statuses, one tick at a time."""

from collections.abc import Iterator

from py_trees.behaviour import Behaviour
from py_trees.common import BlackBoxLevel, Status
from py_trees.composites import Parallel, Selector, Sequence
from py_trees.decorators import Decorator

from executive.records import NodeShape, NodeState, TreeShape
from trees.nodes import Action

_INVALID = Status.INVALID
"""At hand, because each tick asks each behaviour for its status."""


class MissionTree:
    """Implements `executive.interfaces.Tree`.

    Nodes are named by their path, because py_trees' own ids are random: the names from the root,
    joined by slashes; of siblings with one name the later ones get a number.
    """

    def __init__(self, root: Behaviour) -> None:
        """Wrap a tree that was not ticked yet."""
        self._root = root
        self._nodes = dict(_walk(root, root.name))
        self._paths = {node.id: path for path, node in self._nodes.items()}
        self._statuses = [_INVALID for _ in self._nodes]
        self._states = [NodeState(path, _INVALID.name) for path in self._nodes]
        """As `states` last found them: most are the same again, and then the same object."""

    def shape(self) -> TreeShape:
        """All behaviours, parents before children."""
        return TreeShape(
            tuple(
                NodeShape(
                    path=path,
                    parent=self._paths[node.parent.id] if node.parent else "",
                    name=node.name,
                    kind=_kind(node),
                    class_name=type(node).__name__,
                    source=getattr(node, "source", ""),
                    activity=getattr(node, "activity", ""),
                    stage=node.blackbox_level == BlackBoxLevel.BIG_PICTURE,
                )
                for path, node in self._nodes.items()
            )
        )

    def tick(self) -> None:
        """Let the tree decide once; no visitor of py_trees looks on, which would be a walk."""
        self._root.tick_once()

    @property
    def status(self) -> str:
        """Status of the root."""
        return self._root.status.name

    @property
    def tip(self) -> str:
        """Path of the behaviour that decided the last tick; empty before the first."""
        tip = self._root.tip()
        return self._paths[tip.id] if tip else ""

    def states(self) -> tuple[NodeState, ...]:
        """Every behaviour as the last tick left it; its message only where it was active."""
        states, statuses = self._states, self._statuses
        for index, (path, node) in enumerate(self._nodes.items()):
            status = node.status
            message = "" if status is _INVALID else node.feedback_message
            if status is not statuses[index] or message != states[index].message:
                statuses[index] = status
                states[index] = NodeState(path, status.name, message)
        return tuple(states)

    def stop(self) -> None:
        """Interrupt what is running: every behaviour that started something cancels it.

        Raises:
            Exception: the first that a behaviour raised; the others were interrupted all the same.
        """
        raised: list[Exception] = []
        for node in reversed(self._nodes.values()):  # children before parents
            if node.status == Status.RUNNING or (isinstance(node, Action) and node.is_under_way):
                try:
                    node.stop(Status.INVALID)
                except Exception as error:
                    node.status = Status.INVALID
                    raised.append(error)
        if raised:
            raise raised[0]


def _walk(node: Behaviour, path: str) -> Iterator[tuple[str, Behaviour]]:
    yield path, node
    names = [child.name for child in node.children]
    for index, child in enumerate(node.children):
        earlier = names[:index].count(child.name)
        name = child.name if not earlier else f"{child.name} {earlier + 1}"
        yield from _walk(child, f"{path}/{name}")


def _kind(node: Behaviour) -> str:
    for kind in (Sequence, Selector, Parallel, Decorator):
        if isinstance(node, kind):
            return kind.__name__.lower()
    return "behaviour"
