"""A py_trees tree as the executive and the logs see it: paths, statuses and single ticks."""

from functools import cache

from py_trees.behaviour import Behaviour
from py_trees.common import BlackBoxLevel, Status
from py_trees.composites import Parallel, Selector, Sequence
from py_trees.decorators import Decorator

from executive.records import NodeShape, NodeState, TreeShape
from trees.nodes import Action

_INVALID = Status.INVALID
"""A module constant is faster to look up, and each tick compares many statuses with it."""


class MissionTree:
    """Implements `executive.interfaces.runtime.Tree`.

    Nodes are identified by their path, because py_trees' own ids are random. A path is the names
    from the root, joined by slashes; siblings of the same name are numbered from the second on.
    """

    def __init__(self, root: Behaviour) -> None:
        """Wrap a tree that was not ticked yet."""
        self._root = root
        # lists with one entry for each behaviour, parents before children
        self._nodes: list[Behaviour] = []
        self._paths: list[str] = []
        self._ends: list[int] = []
        """The index of the first later behaviour that is not a descendant of this one."""
        self._list(root, root.name)
        self._path_of = dict(zip(self._nodes, self._paths, strict=True))
        self._statuses = [_INVALID] * len(self._nodes)
        self._states = [NodeState(path, _INVALID.name) for path in self._paths]
        """What `states` returned last; an unchanged state is the same object again."""

    def _list(self, node: Behaviour, path: str) -> None:
        index = len(self._nodes)
        self._nodes.append(node)
        self._paths.append(path)
        self._ends.append(0)
        named: dict[str, int] = {}
        for child in node.children:
            number = named[child.name] = named.get(child.name, 0) + 1
            name = child.name if number == 1 else f"{child.name} {number}"
            self._list(child, f"{path}/{name}")
        self._ends[index] = len(self._nodes)

    def __del__(self) -> None:
        """Break the reference cycles of the behaviours, so that they are freed at once.

        Each refers to its parent and to its own tick generator. Python's garbage collector would
        free them, too, but takes as long for that as building the tree took.
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
                    parent=self._path_of[node.parent] if node.parent else "",
                    name=node.name,
                    kind=_kind(type(node)),
                    class_name=type(node).__name__,
                    source=getattr(node, "source", ""),
                    activity=getattr(node, "activity", ""),
                    stage=node.blackbox_level == BlackBoxLevel.BIG_PICTURE,
                )
                for path, node in zip(self._paths, self._nodes, strict=True)
            )
        )

    def tick(self) -> None:
        """Tick once, without py_trees' visitors, which would walk through the whole tree."""
        self._root.tick_once()

    @property
    def status(self) -> str:
        """Status of the root."""
        return self._root.status.name

    @property
    def tip(self) -> str:
        """Path of the behaviour that decided the last tick; empty before the first."""
        tip = self._root.tip()
        return self._path_of[tip] if tip else ""

    def states(self) -> tuple[NodeState, ...]:
        """Every behaviour after the last tick; with its message, if it was active.

        If a behaviour is INVALID and was so before, so are all its descendants. They are skipped,
        and that is most of the tree.
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
                states[index] = NodeState(self._paths[index], status.name, message)
            index += 1
        return tuple(states)

    def stop(self) -> None:
        """Interrupt what is running: every behaviour that started something cancels it.

        Raises:
            Exception: the first that a behaviour raised; all others were interrupted nevertheless.
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
