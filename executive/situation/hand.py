"""What is in the robot's hand, and where it goes from there."""

from dataclasses import dataclass, field

from executive.language.wording import Wording, either
from executive.types.home import SOMETHING


@dataclass
class Hand:
    """What the hand holds, lost, and has put down."""

    in_hand: str | None = None
    """The thing that the robot holds, from this mission or one before it."""
    felt: bool | None = None
    """Whether the fingers felt a thing when they were asked last; None: they cannot tell."""
    reached_for: str = ""
    """The thing that the robot tried to pick up last."""
    lost: str = ""
    """What happened to the thing that fell from the hand, as a clause; empty if it did not."""
    spot: str = ""
    """Where the robot looks for what fell from its hand."""
    surfaces: tuple[str, ...] = ()
    """Where the person says that the thing in the hand may be put down."""
    surface: str = ""
    """Where the robot is going to put it down."""
    unplaced: dict[str, str] = field(default_factory=dict)
    """Places where what is in the hand could not be put down, and why."""
    put_at: str = ""
    """Where the robot has put down what it held; empty if it has not."""

    elsewhere: str = ""
    """Where that is, if it was to go somewhere else; empty if it was not."""

    def feel(self, holding: bool | None) -> None:
        """What is in the hand is what the fingers feel; its name is that of what they reached for.

        What was in it before stays in it as long as something does, or they cannot tell.
        """
        self.felt = holding
        if holding is False:
            self.in_hand = None
        elif holding and self.in_hand is None:
            self.in_hand = self.reached_for or SOMETHING

    def not_put_down(self, say: Wording) -> str:
        """Where what is in the hand could not be put down, and why, as a clause; empty if so."""
        (place, why), *others = self.unplaced.items() or [("", "")]
        if not others:
            return why
        also = either(say.at_each(other for other, _ in others))
        it = say.it(self.in_hand or SOMETHING)
        return f"I could not put {it} {say.at(place)}: {why}; nor {also}"
