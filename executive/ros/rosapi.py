"""What a robot offers, asked of itself over rosbridge: by the services of rosapi."""

from executive.ros.link import Link, LinkError
from executive.ros.offers import Offers
from executive.ros.protocol import Message

ASKING_S = 5.0
_FEEDBACK, _MESSAGE = "/_action/feedback", "_FeedbackMessage"
MOST = 5_000
"""So many names of a kind are looked at."""


async def read_offers(link: Link) -> Offers:
    """Ask the robot, by rosapi.

    Raises:
        LinkError: if it does not tell.
    """
    topics = await _ask(link, "topics", "rosapi_msgs/srv/Topics")
    names, kinds = _texts(topics.get("topics")), _texts(topics.get("types"))
    by_name = dict(zip(names, kinds, strict=False))
    services = await _ask(link, "services", "rosapi_msgs/srv/Services")
    servers = await _ask(link, "action_servers", "rosapi_msgs/srv/GetActionServers")
    # not /rosapi/action_type: it ends rosapi on several distributions of ROS 2
    told = {
        name.removesuffix(_FEEDBACK): kind.removesuffix(_MESSAGE)
        for name, kind in by_name.items()
        if name.endswith(_FEEDBACK)
    }
    actions = {name: told.get(name, "") for name in _texts(servers.get("action_servers"))}
    plain = {name: kind for name, kind in by_name.items() if "/_action/" not in name}
    return Offers(plain, _texts(services.get("services")), actions)


async def _ask(link: Link, what: str, kind: str) -> Message:
    try:
        return await link.call(f"/rosapi/{what}", kind, {}, within_s=ASKING_S)
    except LinkError as error:
        raise LinkError(f"the robot does not tell what it has: {error}") from None


def _texts(value: object) -> tuple[str, ...]:
    given = value if isinstance(value, list) else []
    return tuple(one for one in given[:MOST] if isinstance(one, str))
