"""What the robot is doing, as the page puts it into a sentence: from what behaviours declare."""

from typing import Any

from executive.records import Activity, Tick, TreeShape
from executive.text import printable


class Doing:
    """Reads the ticks of one mission."""

    def __init__(self, tree: TreeShape) -> None:
        """Know what the behaviours of this tree declare."""
        self._activities = {node.path: node.activity for node in tree.nodes if node.activity}

    def now(self, tick: Tick) -> dict[str, Any]:
        """What is going on after this tick.

        Those running are nested in the order of the tree, and the innermost says it best.
        """
        running = [
            activity
            for node in tick.nodes
            if node.status == "RUNNING" and (activity := self._activities.get(node.path))
        ]
        situation = tick.situation
        searching = Activity.SEARCHING in running
        candidate = situation.get("candidate") if searching else None
        return {
            "state": "busy",
            "activity": printable(running[-1]) if running else "",
            "searching": searching,
            "thing": situation.get("object") or "",
            "held": situation.get("in_hand") or "",
            "place": candidate["place"] if candidate else "",
        }
