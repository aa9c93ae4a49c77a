"""What a robot offers, asked of itself over rosbridge: by the services of rosapi."""

from collections.abc import Iterable

from executive.ros.link import Link, LinkError
from executive.ros.offers import Offers
from executive.ros.protocol import Message
from executive.text import one_line

RIGHT = (
    "see that rosapi runs there, of rosbridge 2.0 or later: "
    "`ros2 launch rosbridge_server rosbridge_websocket_launch.xml` starts it"
)
"""What would be right, where the robot does not tell."""
ASKING_S = 5.0
_FEEDBACK, _MESSAGE = "/_action/feedback", "_FeedbackMessage"
MOST, SAID = 5_000, 60
"""So many names of a kind are looked at; so much of what is wrong is told."""


async def read_offers(link: Link) -> Offers:
    """Ask the robot, by rosapi.

    Raises:
        LinkError: if it does not tell.
    """
    listed = await _ask(link, "topics", "rosapi_msgs/srv/Topics")
    names, kinds = (_names("topics", listed, key) for key in ("topics", "types"))
    if len(names) != len(kinds):
        raise LinkError(f"/rosapi/topics tells {len(names)} topics, but {len(kinds)} types")
    by_name = dict(zip(names, kinds, strict=True))
    served = await _ask(link, "services", "rosapi_msgs/srv/Services")
    # not /rosapi/action_type: it ends rosapi on several distributions of ROS 2
    told = {
        name.removesuffix(_FEEDBACK): kind.removesuffix(_MESSAGE)
        for name, kind in by_name.items()
        if name.endswith(_FEEDBACK)
    }
    actions = {name: told.get(name, "") for name in await _servers(link, told)}
    plain = {name: kind for name, kind in by_name.items() if "/_action/" not in name}
    return Offers(plain, _names("services", served, "services"), actions)


async def _servers(link: Link, seen: Iterable[str]) -> Iterable[str]:
    """The actions that are served; of a rosapi that cannot tell, those whose topics it lists."""
    what = "action_servers"
    try:
        served = await _ask(link, what, "rosapi_msgs/srv/GetActionServers")
    except LinkError:
        if not seen:
            raise
        return seen
    return _names(what, served, what)


async def _ask(link: Link, what: str, kind: str) -> Message:
    try:
        return await link.call(f"/rosapi/{what}", kind, {}, within_s=ASKING_S)
    except LinkError as error:
        has = what.replace("_", " ")
        raise LinkError(f"the robot does not tell which {has} it has: {error}") from None


def _names(service: str, answer: Message, key: str) -> tuple[str, ...]:
    """The list of names under this key of what a service answered."""
    value = answer.get(key)
    names = value[:MOST] if isinstance(value, list) else [value]
    wrong = [one for one in names if not isinstance(one, str)]
    if wrong or not isinstance(value, list):
        what = one_line(str((wrong or names)[0]))[:SAID]
        right = "where a list of names would be right"
        raise LinkError(f"/rosapi/{service} tells {what} as {key}, {right}")
    return tuple(names)
