"""A behaviour of one's own, to copy: what each method is for, and when it is called.

This one drives to where the robot waits, once a mission is over. It is slow, so it is an `Action`:
it *starts* something, is asked again whenever an event came, and *cancels* what it started if it is
not wanted any more. What decides at once, from what is known, is a `Step`, and has only `update`.

    python docs/examples/own_behaviour.py

A Session is given the tree (`build=whole_tree`), and so is `replay` for what it recorded. To keep
the behaviour in the robot's own tree, put it into trees/mission.py, as `mission_and_home` does.
"""

from pathlib import Path

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from executive import DriveTo, Outcome, Result, Session, Succeeded, load_settings
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


def whole_tree(context: MissionContext) -> MissionTree:
    """What a Session is given to build the tree of each mission."""
    return MissionTree(mission_and_home(context))


def bring(words: str, runs: Path | None = None) -> Outcome:
    """One mission of this tree in the instant world."""
    settings = load_settings(world="fake", llm="none", user="oracle", runs=runs)
    with Session(settings, build=whole_tree) as session:
        return session.run(words)


if __name__ == "__main__":
    outcome = bring("Bring the mug")
    print(f"{outcome.reason} It took {outcome.mission_time_s:.0f} s, with the way to the desk.")
