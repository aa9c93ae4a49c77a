"""What a robot offers, asked of itself over rosbridge: by the services of rosapi."""

from executive.ros.link import Link, LinkError
from executive.ros.offers import Offers
from executive.text import one_line

ASKING_S = 5.0
_FEEDBACK, _MESSAGE = "/_action/feedback", "_FeedbackMessage"
MOST, SAID = 5_000, 60
"""So many names of a kind are looked at; so much of what is wrong is told."""


async def read_offers(link: Link) -> Offers:
    """Ask the robot, by rosapi.

    Raises:
        LinkError: if it does not tell.
    """
    names, kinds = await _ask(link, "topics", "rosapi_msgs/srv/Topics", "topics", "types")
    if len(names) != len(kinds):
        raise LinkError(f"/rosapi/topics tells {len(names)} topics, but {len(kinds)} types")
    by_name = dict(zip(names, kinds, strict=True))
    (services,) = await _ask(link, "services", "rosapi_msgs/srv/Services", "services")
    kind = "rosapi_msgs/srv/GetActionServers"
    (servers,) = await _ask(link, "action_servers", kind, "action_servers")
    # not /rosapi/action_type: it ends rosapi on several distributions of ROS 2
    told = {
        name.removesuffix(_FEEDBACK): kind.removesuffix(_MESSAGE)
        for name, kind in by_name.items()
        if name.endswith(_FEEDBACK)
    }
    actions = {name: told.get(name, "") for name in servers}
    plain = {name: kind for name, kind in by_name.items() if "/_action/" not in name}
    return Offers(plain, services, actions)


async def _ask(link: Link, what: str, kind: str, *keys: str) -> tuple[tuple[str, ...], ...]:
    """The lists of names that a service answers with under these keys."""
    service = f"/rosapi/{what}"
    try:
        answer = await link.call(service, kind, {}, within_s=ASKING_S)
    except LinkError as error:
        raise LinkError(f"the robot does not tell what it has: {error}") from None
    return tuple(_names(service, key, answer.get(key)) for key in keys)


def _names(service: str, key: str, value: object) -> tuple[str, ...]:
    names = value[:MOST] if isinstance(value, list) else [value]
    wrong = [one for one in names if not isinstance(one, str)]
    if wrong or not isinstance(value, list):
        what = one_line(str((wrong or names)[0]))[:SAID]
        raise LinkError(f"{service} tells {what} as {key}, where a list of names would be right")
    return tuple(names)
