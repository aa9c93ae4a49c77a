"""Do what was asked with the thing that was found: find, take or bring."""

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from executive.types import DELIVERY, CommandKind
from trees.context import MissionContext
from trees.deliver import deliver
from trees.nodes import Check, Step, fallback, sequence
from trees.person import Report
from trees.robot import DriveBack


def act(context: MissionContext) -> Behaviour:
    """A thing that was found, and is in the hand if it has to be -> reported or delivered."""
    situation = context.situation

    def from_a_place() -> Check:
        return Check("found at a place", context, lambda: situation.search.found is not None)

    return fallback(
        "act",
        sequence(
            "is there already",
            asked_to(context, CommandKind.BRING),
            Check("at the delivery place", context, lambda: situation.search.is_delivered),
            Report("report", context, "The {object} is here already, on the delivery table."),
        ),
        sequence(
            "bring",
            asked_to(context, CommandKind.BRING),
            deliver(context),
            fallback(
                "say so",
                sequence(
                    "elsewhere",
                    Check("on other furniture", context, lambda: situation.hand.put_at != DELIVERY),
                    Report(
                        "report",
                        context,
                        "I put the {object} on {surface}; "
                        "I could not put it on the delivery table: {why}.",
                    ),
                ),
                sequence(
                    "from there",
                    from_a_place(),
                    Report("report", context, "Here is the {object} from {place}."),
                ),
                Report("report", context, "Here is the {object}."),
            ),
        ),
        sequence(
            "find",
            asked_to(context, CommandKind.FIND),
            from_a_place(),
            DriveBack("come back", context, "person"),
            Report("report", context, "The {object} is at {place}."),
        ),
        sequence(
            "take",
            asked_to(context, CommandKind.TAKE),
            from_a_place(),
            Check("in my hand", context, lambda: situation.has_it),
            Report("report", context, "I took the {object} from {place} and hold it."),
        ),
        sequence(
            "have it",
            Check(
                "had it before", context, lambda: situation.has_it and not situation.search.found
            ),
            Check(
                "not asked to bring",
                context,
                lambda: not situation.request.asks_to(CommandKind.BRING),
            ),
            Report("report", context, "I hold the {object}."),
        ),
        SayHowFar("not all of it", context),
    )


def asked_to(context: MissionContext, kind: CommandKind) -> Check:
    """Whether this kind of deed was asked for."""
    return Check(f"asked to {kind}", context, lambda: context.situation.request.asks_to(kind))


class SayHowFar(Step):
    """Says what was found out although not all was done that was asked for; always fails."""

    def update(self) -> Status:
        """Who asks where a thing is wants to know it, even if the robot cannot come back."""
        found, why = self.situation.search.found, self.why_before()
        if self.situation.request.asks_to(CommandKind.FIND) and found:
            return self.fail(f"the {self.situation.request.object} is at {found.place}, but {why}")
        if self.situation.request.asks_to(CommandKind.TAKE) and not self.situation.has_it:
            return self.fail(f"the {self.situation.request.object} is not in my hand any more")
        return self.fail(why)
