"""The state of each candidate place after a tick."""

from collections.abc import Mapping
from enum import StrEnum
from typing import Any


class State(StrEnum):
    """The state of the search at a place."""

    OPEN = "open"
    CURRENT = "current"
    """The robot is on its way there, or is looking there."""
    EMPTY = "empty"
    """The thing was looked for there, in vain."""
    BEEN = "been"
    """The robot was there, but not to find one thing: it counts things, for example."""
    UNREACHED = "unreached"
    FOUND = "found"


def states(situation: Mapping[str, Any]) -> dict[str, State]:
    """The state of each place: the candidates in their order, then others that were tried.

    Args:
        situation: the snapshot in each tick.
    """
    found = dict.fromkeys((c["place"] for c in situation.get("candidates") or ()), State.OPEN)
    visited = State.EMPTY if situation.get("object") else State.BEEN
    found |= dict.fromkeys(situation.get("visited") or (), visited)
    found |= dict.fromkeys(situation.get("unreached") or (), State.UNREACHED)
    for key, state in (("candidate", State.CURRENT), ("found", State.FOUND)):
        if situation.get(key):
            found[situation[key]["place"]] = state
    return found
