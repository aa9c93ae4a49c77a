"""What is at places, as far as it was seen by looking at all that is there."""

from dataclasses import dataclass, field

from executive.situation.snapshot import NOT_LOGGED


@dataclass
class Survey:
    """What a look around has seen; of which places all was seen, `Search.looks` knows."""

    about: tuple[str, ...] | None = None
    """The things that it is about; None: everything."""
    seen: dict[str, tuple[str, ...]] = field(default_factory=dict)
    """Each place that was looked at, and all that was surely seen there."""
    lengths: dict[str, tuple[float, ...]] = field(default_factory=dict, metadata=NOT_LOGGED)
    """How long each thing is in three directions, as far as it was in view (m), longest first."""

    def look_at(self, place: str) -> None:
        """The place is looked at."""
        self.seen.setdefault(place, ())

    def see(self, place: str, name: str) -> None:
        """It is there."""
        there = self.seen.get(place, ())
        if name not in there:
            self.seen[place] = (*there, name)

    @property
    def found(self) -> dict[str, str]:
        """The things that it is about, as far as they were seen, and where."""
        return {
            name: place
            for place, names in self.seen.items()
            for name in names
            if self.about is None or name in self.about
        }
