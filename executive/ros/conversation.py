"""One client of a server: what it asks for, and what it is told.

Whatever it sends that is no operation, or not to be had, has no effect: a `status` says so.
"""

import time
from collections.abc import Callable
from typing import Any, Protocol

from executive.ros.fragments import Joiner
from executive.ros.goals import Goal
from executive.ros.graph import absolute
from executive.ros.outbox import Letter, Outbox
from executive.ros.packets import Packet, PacketError
from executive.ros.protocol import (
    ActionFeedback,
    ActionResult,
    Advertise,
    CallService,
    CancelActionGoal,
    Compression,
    Fragment,
    GoalStatus,
    Message,
    Operation,
    Publish,
    SendActionGoal,
    ServiceResponse,
    SetLevel,
    Status,
    Subscribe,
    Unadvertise,
    Unsubscribe,
    decode,
)
from executive.text import printable

MOST_SUBSCRIPTIONS = 100
MOST_GOALS = 16
"""So many of a client's goals may be open."""
LONGEST_STATUS = 300
SPOKEN = tuple(Compression)
"""What a later one of these asks for counts, if somebody subscribes twice."""


class Host(Protocol):
    """What a conversation is part of; all on one thread."""

    def type_of_topic(self, topic: str) -> str | None:
        """The type of a topic's messages; None if there is none of this name."""
        ...

    def type_of_action(self, action: str) -> str | None:
        """The type of an action; None if there is none of this name."""
        ...

    def raw(self, topic: str, message: Message) -> Message:
        """A message of the topic as ROS 2 packs it, with the robot's time.

        Raises:
            PacketError: if it is not known how.
        """
        ...

    def wanted(self, topic: str, client: object) -> None:
        """A client wants the topic's messages from now on, the present one first."""
        ...

    def unwanted(self, topic: str, client: object) -> None:
        """A client does not want them any more."""
        ...

    def call(self, service: str, request: Message, answer: Callable[[bool, Any], None]) -> None:
        """Have a service answered: whether it could be, and the response, or why not."""
        ...

    def start(self, goal: Goal) -> None:
        """Have a goal pursued."""
        ...

    def cancel(self, goal: Goal) -> None:
        """Have a goal given up."""
        ...

    def goals_of(self, client: object) -> tuple[Goal, ...]:
        """A client's goals that have not ended."""
        ...


class Conversation:
    """What one client is told goes to its outbox."""

    def __init__(self, host: Host, outbox: Outbox) -> None:
        """It has just connected."""
        self._host = host
        self._outbox = outbox
        self._joiner = Joiner()
        self._subscriptions: dict[str, dict[str, Subscribe]] = {}
        self._sent_at: dict[str, float] = {}
        self._is_told = True

    def take(self, packet: Packet) -> None:
        """Do what the client asks for."""
        try:
            operation = decode(packet)
            if isinstance(operation, Fragment):
                whole = self._joiner.add(operation.part)
                if whole is None:
                    return
                operation = decode(whole)
        except PacketError as error:
            self._complain(str(error))
            return
        try:
            self._obey(operation)
        except PacketError as error:
            self._complain(str(error), operation.id)

    def leave(self) -> None:
        """The client is gone: it wants nothing any more. Its goals go on."""
        for topic in tuple(self._subscriptions):
            del self._subscriptions[topic]
            self._host.unwanted(topic, self)

    # --- what it is told ---

    def publish(self, topic: str, message: Message) -> None:
        """Tell it the newest message of a topic, if it wants that and is not told too often."""
        wishes = tuple(self._subscriptions.get(topic, {}).values())
        if not wishes:
            return
        now, rarest = time.monotonic(), min(wish.throttle_rate for wish in wishes) / 1000
        if rarest and now - self._sent_at.get(topic, -rarest) < rarest:
            return
        self._sent_at[topic] = now
        packed = max((Compression(wish.compression) for wish in wishes), key=SPOKEN.index)
        if packed == Compression.CBOR_RAW:
            message = self._host.raw(topic, message)
        sizes = [wish.fragment_size for wish in wishes if wish.fragment_size is not None]
        letter = Letter(
            Publish(topic, message),
            packed,
            min(sizes, default=None),
        )
        self._outbox.put(letter, newest_of=topic)

    def feedback(self, goal: Goal, values: Message) -> None:
        """Tell it how its goal gets on, if it wants to hear."""
        if goal.feedback:
            self._outbox.put(Letter(ActionFeedback(goal.action, values, goal.id)), goal.uuid)

    def result(self, goal: Goal, status: GoalStatus, values: Message) -> None:
        """Tell it how its goal ended."""
        self._outbox.put(Letter(ActionResult(goal.action, True, status, values, goal.id)))

    def refused(self, goal: Goal, why: str) -> None:
        """Tell it that its goal is not pursued."""
        no = ActionResult(goal.action, False, GoalStatus.UNKNOWN, why, goal.id)
        self._outbox.put(Letter(no))

    def _complain(self, text: str, id: str = "") -> None:
        if self._is_told:
            self._outbox.put(Letter(Status("error", printable(text)[:LONGEST_STATUS], id)))

    # --- what it asks for ---

    def _obey(self, operation: Operation) -> None:
        match operation:
            case Subscribe():
                self._subscribe(operation)
            case Unsubscribe():
                self._unsubscribe(absolute(operation.topic), operation.id)
            case CallService():
                self._call(operation)
            case SendActionGoal():
                self._send_goal(operation)
            case CancelActionGoal(_, id):
                self._cancel(id)
            case SetLevel(level):
                self._is_told = level != "none"
            case Advertise(topic) | Publish(topic):
                raise PacketError(f"{topic}: this robot takes no messages, only goals and calls")
            case Unadvertise() | Status():
                pass
            case _:
                raise PacketError(f"{operation.op}: that is for a robot to say, not to a robot")

    def _subscribe(self, wish: Subscribe) -> None:
        topic = absolute(wish.topic)
        known = self._host.type_of_topic(topic)
        if known is None:
            raise PacketError(f"{topic}: there is no such topic; /rosapi/topics lists them")
        if wish.type and _short(wish.type) != _short(known):
            raise PacketError(f"{topic}: it is of {known}, not of {wish.type}")
        if wish.compression not in SPOKEN:
            spoken = " or ".join(SPOKEN)
            raise PacketError(f"{topic}: compression {wish.compression}: I can do {spoken}")
        if wish.compression == Compression.CBOR_RAW:
            self._host.raw(topic, {})
        if sum(map(len, self._subscriptions.values())) >= MOST_SUBSCRIPTIONS:
            raise PacketError(f"{topic}: more than {MOST_SUBSCRIPTIONS} subscriptions")
        self._subscriptions.setdefault(topic, {})[wish.id] = wish
        self._sent_at.pop(topic, None)
        self._host.wanted(topic, self)

    def _unsubscribe(self, topic: str, id: str) -> None:
        wishes = self._subscriptions.get(topic, {})
        left = {one: wish for one, wish in wishes.items() if id and one != id}
        if left or not wishes:
            self._subscriptions.update({topic: left} if left else {})
            return
        del self._subscriptions[topic]
        self._outbox.forget(topic)
        self._host.unwanted(topic, self)

    def _call(self, call: CallService) -> None:
        def answer(done: bool, values: Any) -> None:
            response = ServiceResponse(call.service, done, values, call.id)
            packed = call.compression if call.compression in SPOKEN else Compression.NONE
            self._outbox.put(Letter(response, packed, call.fragment_size))

        if isinstance(call.args, list) and call.args:
            answer(False, "give the request as a table of its fields")
            return
        self._host.call(absolute(call.service), dict(call.args), answer)

    def _send_goal(self, sent: SendActionGoal) -> None:
        action = absolute(sent.action)
        args = sent.args if isinstance(sent.args, dict) else {}
        goal = Goal(action, args, self, sent.id, sent.feedback)
        mine, known = self._host.goals_of(self), self._host.type_of_action(action)
        if known is None:
            self.refused(goal, f"there is no action {action}; /rosapi/action_servers lists them")
        elif _short(sent.action_type) != _short(known):
            self.refused(goal, f"{action} is of {known}, not of {sent.action_type}")
        elif sent.args and not args:
            self.refused(goal, "give the goal as a table of its fields")
        elif any(other.id == sent.id for other in mine):
            self.refused(goal, f"a goal with the id {sent.id} is under way")
        elif len(mine) >= MOST_GOALS:
            self.refused(goal, f"more than {MOST_GOALS} goals")
        else:
            self._host.start(goal)

    def _cancel(self, id: str) -> None:
        for goal in self._host.goals_of(self):
            if goal.id == id:
                self._host.cancel(goal)


def _short(kind: str) -> str:
    """A type as ROS 1 and ROS 2 both have it: `sensor_msgs/Image`."""
    return "/".join(part for part in kind.split("/") if part not in ("msg", "srv", "action"))
