"""What truly came of a mission, by the simulator; the robot has no access to it."""

from executive.campaign.routes import Routes
from executive.interfaces import SimulatedHome
from executive.types import HAND, MissionStatus, Outcome
from sim.home.home import Home
from trees.deeds import deed_of


def whereabouts(name: str, world: SimulatedHome) -> str:
    """The furniture that a thing rests on, `hand` if the robot has it, empty if neither."""
    return HAND if world.held == name else world.resting_place(name) or ""


def completed(outcome: Outcome, truth: str) -> bool:
    """Whether the robot said that it was done, and it was.

    Args:
        outcome: what the robot says.
        truth: where the thing is, as `whereabouts` tells when the mission has ended.
    """
    if outcome.status != MissionStatus.DONE or outcome.kind is None:
        return False
    return deed_of(outcome.kind).is_true(outcome, truth)


def shortest_m(outcome: Outcome, home: Home, routes: Routes) -> float:
    """How far the robot has to drive if it knows where the thing is; 0 for no such thing (metres).

    Args:
        outcome: says what was asked for.
        home: as it was at the start.
        routes: of this home.
    """
    place = home.placement.get(outcome.object or "")
    if place is None:
        return 0.0
    end = outcome.kind.means.ends_at if outcome.kind else None
    ends = outcome.goals or ((end,) if end else ())
    x, y, _ = home.robot_start
    there = ((x, y), routes.stand(place))
    return min((routes.tour((*there, routes.stand(e))) for e in ends), default=routes.tour(there))
