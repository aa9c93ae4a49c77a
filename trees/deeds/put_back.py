"""Put a thing back: where the robot took it, else where it belongs."""

from executive.types.commands import CommandKind
from trees.deeds.put import Put


class PutBack(Put):
    """As in "Put the mug back". `trees/places.py` finds out where that is."""

    kind = CommandKind.PUT_BACK
    did = "put back"
    report = "I put {the_object} back {put}."
