"""What a robot offers, asked of itself: its topics, services and actions with their types."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from difflib import get_close_matches

from executive.ros.link import Link, LinkError
from executive.ros.protocol import Message

ASKING_S = 5.0
_FEEDBACK, _MESSAGE = "/_action/feedback", "_FeedbackMessage"
MOST = 5_000
"""So many names of a kind are looked at."""


@dataclass(frozen=True)
class Offers:
    """Names and types; the type of an action is empty where nobody tells it."""

    topics: Mapping[str, str] = field(default_factory=dict)
    services: tuple[str, ...] = ()
    actions: Mapping[str, str] = field(default_factory=dict)

    def topics_of(self, kind: str) -> tuple[str, ...]:
        """The topics with messages of this type."""
        return tuple(name for name, one in self.topics.items() if same_type(one, kind))

    def actions_of(self, kind: str) -> tuple[str, ...]:
        """The actions of this type, as far as that is known."""
        return tuple(name for name, one in self.actions.items() if same_type(one, kind))


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


def same_type(one: str, other: str) -> bool:
    """Whether two names of types mean the same: ROS 1 has no middle part."""
    return _short(one) == _short(other)


def _short(kind: str) -> tuple[str, str]:
    return kind.partition("/")[0], kind.rpartition("/")[2]


def likely(name: str, of_type: Iterable[str], others: Iterable[str]) -> str:
    """What may be meant by a name that is not there, as a clause."""
    fits = tuple(of_type)
    if fits:
        return f"of this type there is {', '.join(fits[:5])}"
    near = get_close_matches(name, list(others), n=3, cutoff=0.5)
    return f"there is {', '.join(near)}" if near else "there is none like it"
