"""What an experimenter wants of the places that the robot chooses."""

from dataclasses import dataclass, field
from enum import StrEnum

from executive.situation.snapshot import logged_as


class For(StrEnum):
    """What a place is chosen for."""

    LOOK = "look"
    PUT = "put"


@dataclass(frozen=True, slots=True)
class Choice:
    """A place that the robot has chosen.

    Attributes:
        to: what for.
        place: where.
        among: what it could have chosen instead; empty if that is any place of the home.
    """

    to: For
    place: str
    among: tuple[str, ...] = ()


@dataclass
class Steering:
    """Whether choices wait for an experimenter, and what they said; it outlives tasks."""

    holds: bool = field(default=False, metadata=logged_as("holds_places"))
    choice: Choice | None = field(default=None, metadata=logged_as("held_choice"))
    """The choice that waits; None if none does."""
    instead: str = field(default="", metadata=logged_as("chosen_instead"))
    """The place that was said for it, and was not taken up yet."""

    def wait(self, choice: Choice | None) -> None:
        """A choice waits, or none does any more; what was said of another one counts no more."""
        self.choice, self.instead = choice, ""
