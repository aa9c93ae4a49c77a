"""Handles homes with too much furniture for one prompt of a language model."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import accumulate, chain, zip_longest

from executive.types.home import Place
from executive.types.results import Scored

BYTES_PER_TOKEN = 3
"""A cautious estimate; to count exactly, the model would have to be loaded."""
SHARE_FOR_THE_HOME = 0.5
"""Share of the context window; the other half is for the reply (paper, section "Memory")."""
SHARE_FOR_A_LIST = 0.3
"""Share of the context window for the names in one question."""
MOST_OPTIONS = 200
"""Places that are scored individually; more would take minutes."""


def fits(text: str, context_tokens: int) -> bool:
    """Whether a text leaves enough space in the context window."""
    return len(text.encode()) / BYTES_PER_TOKEN <= context_tokens * SHARE_FOR_THE_HOME


def as_many_as_fit(names: Sequence[str], context_tokens: int) -> list[str]:
    """The first names, as many as fit into a question."""
    room = int(context_tokens * BYTES_PER_TOKEN * SHARE_FOR_A_LIST)
    lengths = accumulate(len(name.encode()) + len(", ") for name in names)
    return [name for name, length in zip(names, lengths, strict=True) if length <= room]


def of_all_kinds(places: Sequence[Place]) -> list[str]:
    """The names, first one of each kind, then a second one of each, and so on."""
    kinds: dict[str, list[str]] = {}
    for place in places:
        kinds.setdefault(place.kind, []).append(place.name)
    rounds = zip_longest(*kinds.values())
    return [name for name in chain.from_iterable(rounds) if name is not None]


@dataclass(frozen=True, slots=True)
class Alike:
    """Groups of places that differ only by their number; the first place represents its group.

    Attributes:
        groups: the first place of each group, and all places of the group.
        few: whether each place is its own group, because the home is not large.
        firsts: each place, and the first place of its group.
    """

    groups: dict[str, tuple[Place, ...]]
    few: bool
    firsts: dict[str, str]

    @classmethod
    def among(cls, places: Sequence[Place]) -> "Alike":
        """Group places of the same kind in the same kind of room."""
        if len(places) <= MOST_OPTIONS:
            return cls._of([(place,) for place in places], few=True)
        found: dict[tuple[str, str], list[Place]] = {}
        for place in places:
            found.setdefault((place.kind, place.room_kind), []).append(place)
        return cls._of([tuple(group) for group in found.values()], few=False)

    @classmethod
    def _of(cls, groups: Sequence[tuple[Place, ...]], *, few: bool) -> "Alike":
        firsts = {place.name: group[0].name for group in groups for place in group}
        return cls({group[0].name: group for group in groups}, few, firsts)

    def spoken_of(self) -> list[Place]:
        """The place to ask about for each group; in a large home, it is told by its kinds alone."""
        firsts = [group[0] for group in self.groups.values()]
        if self.few:
            return firsts
        return [Place(p.kind, p.kind, p.room_kind, p.room_kind) for p in firsts]

    def stands_for(self, name: str) -> str:
        """The first place of the group of a place; the place itself if it has no group."""
        return self.firsts.get(name, name)

    def apart(self, scored: Scored) -> Scored:
        """The scores for all places; each place has the score of its group."""
        pairs = zip(scored.request.places, scored.scores, strict=True)
        all_of = [(p.name, score) for first, score in pairs for p in self.groups[first]]
        request = replace(scored.request, places=tuple(name for name, _ in all_of))
        return replace(scored, request=request, scores=tuple(score for _, score in all_of))
