"""What is done where a home has more furniture than a language model can be told of at once."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import accumulate, chain, zip_longest

from executive.types.home import Place
from executive.types.results import Scored

BYTES_PER_TOKEN = 3
"""A careful estimate; counting would wait for the model to be loaded."""
SHARE_FOR_THE_HOME = 0.5
"""Of the context window: the other half is left to the reply (paper, section "Memory")."""
SHARE_FOR_A_LIST = 0.3
MOST_OPTIONS = 200
"""Places that are scored one by one; more would take minutes."""


def fits(text: str, context_tokens: int) -> bool:
    """Whether a text leaves enough of a context window free."""
    return len(text.encode()) / BYTES_PER_TOKEN <= context_tokens * SHARE_FOR_THE_HOME


def as_many_as_fit(names: Sequence[str], context_tokens: int) -> list[str]:
    """The first of the names, as many as a question has room for."""
    room = int(context_tokens * BYTES_PER_TOKEN * SHARE_FOR_A_LIST)
    lengths = accumulate(len(name.encode()) + len(", ") for name in names)
    return [name for name, length in zip(names, lengths, strict=True) if length <= room]


def of_all_kinds(places: Sequence[Place]) -> list[str]:
    """The names, one of each kind first, then a second one, ..."""
    kinds: dict[str, list[str]] = {}
    for place in places:
        kinds.setdefault(place.kind, []).append(place.name)
    rounds = zip_longest(*kinds.values())
    return [name for name in chain.from_iterable(rounds) if name is not None]


@dataclass(frozen=True, slots=True)
class Alike:
    """Places that the model could tell apart by their number only; the first stands for all.

    Attributes:
        groups: the first of each group -> all of it.
        few: whether each place stands for itself, in a home that is not large.
        firsts: each place -> the first of its group.
    """

    groups: dict[str, tuple[Place, ...]]
    few: bool
    firsts: dict[str, str]

    @classmethod
    def among(cls, places: Sequence[Place]) -> "Alike":
        """Groups of places of one kind in one kind of room."""
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
        """For each group the place that is asked about, without what tells it from the others."""
        firsts = [group[0] for group in self.groups.values()]
        if self.few:
            return firsts
        return [Place(p.kind, p.kind, p.room_kind, p.room_kind) for p in firsts]

    def stands_for(self, name: str) -> str:
        """The first of the group that a place is in; itself if it is in none."""
        return self.firsts.get(name, name)

    def apart(self, scored: Scored) -> Scored:
        """The same with all places of each group, which are as likely as the first."""
        pairs = zip(scored.request.places, scored.scores, strict=True)
        all_of = [(p.name, score) for first, score in pairs for p in self.groups[first]]
        request = replace(scored.request, places=tuple(name for name, _ in all_of))
        return replace(scored, request=request, scores=tuple(score for _, score in all_of))
