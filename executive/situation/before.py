"""The state that one mission leaves to the next."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Self

from executive.language.spoken import NOTHING, Spoken
from executive.types.home import PERSON
from executive.types.outcome import Outcome


@dataclass(frozen=True, slots=True)
class Before:
    """The state that one mission leaves to the next.

    Recordings do not keep `stands` and `last`: they only serve to answer questions between two
    missions, and no mission decides by them.

    Attributes:
        in_hand: the thing that the robot holds; None if it holds nothing.
        restless: whether the robot did not do what it was last told, so that it may still move.
        spoken: what was spoken of.
        at: the place that the robot last drove to.
        stands: the place where it stands; empty if it was stopped on its way.
        last: the outcome of the last mission; None if there was none.
    """

    in_hand: str | None = None
    restless: bool = False
    spoken: Spoken = NOTHING
    at: str = PERSON
    stands: str = PERSON
    last: Outcome | None = None

    def to_metadata(self) -> dict[str, str]:
        """The state as the metadata of a recording keeps it."""
        return {
            "in_hand": self.in_hand or "",
            "restless": str(self.restless),
            "spoken": self.spoken.to_json(),
            "at": self.at,
        }

    @classmethod
    def from_metadata(cls, metadata: Mapping[str, str]) -> Self:
        """The state from the metadata of a recording; missing values, in older ones, get defaults.

        Raises:
            ValueError: if `spoken` is malformed.
        """
        return cls(
            in_hand=metadata.get("in_hand") or None,
            restless=metadata.get("restless") == str(True),
            spoken=Spoken.from_json(metadata.get("spoken", "{}")),
            at=metadata.get("at", PERSON),
        )


FIRST = Before()
"""The state before the first mission."""
