"""What truly came of a mission, by the simulator; the robot has no access to it."""

from collections.abc import Callable, Iterable, Iterator

from executive.campaign.routes import Routes
from executive.interfaces.simulation import SimulatedHome
from executive.types.home import HAND
from executive.types.outcome import MissionStatus, Outcome, TaskOutcome
from sim.home.home import Home
from trees.deeds import deed_of


def whereabouts(name: str, world: SimulatedHome) -> str:
    """The furniture that a thing rests on, `hand` if the robot has it, empty if neither."""
    return HAND if world.held == name else world.resting_place(name) or ""


def completed(outcome: Outcome, where: Callable[[str], str]) -> bool:
    """Whether the robot said that it was done, all of it, and it was.

    Args:
        outcome: what the robot says.
        where: tells where a thing is, as `whereabouts` does, when the mission has ended.
    """
    if outcome.status != MissionStatus.DONE or outcome.kind is None:
        return False
    tasks = tuple(_with_parts(outcome.tasks))
    if len(tasks) < 2:
        return deed_of(outcome.kind).is_true_of(outcome, where)
    done = [task for task in tasks if task.status == MissionStatus.DONE]
    last = (task for number, task in enumerate(done) if not _undone(task, done[number + 1 :]))
    return all(deed_of(task.kind).is_true_of(task, where) for task in last)


def _with_parts(tasks: Iterable[TaskOutcome]) -> Iterator[TaskOutcome]:
    """Each task, or the parts of it if it was done so."""
    for task in tasks:
        if task.parts:
            yield from _with_parts(task.parts)
        else:
            yield task


def _undone(task: TaskOutcome, later: Iterable[TaskOutcome]) -> bool:
    """Whether what a task came to is not to be seen in the end, because more was done since.

    That is so if it was with the same thing, or if the hand that held it had to be free.
    """
    in_hand = task.kind.means.grasps and not task.kind.means.carries
    return any(
        other.object == task.object or (in_hand and other.kind.means.grasps)
        for other in later
        if other.object
    )


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
