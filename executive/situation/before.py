"""What earlier missions have left: how things stand when the next one begins."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Self

from executive.language.spoken import NOTHING, Spoken
from executive.types.home import PERSON
from executive.types.outcome import Outcome


@dataclass(frozen=True, slots=True)
class Before:
    """What one mission leaves to the next.

    No recording keeps `stands` and `last`: questions between two missions are answered by them,
    but no mission decides anything by them.

    Attributes:
        in_hand: the thing that the robot holds; None: nothing.
        restless: whether the robot did not do what it was told last: it may not stand still.
        spoken: what was spoken of.
        at: the place that the robot has driven to last.
        stands: where it is, at rest; empty if it was stopped on its way.
        last: what came of the last mission; None if there was none.
    """

    in_hand: str | None = None
    restless: bool = False
    spoken: Spoken = NOTHING
    at: str = PERSON
    stands: str = PERSON
    last: Outcome | None = None

    def to_metadata(self) -> dict[str, str]:
        """As a recording keeps it."""
        return {
            "in_hand": self.in_hand or "",
            "restless": str(self.restless),
            "spoken": self.spoken.to_json(),
            "at": self.at,
        }

    @classmethod
    def from_metadata(cls, metadata: Mapping[str, str]) -> Self:
        """As a recording kept it; older ones do not tell all of it.

        Raises:
            ValueError: if what was spoken of is something else.
        """
        return cls(
            in_hand=metadata.get("in_hand") or None,
            restless=metadata.get("restless") == str(True),
            spoken=Spoken.from_json(metadata.get("spoken", "{}")),
            at=metadata.get("at", PERSON),
        )


FIRST = Before()
"""How things stand before the first mission."""
