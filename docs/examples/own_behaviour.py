"""A behaviour of one's own, to copy: what each method is for, and when it is called.

This one drives to where the robot waits, once a mission is over. It is slow, so it is an `Action`:
it *starts* something, is asked again whenever an event came, and *cancels* what it started if it is
not wanted any more. What decides at once, from what is known, is a `Step`, and has only `update`.

    python docs/examples/own_behaviour.py

To keep it in the robot's own tree, put it into trees/mission.py, as `mission_and_home` does here.
"""

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from executive import DriveTo, Result, Succeeded
from executive.testing.bench import Run, run_mission
from trees.context import MissionContext
from trees.mission import mission
from trees.nodes import Action, Optionally, sequence
from trees.tree import MissionTree


class GoTo(Action):
    """Goes to a place. Reads nothing of the situation; writes nothing but a failure's reason."""

    activity = "going home"
    """What the robot is doing while this is running: campaigns count its seconds by this word."""
    source = ""
    """Who says what it settles (`logs why` shows it); nobody, as it settles nothing."""

    def __init__(self, name: str, context: MissionContext, place: str) -> None:
        """Called once, when the tree is built: no event has come, and nothing is known yet."""
        super().__init__(name, context, patience_s=context.parameters.action_s)
        self._place = place

    def start(self) -> int:
        """Called when the tree comes to it: start, and return the request's number at once."""
        return self.context.robot.start(DriveTo(self._place))

    def ended(self, result: Result) -> Status:
        """Called when the request has ended: what does that mean for the tree?"""
        if isinstance(result, Succeeded):
            return self.succeed(self._place)  # the log says what it succeeded with
        return self.failed(result)  # with the adapter's reason, for the person and for the log

    def cancel(self, request: int) -> None:
        """Called when it is not wanted any more (a stop, another branch), and out of time."""
        self.context.robot.cancel(request)

    def out_of_time(self) -> Status:
        """Called after `patience_s` of mission time without an end, when that is cancelled."""
        return self.fail(f"it takes too long to drive to {self._place}")


def mission_and_home(context: MissionContext) -> Behaviour:
    """The whole tree, and then home; that it cannot get there does not change how it ended."""
    home = GoTo("go home", context, "desk")
    return sequence("day", mission(context), Optionally("home", context.situation, home))


def bring(words: str) -> Run:
    """One mission of this tree in the instant world, on the bench that the tests use."""
    return run_mission(words, build=lambda context: MissionTree(mission_and_home(context)))


if __name__ == "__main__":
    run = bring("Bring the mug")
    print(run.outcome.reason)
    print(f"now the robot is at {run.world.at}")
