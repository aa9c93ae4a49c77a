"""What truly came of a mission, by the simulator; the robot has no access to it."""

from collections.abc import Mapping

from executive.campaign.routes import Routes
from executive.interfaces import SimulatedHome
from executive.types import DELIVERY, CommandKind, MissionStatus, Outcome
from sim.home.home import PERSON, Home

HAND = "hand"


def whereabouts(name: str, world: SimulatedHome) -> str:
    """The furniture that a thing rests on, `hand` if the robot has it, empty if neither."""
    return HAND if world.held == name else world.resting_place(name) or ""


def completed(outcome: Outcome, truth: str) -> bool:
    """Whether the robot said that it was done, and it was.

    find: the robot went to the furniture that it names, and the thing is there; take: the thing is
    in its hand; bring: the thing is on the delivery table; put down: it is on some furniture.

    Args:
        outcome: what the robot says.
        truth: where the thing is, as `whereabouts` tells when the mission has ended.
    """
    if outcome.status != MissionStatus.DONE:
        return False
    match outcome.kind:
        case CommandKind.FIND:
            return truth == outcome.location and truth in outcome.visited
        case CommandKind.TAKE:
            return truth == HAND
        case CommandKind.PUT_DOWN:
            return truth not in (HAND, "")
        case _:
            return truth == DELIVERY


ENDS: Mapping[CommandKind | None, tuple[str, ...]] = {
    CommandKind.FIND: (PERSON,),
    CommandKind.BRING: (DELIVERY,),
}
"""Where commands end, beyond the thing: the robot reports to the person, and brings to a table."""


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
    stops = (place, *ENDS.get(outcome.kind, ()))
    x, y, _ = home.robot_start
    return routes.tour(((x, y), *map(routes.stand, stops)))
