"""The home from above, as the page draws it (metres, in `map`)."""

import math
from typing import Any

from executive.language.phrases import spoken
from executive.language.wording import Wording
from executive.types.home import DELIVERY
from sim.home.furniture import Furniture
from sim.home.home import Home


def plan(home: Home, wording: Wording) -> dict[str, Any]:
    """Rooms, walls, furniture and where the person is, each called as the robot does."""
    x, y, yaw = home.person
    return {
        "extent": home.extent(),
        "rooms": [
            {"name": room.name, "label": spoken(room.name), "rectangle": room.rectangle}
            for room in home.rooms
        ],
        "walls": [[*wall.center, *wall.size] for wall in home.walls()],
        "furniture": [_outline(piece, wording) for piece in (*home.furniture, home.delivery)],
        "person": [x, y, yaw],
        "robot": list(home.robot_start),
    }


def _outline(piece: Furniture, wording: Wording) -> dict[str, Any]:
    """Its rectangle: the middle, the lengths along its own axes, how it is turned (radians)."""
    x, y, yaw = piece.pose
    return {
        "name": piece.name,
        "label": wording.label(piece.name),
        "words": wording.words(piece.name),
        "room": piece.room,
        "at": [x, y, math.remainder(yaw, math.tau)],
        "size": list(piece.size[:2]),
        "searched": piece.name != DELIVERY,
    }
