"""Where the thing may be, as the page draws it: read from the snapshot that each tick carries.

Keys that this version of the mission does not write are simply not there.
"""

from collections.abc import Iterator, Mapping
from typing import Any

from logs.viewer.states import State, states

LEAST = 0.01
"""A place that is less likely than this is shown only if the robot went there."""


class Places:
    """Follows the search of one mission."""

    def __init__(self) -> None:
        """No place counts yet."""
        self._situation: Mapping[str, Any] = {}
        self._sources: dict[str, str] = {}
        """Who named a place; kept when it is no candidate any more."""

    def after(self, situation: Mapping[str, Any], *, searching: bool) -> dict[str, Any]:
        """Each place that counts in the search, and the plan, as known after a tick.

        While nothing is searched, the robot is at none of them: there is what came of the last.
        Where a thing that is found might have been as well does not count any more.
        """
        self._situation = situation
        self._sources |= dict(_named(situation))
        over = bool(situation.get("found"))
        chances, shares = ({}, {}) if over else _chances(situation)
        here = situation.get("candidate") if searching else None
        became = states({**situation, "candidate": here})
        found = {p: str(state) for p, state in became.items() if not over or state != State.OPEN}
        why_not = {**(situation.get("unseen") or {}), **(situation.get("unreached") or {})}
        plan = situation.get("plan") or {}
        order = [] if over else [str(place) for place in plan.get("order") or ()]
        return {
            "thing": situation.get("object") or "",
            "places": [
                {
                    "place": place,
                    "state": found.get(place, "open"),
                    "chance": chances.get(place),
                    "sources": shares.get(place) or {self._sources.get(place, ""): None},
                    "why": why_not.get(place, ""),
                    "turn": order.index(place) + 1 if searching and place in order else None,
                }
                for place in dict.fromkeys((*chances, *found))
                if place in found or place in order or chances[place] >= LEAST
            ],
            "ask_after": plan.get("ask_after", -1) if order and searching else -1,
            "sighting": list(situation.get("sighting") or ())[:2],
        }

    def at_the_end(self) -> dict[str, Any] | None:
        """The same when the mission is over; None if it came to nothing."""
        return self.after(self._situation, searching=False) if self._situation else None


def _named(situation: Mapping[str, Any]) -> Iterator[tuple[str, str]]:
    """Places, each with who says so."""
    candidates = situation.get("candidates") or ()
    named = (*candidates, situation.get("candidate"), situation.get("found"))
    yield from ((c["place"], str(c["source"])) for c in named if c)


def _chances(
    situation: Mapping[str, Any],
) -> tuple[dict[str, float], dict[str, dict[str, float]]]:
    """How likely the thing is at each place, and how much of that who says: of the belief, if any.

    Otherwise of the candidates, as far as who names them says how likely they are.
    """
    belief = situation.get("belief") or {}
    likely = belief.get("places") or situation.get("candidates") or ()
    told = [one for one in likely if one.get("probability") is not None]
    chances = {one["place"]: round(float(one["probability"]), 4) for one in told}
    shares = {one["place"]: dict(one["shares"]) for one in told if one.get("shares")}
    return chances, shares
