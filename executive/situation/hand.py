"""The state of the robot's hand: what it holds, and where that is put down."""

from dataclasses import dataclass, field

from executive.language.wording import Wording, either
from executive.types.home import SOMETHING


@dataclass
class Hand:
    """What the hand holds, lost and put down."""

    in_hand: str | None = None
    """The thing that the robot holds, since this mission or an earlier one; None if none."""
    felt: bool | None = None
    """Whether the fingers felt something when last asked; None if they cannot tell."""
    reached_for: str = ""
    """The thing that the robot last tried to pick up."""
    lost: str = ""
    """How the thing fell from the hand, as a clause; empty if it did not."""
    spot: str = ""
    """The place where the robot looks for the thing that fell."""
    surfaces: tuple[str, ...] = ()
    """The places where the thing in the hand may be put down, as the person says."""
    surface: str = ""
    """The place that the robot has chosen to put it down."""
    unplaced: dict[str, str] = field(default_factory=dict)
    """The places where the thing in the hand could not be put down, and why."""
    put_at: str = ""
    """The place where the robot put down what it held; empty if it has not."""

    elsewhere: str = ""
    """The same place, if the thing should have gone somewhere else; else empty."""

    def feel(self, holding: bool | None) -> None:
        """Update `in_hand` from what the fingers feel (None: they cannot tell).

        If they feel nothing, the hand is empty. If they feel something in a hand that was empty, it
        is the thing that they reached for.
        """
        self.felt = holding
        if holding is False:
            self.in_hand = None
        elif holding and self.in_hand is None:
            self.in_hand = self.reached_for or SOMETHING

    def not_put_down(self, say: Wording) -> str:
        """Where the held thing could not be put down, and why, as a clause; empty if nowhere."""
        (place, why), *others = self.unplaced.items() or [("", "")]
        if not others:
            return why
        also = either(say.at_each(other for other, _ in others))
        it = say.it(self.in_hand or SOMETHING)
        return f"I could not put {it} {say.at(place)}: {why}; nor {also}"
