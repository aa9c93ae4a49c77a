"""What the robot saw on a look around."""

from dataclasses import dataclass, field

from executive.situation.snapshot import NOT_LOGGED


@dataclass
class Survey:
    """What a look around has seen; `Search.looks` knows which places were seen completely."""

    about: tuple[str, ...] | None = None
    """The things to look for; None: everything."""
    seen: dict[str, tuple[str, ...]] = field(default_factory=dict)
    """Each place that was looked at, and what was surely seen there."""
    lengths: dict[str, tuple[float, ...]] = field(default_factory=dict, metadata=NOT_LOGGED)
    """Extents of each thing's visible part along three axes (metres), the longest first."""

    def look_at(self, place: str) -> None:
        """Note that the robot looks at the place."""
        self.seen.setdefault(place, ())

    def see(self, place: str, name: str) -> None:
        """Note that this thing was seen at the place."""
        there = self.seen.get(place, ())
        if name not in there:
            self.seen[place] = (*there, name)

    @property
    def found(self) -> dict[str, str]:
        """The wanted things that were seen, each with its place."""
        return {
            name: place
            for place, names in self.seen.items()
            for name in names
            if self.about is None or name in self.about
        }
