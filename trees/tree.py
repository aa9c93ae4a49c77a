"""A py_trees tree as the executive and the logs see it: paths, statuses, one tick at a time."""

from functools import cache

from py_trees.behaviour import Behaviour
from py_trees.common import BlackBoxLevel, Status
from py_trees.composites import Parallel, Selector, Sequence
from py_trees.decorators import Decorator

from executive.records import NodeShape, NodeState, TreeShape
from trees.nodes import Action

_INVALID = Status.INVALID
"""At hand, because each tick asks many behaviours for their status."""


class MissionTree:
    """Implements `executive.interfaces.runtime.Tree`.

    Nodes are named by their path, because py_trees' own ids are random: the names from the root,
    joined by slashes; of siblings with one name the later ones get a number.
    """

    def __init__(self, root: Behaviour) -> None:
        """Wrap a tree that was not ticked yet."""
        self._root = root
        self._nodes: list[Behaviour] = []
        """Parents before children, as all that follows."""
        self._names: list[str] = []
        self._ends: list[int] = []
        """Of each behaviour the index of the first one behind it that is not inside of it."""
        self._list(root, root.name)
        self._paths = dict(zip(self._nodes, self._names, strict=True))
        self._statuses = [_INVALID] * len(self._nodes)
        self._states = [NodeState(path, _INVALID.name) for path in self._names]
        """As `states` last found them: most are the same again, and then the same object."""

    def _list(self, node: Behaviour, path: str) -> None:
        index = len(self._nodes)
        self._nodes.append(node)
        self._names.append(path)
        self._ends.append(0)
        named: dict[str, int] = {}
        for child in node.children:
            number = named[child.name] = named.get(child.name, 0) + 1
            name = child.name if number == 1 else f"{child.name} {number}"
            self._list(child, f"{path}/{name}")
        self._ends[index] = len(self._nodes)

    def __del__(self) -> None:
        """Take the behaviours apart, so that they are gone at once.

        Each knows its parent and its own next tick: without this they would wait for Python's
        search for garbage, which takes as long with them as it took to build them.
        """
        for node in self._nodes:
            node.parent = None
            del node.iterator

    def shape(self) -> TreeShape:
        """All behaviours, parents before children."""
        return TreeShape(
            tuple(
                NodeShape(
                    path=path,
                    parent=self._paths[node.parent] if node.parent else "",
                    name=node.name,
                    kind=_kind(type(node)),
                    class_name=type(node).__name__,
                    source=getattr(node, "source", ""),
                    activity=getattr(node, "activity", ""),
                    stage=node.blackbox_level == BlackBoxLevel.BIG_PICTURE,
                )
                for path, node in zip(self._names, self._nodes, strict=True)
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
        return self._paths[tip] if tip else ""

    def states(self) -> tuple[NodeState, ...]:
        """Every behaviour as the last tick left it; its message only where it was active.

        Of what was not active and is not, nothing inside can be: so most of the tree is not asked.
        """
        nodes, states, statuses, ends = self._nodes, self._states, self._statuses, self._ends
        index = 0
        while index < len(nodes):
            node = nodes[index]
            status, message = node.status, ""
            if status is not _INVALID:
                message = node.feedback_message
            elif statuses[index] is _INVALID:
                index = ends[index]
                continue
            if status is not statuses[index] or message != states[index].message:
                statuses[index] = status
                states[index] = NodeState(self._names[index], status.name, message)
            index += 1
        return tuple(states)

    def stop(self) -> None:
        """Interrupt what is running: every behaviour that started something cancels it.

        Raises:
            Exception: the first that a behaviour raised; the others were interrupted all the same.
        """
        raised: list[Exception] = []
        for node in reversed(self._nodes):  # children before parents
            if node.status == Status.RUNNING or (isinstance(node, Action) and node.is_under_way):
                try:
                    node.stop(Status.INVALID)
                except Exception as error:
                    node.status = Status.INVALID
                    raised.append(error)
        if raised:
            raise raised[0]


@cache
def _kind(of: type[Behaviour]) -> str:
    for kind in (Sequence, Selector, Parallel, Decorator):
        if issubclass(of, kind):
            return kind.__name__.lower()
    return "behaviour"
