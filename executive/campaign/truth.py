"""Judges missions by the simulator's ground truth, to which the robot has no access."""

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
    """Whether the robot said that all of the mission was done, and that is true.

    Args:
        outcome: the outcome that the robot gives.
        where: returns where a thing is after the mission, as `whereabouts` does.
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
    """Each task, or its parts if it has any."""
    for task in tasks:
        if task.parts:
            yield from _with_parts(task.parts)
        else:
            yield task


def _undone(task: TaskOutcome, later: Iterable[TaskOutcome]) -> bool:
    """Whether later tasks have undone the result of a task.

    They have if they were about the same thing, or needed the hand that held it.
    """
    in_hand = task.kind.means.grasps and not task.kind.means.carries
    return any(
        other.object == task.object or (in_hand and other.kind.means.grasps)
        for other in later
        if other.object
    )


def shortest_m(outcome: Outcome, home: Home, routes: Routes) -> float:
    """The shortest path (metres) of a robot that knows where the thing is.

    It goes to the thing, and on to the nearest place where the command may end; 0 without a thing.

    Args:
        outcome: the outcome, with the command.
        home: the home as it was at the start.
        routes: the routes of this home.
    """
    place = home.placement.get(outcome.object or "")
    if place is None:
        return 0.0
    end = outcome.kind.means.ends_at if outcome.kind else None
    ends = outcome.goals or ((end,) if end else ())
    x, y, _ = home.robot_start
    there = ((x, y), routes.stand(place))
    return min((routes.tour((*there, routes.stand(e))) for e in ends), default=routes.tour(there))
