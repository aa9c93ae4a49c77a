"""Why a behaviour has its status: by what it says, or by which of those in it that was decided."""

from typing import Any

from executive.page.experiment.reel import STILL, Reel


def because(reel: Reel, place: int, step: int) -> list[dict[str, Any]]:
    """The behaviour, and from level to level the one in it that its status comes from.

    Each with its place in the tree, its status, what it says, and since which step.
    """
    chain, here = [], place
    while True:
        status, message = reel.state(here, step)
        since = reel.since(here, step)
        chain.append({"node": here, "status": status, "message": message, "since": since})
        inner = _decider(reel, here, step, status)
        if inner is None:
            return chain
        here = inner


def _decider(reel: Reel, place: int, step: int, status: str) -> int | None:
    """Which behaviour in this one settled its status: the last in order that has the same one.

    A sequence fails by the one that failed, and a fallback by the last that did; a sequence
    succeeds by its last, a fallback by the one that did; what runs waits for the one that runs.
    """
    if status == STILL[0]:
        return None
    inside = reel.children.get(place, ())
    alike = [child for child in inside if reel.state(child, step)[0] == status]
    return alike[-1] if alike else None
