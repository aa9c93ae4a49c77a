"""An experimenter's control over the places that the robot chooses."""

from dataclasses import dataclass, field
from enum import StrEnum

from executive.situation.snapshot import logged_as


class For(StrEnum):
    """The purpose of a chosen place."""

    LOOK = "look"
    PUT = "put"


@dataclass(frozen=True, slots=True)
class Choice:
    """A place that the robot has chosen.

    Attributes:
        to: the purpose.
        among: the alternatives; empty if it could be any place of the home.
    """

    to: For
    place: str
    among: tuple[str, ...] = ()


@dataclass
class Steering:
    """Whether choices wait for an experimenter, and what they decided; it outlives tasks."""

    holds: bool = field(default=False, metadata=logged_as("holds_places"))
    choice: Choice | None = field(default=None, metadata=logged_as("held_choice"))
    """The choice that waits; None if there is none."""
    instead: str = field(default="", metadata=logged_as("chosen_instead"))
    """The place that the experimenter chose for it, not yet applied; empty if there is none."""

    def wait(self, choice: Choice | None) -> None:
        """Set the choice that waits, or None, and forget the decision about the one before."""
        self.choice, self.instead = choice, ""
