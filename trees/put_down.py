"""Put down what is in the hand: on the nearest free furniture by the person, or where they say."""

from collections.abc import Iterator

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from trees.context import MissionContext
from trees.nodes import Check, FirstOf, Step, fallback, sequence
from trees.person import AskWhereToPut
from trees.robot import DriveToSurface, PutDownThere

NEAR = 3
"""How many pieces of furniture by the person are tried before they are asked."""


def put_down_somewhere(context: MissionContext, name: str, *first: str) -> Behaviour:
    """A full hand -> `hand.put_at`: the places of `first`, then near ones, then asked for."""
    situation = context.situation

    def near() -> Iterator[str]:
        yield from first
        yield from context.near_person[:NEAR]

    def choose(place: str) -> None:
        situation.hand.surface = place

    return fallback(
        name,
        FirstOf("near the person", near, choose, go_and_put(context)),
        sequence(
            "where the person says",
            Check("still in my hand", context, lambda: situation.hand.in_hand is not None),
            Check("person may help", context, lambda: not situation.dialogue.no_help),
            AskWhereToPut("ask where to put it", context),
            FirstOf("there", lambda: situation.hand.surfaces, choose, go_and_put(context)),
        ),
        NotPutDown("no room", context),
    )


def go_and_put(context: MissionContext) -> Behaviour:
    """Take it to the surface at hand, and put it down there."""
    return sequence(
        "go and put",
        Check("still in my hand", context, lambda: context.situation.hand.in_hand is not None),
        DriveToSurface("drive", context),
        PutDownThere("put down", context),
    )


class NotPutDown(Step):
    """Says where there was no room, and why the person could not help; always fails.

    Reads hand.unplaced and dialogue.no_help.
    """

    def update(self) -> Status:
        """What is in the hand no more has its own reason."""
        tried, silence = self.situation.hand.not_put_down, self.situation.dialogue.no_help
        if self.situation.hand.in_hand is None or not tried:
            return self.fail(self.why_before())
        return self.fail(f"{tried}, and {silence}" if silence else tried)
