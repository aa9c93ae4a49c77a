"""Who is connected to a server, what they want, and which goals are open; on one thread."""

from collections import defaultdict
from collections.abc import Callable
from typing import Any, Protocol

from executive.ros.cdr import to_cdr
from executive.ros.conversation import Conversation
from executive.ros.goals import Goal, Goals
from executive.ros.graph import CANCELS, FEEDBACK, Graph
from executive.ros.outbox import Outbox
from executive.ros.packets import PacketError
from executive.ros.protocol import GoalStatus, Message

Answer = Callable[[bool, Any], None]
"""Tells whether a service did what it was called for, and its response, or why not."""


class Backend(Protocol):
    """The robot behind a server. It is told on the server's thread, and returns at once."""

    @property
    def graph(self) -> Graph:
        """What there is."""
        ...

    def time(self) -> Message:
        """What the robot's clock shows: `builtin_interfaces/msg/Time`."""
        ...

    def want(self, topic: str) -> None:
        """Publish this topic from now on, and once at once: somebody has asked for it."""
        ...

    def leave_out(self, topic: str) -> None:
        """Nobody wants it any more."""
        ...

    def start(self, goal: Goal) -> None:
        """Pursue a goal: accept or refuse it; one that was accepted ends once."""
        ...

    def cancel(self, goal: Goal) -> None:
        """Give it up: it ends when all is at rest."""
        ...

    def settle(self) -> None:
        """Come to rest, if nothing is pursued."""
        ...


class Hub:
    """Between the conversations and the robot. Implements `Host`."""

    def __init__(self, backend: Backend) -> None:
        """Nobody is there yet."""
        self._backend = backend
        self._conversations: set[Conversation] = set()
        self._goals = Goals()
        self._wanted: defaultdict[str, set[object]] = defaultdict(set)

    def __len__(self) -> int:
        """How many are connected."""
        return len(self._conversations)

    def join(self, outbox: Outbox) -> Conversation:
        """Somebody connects."""
        conversation = Conversation(self, outbox)
        self._conversations.add(conversation)
        return conversation

    def part(self, conversation: Conversation) -> None:
        """Somebody is gone; what they started goes on."""
        self._conversations.discard(conversation)
        conversation.leave()
        for goal in self.goals_of(conversation):
            goal.client = None

    # --- what happens ---

    def publish(self, topic: str, message: Message) -> None:
        """Tell a message to all who want it."""
        for conversation in self._conversations:
            conversation.publish(topic, message)

    def refuse(self, goal: Goal, why: str) -> None:
        """A goal is not pursued."""
        if self._goals.take(goal) and goal.client is not None:
            goal.client.refused(goal, why)

    def feedback(self, goal: Goal, values: Message) -> None:
        """How a goal gets on: its sender hears it, and who listens to the hidden topic."""
        if goal.client is not None:
            goal.client.feedback(goal, values)
        message = {"goal_id": goal.info["goal_id"], "feedback": values}
        self.publish(goal.action + FEEDBACK, message)

    def end(self, goal: Goal, status: GoalStatus, values: Message) -> None:
        """A goal ended."""
        if self._goals.take(goal) and goal.client is not None:
            goal.client.result(goal, status, values)

    # --- Host ---

    def type_of_topic(self, topic: str) -> str | None:
        """The type of a topic's messages; None if there is none of this name."""
        return self._backend.graph.topics.get(topic)

    def type_of_action(self, action: str) -> str | None:
        """The type of an action; None if there is none of this name."""
        return self._backend.graph.actions.get(action)

    def raw(self, topic: str, message: Message) -> Message:
        """A message of the topic as ROS 2 packs it, with the robot's time."""
        time = self._backend.time()
        content = to_cdr(message, self._backend.graph.topics[topic])
        return {"secs": time["sec"], "nsecs": time["nanosec"], "bytes": content}

    def wanted(self, topic: str, client: object) -> None:
        """Somebody wants a topic, and to know at once how it is."""
        self._wanted[topic].add(client)
        if topic in self._backend.graph.published:
            self._backend.want(topic)

    def unwanted(self, topic: str, client: object) -> None:
        """Somebody does not want it any more."""
        self._wanted[topic].discard(client)
        if not self._wanted[topic] and topic in self._backend.graph.published:
            self._backend.leave_out(topic)

    def call(self, service: str, request: Message, answer: Answer) -> None:
        """Have a service answered."""
        graph = self._backend.graph
        action, hidden, rest = service.rpartition(CANCELS)
        told = graph.tells(service, request, self._backend.time())
        if told is not None:
            answer(True, told)
        elif hidden and not rest and action in graph.actions:
            self._cancel_meant(action, request, answer)
        else:
            answer(False, f"there is no service {service}; /rosapi/services lists them")

    def start(self, goal: Goal) -> None:
        """Have it pursued."""
        self._goals.add(goal)
        self._backend.start(goal)

    def cancel(self, goal: Goal) -> None:
        """Have it given up."""
        self._backend.cancel(goal)

    def goals_of(self, client: object) -> tuple[Goal, ...]:
        """A client's goals that have not ended."""
        return tuple(goal for goal in self._goals if goal.client is client)

    def _cancel_meant(self, action: str, request: Message, answer: Answer) -> None:
        try:
            code, goals = self._goals.meant(action, request)
        except PacketError as error:
            answer(False, str(error))
            return
        for goal in goals:
            self._backend.cancel(goal)
        if not goals:
            self._backend.settle()
        answer(True, {"return_code": code, "goals_canceling": [goal.info for goal in goals]})
