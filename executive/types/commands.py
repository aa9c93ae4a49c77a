"""What the robot is asked to do."""

from dataclasses import dataclass
from enum import StrEnum

from executive.types.home import DELIVERY, PERSON

HELD = "it"
"""As a target: whatever the hand holds."""
ALL = -1
"""As a number of things: each one that there is."""


@dataclass(frozen=True, slots=True)
class Meaning:
    """What a verb asks of the robot, as far as others than its own subtree have to know it.

    Attributes:
        searches: whether it is about a thing that has to be found first.
        grasps: whether the robot has to pick that thing up.
        ends_at: where the robot is in the end, and the thing with it if it grasps: `PERSON`,
            `DELIVERY`; None: where the thing was found.
        at_goal: whether it is at the command's goal instead.
    """

    searches: bool = True
    grasps: bool = False
    ends_at: str | None = None
    at_goal: bool = False

    @property
    def carries(self) -> bool:
        """Whether the thing is in another place in the end."""
        return self.grasps and (self.at_goal or self.ends_at is not None)


class CommandKind(StrEnum):
    """What the person wants done with the thing: the verb, and what it means."""

    means: Meaning

    FIND = "find", Meaning(ends_at=PERSON)
    TAKE = "take", Meaning(grasps=True)
    BRING = "bring", Meaning(grasps=True, ends_at=DELIVERY)
    PUT_DOWN = "put_down", Meaning(searches=False)
    """What is in the hand, by the person."""
    PUT = "put", Meaning(grasps=True, at_goal=True)
    """On the furniture, or in the room, that the goal names."""
    PUT_BACK = "put_back", Meaning(grasps=True, at_goal=True)
    """Where it was taken from."""
    GO = "go", Meaning(searches=False, at_goal=True)
    """The robot itself, to the goal."""
    COUNT = "count", Meaning(searches=False, ends_at=PERSON)
    """How many there are."""
    TELL = "tell", Meaning(searches=False, ends_at=PERSON)
    """What is at a place."""
    CHECK = "check", Meaning(searches=False, ends_at=PERSON)
    """Whether a thing is there."""
    CLEAR = "clear", Meaning(searches=False)
    """A piece of furniture, of all that is seen on it: each thing goes where it belongs."""

    def __new__(cls, verb: str, means: Meaning = Meaning()) -> "CommandKind":
        """The verb itself is the value: it stands in recordings."""
        kind = str.__new__(cls, verb)
        kind._value_ = verb
        kind.means = means
        return kind


SEARCHING = tuple(kind for kind in CommandKind if kind.means.searches and not kind.means.at_goal)
"""The deeds that are about a thing and nothing else: a language model may read these into words."""


@dataclass(frozen=True, slots=True)
class Command:
    """A request that was understood: do `kind` to whatever `target` names."""

    kind: CommandKind
    target: str
    words: str
    source: str = ""
    """Where the thing is, by the words; empty if they do not say."""
    goal: str = ""
    """Where it is to go, by the words; empty if that is left to the verb."""
    purpose: str = ""
    """What it is for, by the words ("drink from"), which are in the target, too."""
    exceptions: tuple[str, ...] = ()
    """What is not meant: "anything but a banana"."""
    number: int = 0
    """How many things: `ALL` that there are; 0: as many as the target names."""
    among: tuple[str, ...] = ()
    """Names of which one is meant, or as many as the number says: "the hammer or the drill"."""
    superlative: str = ""
    """Which of them by a measure: "biggest"; empty if that was not said."""
    plural: bool = False
    """Whether all are meant, if there are several: "the fruits". No recording keeps this."""
    conditional: bool = False
    """Whether it is to be done only if there is such a thing, or what is `sought` is so."""
    sought: "Command | None" = None
    """Of a condition: what is to be looked for first; None: the thing itself."""
    unless: "Command | None" = None
    """What is to be done instead if there is none; None: nothing."""

    @property
    def is_plural(self) -> bool:
        """Whether several tasks have to be made of it, or one of several."""
        several = self.number > 1 or self.number == ALL or bool(self.among)
        return self.conditional or (several and self.kind.means.searches)


Commands = tuple[tuple[Command, ...], ...]
"""Tasks in the order in which they are to be done; those of one tuple inside in any order."""
