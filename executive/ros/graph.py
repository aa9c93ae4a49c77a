"""What a robot offers over the wire: its topics, services and actions, by name.

`Graph` also answers the services of rosbridge's `rosapi`, by which a client sees all this.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from executive.ros.definitions import typedefs
from executive.ros.protocol import Message

CANCELS = "/_action/cancel_goal"
"""Every action has a hidden service of this name, by which anybody may cancel its goals."""
CANCEL_TYPE = "action_msgs/srv/CancelGoal"
FEEDBACK = "/_action/feedback"
"""And a hidden topic, on which everybody hears how its goals get on."""
ROSAPI = {
    "/rosapi/topics": "rosapi_msgs/srv/Topics",
    "/rosapi/topics_for_type": "rosapi_msgs/srv/TopicsForType",
    "/rosapi/topic_type": "rosapi_msgs/srv/TopicType",
    "/rosapi/services": "rosapi_msgs/srv/Services",
    "/rosapi/services_for_type": "rosapi_msgs/srv/ServicesForType",
    "/rosapi/service_type": "rosapi_msgs/srv/ServiceType",
    "/rosapi/service_node": "rosapi_msgs/srv/ServiceNode",
    "/rosapi/service_providers": "rosapi_msgs/srv/ServiceProviders",
    "/rosapi/action_servers": "rosapi_msgs/srv/GetActionServers",
    "/rosapi/action_type": "rosapi_msgs/srv/GetActionType",
    "/rosapi/message_details": "rosapi_msgs/srv/MessageDetails",
    "/rosapi/interfaces": "rosapi_msgs/srv/Interfaces",
    "/rosapi/nodes": "rosapi_msgs/srv/Nodes",
    "/rosapi/node_details": "rosapi_msgs/srv/NodeDetails",
    "/rosapi/publishers": "rosapi_msgs/srv/Publishers",
    "/rosapi/subscribers": "rosapi_msgs/srv/Subscribers",
    "/rosapi/get_param_names": "rosapi_msgs/srv/GetParamNames",
    "/rosapi/get_ros_version": "rosapi_msgs/srv/GetROSVersion",
    "/rosapi/get_time": "rosapi_msgs/srv/GetTime",
}


def absolute(name: str) -> str:
    """A name from the root: some clients leave the first slash out."""
    return name if name.startswith("/") else f"/{name}"


@dataclass(frozen=True)
class Graph:
    """What one node offers: the type of each topic, service and action by its name.

    Attributes:
        node: its own name.
        distro: what it says that it is, where ROS 2 names its distribution.
        published: its topics, without the hidden ones of its actions.
        actions: what it pursues goals of.
    """

    node: str
    distro: str
    published: Mapping[str, str]
    actions: Mapping[str, str]

    @cached_property
    def topics(self) -> dict[str, str]:
        """All of them."""
        hidden = {name + FEEDBACK: f"{kind}_FeedbackMessage" for name, kind in self.actions.items()}
        return {**self.published, **hidden}

    @cached_property
    def services(self) -> dict[str, str]:
        """The hidden ones of its actions, and those that tell what there is."""
        return {**{action + CANCELS: CANCEL_TYPE for action in self.actions}, **ROSAPI}

    def tells(self, service: str, request: Mapping[str, Any], time: Message) -> Message | None:
        """What a service of `rosapi` answers; None if it is none of them.

        `time` is what the robot's clock shows.
        """
        if service not in ROSAPI:
            return None
        return self._of_topics(service, request) or self._of_services(service, request, time)

    def _of_topics(self, service: str, request: Mapping[str, Any]) -> Message:
        topics, topic = self.topics, absolute(str(request.get("topic", "")))
        match service.removeprefix("/rosapi/"):
            case "topics":
                return {"topics": list(topics), "types": list(topics.values())}
            case "topics_for_type":
                return {"topics": _of_type(topics, request)}
            case "topic_type":
                return {"type": topics.get(topic, "")}
            case "publishers":
                return {"publishers": [self.node] if topic in topics else []}
            case "subscribers":
                return {"subscribers": []}
            case "message_details":
                return {"typedefs": typedefs(str(request.get("type", "")))}
            case "interfaces":
                kinds = {*topics.values(), *self.services.values(), *self.actions.values()}
                return {"interfaces": sorted(kinds)}
            case "action_servers":
                return {"action_servers": list(self.actions)}
            case "action_type":
                return {"type": self.actions.get(absolute(str(request.get("action", ""))), "")}
            case _:
                return {}

    def _of_services(self, service: str, request: Mapping[str, Any], time: Message) -> Message:
        services, name = self.services, absolute(str(request.get("service", "")))
        match service.removeprefix("/rosapi/"):
            case "services":
                return {"services": list(services)}
            case "services_for_type":
                return {"services": _of_type(services, request)}
            case "service_type":
                return {"type": services.get(name, "")}
            case "service_node":
                return {"node": self.node if name in services else ""}
            case "service_providers":
                return {"providers": [self.node] if name in services else []}
            case "nodes":
                return {"nodes": [self.node]}
            case "node_details" if request.get("node") == self.node:
                published = {"subscribing": [], "publishing": list(self.topics)}
                return {**published, "services": list(services)}
            case "node_details":
                return {"subscribing": [], "publishing": [], "services": []}
            case "get_ros_version":
                return {"version": 2, "distro": self.distro}
            case "get_time":
                return {"time": time}
            case _:
                return {"names": []}


def _of_type(names: Mapping[str, str], request: Mapping[str, Any]) -> list[str]:
    return [name for name, kind in names.items() if kind == request.get("type")]
