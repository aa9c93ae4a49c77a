"""What a robot offers: its topics, services and actions with their types."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from difflib import get_close_matches


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
    return f"there is {', '.join(near)}" if near else "it has nothing of this type"
