"""The goals of a server's actions: who sent them, and which of them a cancel means."""

import uuid
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

from executive.ros.packets import PacketError, octets
from executive.ros.protocol import Message

UUID_BYTES = 16
NO_ID = bytes(UUID_BYTES)
"""Who cancels with this id means more than one goal."""
UNKNOWN_GOAL = 2
"""`CancelGoal`'s return code if there is no goal with the id."""


def _new_id() -> bytes:
    return uuid.uuid4().bytes


@dataclass(eq=False)
class Goal:
    """A goal that was sent.

    Attributes:
        action: whose it is.
        args: what is wanted.
        client: what its sender is told by; None once they are gone.
        id: what the sender calls it.
        feedback: whether they want to hear how it gets on.
        uuid: what everybody may call it.
        accepted_ns: the robot's time when it was accepted (ns); None: not yet.
    """

    action: str
    args: Message
    client: Any
    id: str
    feedback: bool
    uuid: bytes = field(default_factory=_new_id)
    accepted_ns: int | None = None

    @property
    def info(self) -> Message:
        """`action_msgs/msg/GoalInfo`."""
        seconds, nanoseconds = divmod(self.accepted_ns or 0, 10**9)
        stamp = {"sec": seconds, "nanosec": nanoseconds}
        return {"goal_id": {"uuid": self.uuid}, "stamp": stamp}


class Goals:
    """Those that have not ended."""

    def __init__(self) -> None:
        """None yet."""
        self._open: dict[bytes, Goal] = {}

    def __iter__(self) -> Iterator[Goal]:
        """All, the oldest first."""
        return iter(tuple(self._open.values()))

    def add(self, goal: Goal) -> None:
        """It begins."""
        self._open[goal.uuid] = goal

    def take(self, goal: Goal) -> bool:
        """It has ended; whether it had not before."""
        return self._open.pop(goal.uuid, None) is not None

    def of(self, client: object, id: str) -> Goal | None:
        """The goal that a client calls so."""
        return next((g for g in self if g.client is client and g.id == id), None)

    def meant(self, action: str, request: Message) -> tuple[int, list[Goal]]:
        """The return code of a `CancelGoal`, and the goals that it means.

        An id means that goal; a stamp, all up to it; both, all of these; neither, all.

        Raises:
            PacketError: if the request is none.
        """
        uuid, before = _id_of(request), _stamp_of(request)
        open_ = [goal for goal in self if goal.action == action]
        if uuid == NO_ID and before == 0:
            return 0, open_
        found = [g for g in open_ if g.uuid == uuid or (before and (g.accepted_ns or 0) <= before)]
        unknown = uuid != NO_ID and not any(goal.uuid == uuid for goal in open_)
        return (UNKNOWN_GOAL if unknown and not found else 0), found


def _id_of(request: Message) -> bytes:
    info = _table(request, "goal_info")
    content = octets(_table(info, "goal_id").get("uuid", NO_ID))
    if len(content) != UUID_BYTES:
        raise PacketError(f"a goal's uuid of {len(content)} bytes: it has {UUID_BYTES}")
    return content


def _stamp_of(request: Message) -> int:
    """Nanoseconds."""
    stamp = _table(_table(request, "goal_info"), "stamp")
    parts = [stamp.get(name, 0) for name in ("sec", "nanosec")]
    if not all(type(part) is int for part in parts):
        raise PacketError("a stamp that is not whole numbers")
    return int(parts[0]) * 10**9 + int(parts[1])


def _table(message: Message, name: str) -> Message:
    value = message.get(name, {})
    if not isinstance(value, dict):
        raise PacketError(f"{name} that is no table")
    return value
