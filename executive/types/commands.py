"""Commands: what the person asks the robot to do."""

from dataclasses import dataclass
from enum import StrEnum

from executive.types.home import DELIVERY, PERSON

HELD = "it"
"""A target: whatever the hand holds."""
ALL = -1
"""A number of things: all that there are."""


@dataclass(frozen=True, slots=True)
class Meaning:
    """What a verb asks of the robot: the properties that code outside its own subtree needs.

    Attributes:
        searches: whether the robot has to find the target first.
        grasps: whether the robot has to pick the target up.
        ends_at: where the robot ends, with the thing if it grasps one: `PERSON` or `DELIVERY`;
            None: where it found the thing.
        at_goal: whether the robot ends at the command's goal instead.
    """

    searches: bool = True
    grasps: bool = False
    ends_at: str | None = None
    at_goal: bool = False

    @property
    def carries(self) -> bool:
        """Whether the robot moves the thing to another place."""
        return self.grasps and (self.at_goal or self.ends_at is not None)


class CommandKind(StrEnum):
    """The verb of a command, with its meaning. The value is the verb, as recordings keep it."""

    means: Meaning

    FIND = "find", Meaning(ends_at=PERSON)
    TAKE = "take", Meaning(grasps=True)
    BRING = "bring", Meaning(grasps=True, ends_at=DELIVERY)
    PUT_DOWN = "put_down", Meaning(searches=False)
    """Put down what is in the hand, near the person."""
    PUT = "put", Meaning(grasps=True, at_goal=True)
    """Put the thing on the furniture, or in the room, that the goal names."""
    PUT_BACK = "put_back", Meaning(grasps=True, at_goal=True)
    """Put the thing where it was taken from."""
    GO = "go", Meaning(searches=False, at_goal=True)
    """Drive to the goal."""
    COUNT = "count", Meaning(searches=False, ends_at=PERSON)
    """Say how many there are."""
    TELL = "tell", Meaning(searches=False, ends_at=PERSON)
    """Say what is at a place."""
    CHECK = "check", Meaning(searches=False, ends_at=PERSON)
    """Say whether a thing is at a place."""
    CLEAR = "clear", Meaning(searches=False)
    """Take everything that is seen on a piece of furniture to where it belongs."""

    def __new__(cls, verb: str, means: Meaning = Meaning()) -> "CommandKind":
        """Make a member whose value is the verb alone."""
        kind = str.__new__(cls, verb)
        kind._value_ = verb
        kind.means = means
        return kind


SEARCHING = tuple(kind for kind in CommandKind if kind.means.searches and not kind.means.at_goal)
"""Kinds that need a thing and no goal: a language model may choose among these."""


@dataclass(frozen=True, slots=True)
class Command:
    """A command that was understood: do `kind` with whatever `target` names."""

    kind: CommandKind
    target: str
    words: str
    source: str = ""
    """Where the thing is, in the person's words; empty if they do not say."""
    goal: str = ""
    """Where it has to go, in the person's words; empty if the verb decides."""
    purpose: str = ""
    """What the thing is for, in the person's words ("drink from"); `target` has them, too."""
    exceptions: tuple[str, ...] = ()
    """What the target excludes: "a banana" in "anything but a banana"."""
    number: int = 0
    """How many things; `ALL`: all that there are; 0: as many as the target names."""
    among: tuple[str, ...] = ()
    """Names to choose from, one or `number` of them: "the hammer or the drill"."""
    superlative: str = ""
    """The measure to choose by: "biggest"; empty if none was said."""
    plural: bool = False
    """Whether the target names all of several things: "the fruits". Recordings do not keep this."""
    conditional: bool = False
    """Whether to do it only if there is such a thing, or if `sought` holds."""
    sought: "Command | None" = None
    """The condition: what to look for first; None: the thing itself."""
    unless: "Command | None" = None
    """What to do instead if the condition does not hold; None: nothing."""

    @property
    def is_plural(self) -> bool:
        """Whether it has to be split into tasks: it has a condition, several things or a choice."""
        several = self.number > 1 or self.number == ALL or bool(self.among)
        return self.conditional or (several and self.kind.means.searches)


Commands = tuple[tuple[Command, ...], ...]
"""Groups of commands: the groups are done in this order, the commands of a group in any order."""
