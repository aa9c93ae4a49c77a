"""What words mean, before anyone has looked whether the things and places in them exist.

`reader.py` makes these values of what a person says; names are still the person's words.
"""

from dataclasses import dataclass, field, replace
from enum import StrEnum

from executive.types.commands import ALL, CommandKind


class Relation(StrEnum):
    """How a thing is, or is to be, with respect to furniture, a room or another thing."""

    AT = "at"
    ON = "on"
    ON_TOP_OF = "on_top_of"
    IN = "in"
    UNDER = "under"
    NEXT_TO = "next_to"
    BEHIND = "behind"
    IN_FRONT_OF = "in_front_of"
    ABOVE = "above"
    LEFT_OF = "left_of"
    RIGHT_OF = "right_of"
    BETWEEN = "between"

    @property
    def is_plain(self) -> bool:
        """Whether it says no more than that it is there: on furniture, or in it."""
        return self in (Relation.AT, Relation.ON, Relation.IN)


@dataclass(frozen=True, slots=True)
class Where:
    """A place as it was said: furniture, a room, a person, or (as in `next_to`) a thing."""

    words: str
    relation: Relation = Relation.AT
    pronoun: bool = False
    """Whether it has to be known from before: "there", "next to it"."""
    within: "Where | None" = None
    """Where this place or person is, by the words: "the table in the kitchen"."""
    others: tuple["Where", ...] = ()
    """Where it may be instead: "in the kitchen or in the bedroom"."""


ME = Where("me")
"""The person who speaks."""
THERE = ("there", "over there")
"""Words for a place that was spoken of."""


@dataclass(frozen=True, slots=True)
class Thing:
    """A thing, or several of one kind, as they were said.

    Attributes:
        words: its name and properties, without determiners: "yellow bottle"; empty for "something".
        number: how many; None if that was not said.
        purpose: what it is for: "drink from"; empty if that was not said.
        pronoun: "it", "them", "another one": it has to be known from before.
        other: another one than before.
        exceptions: what it is not to be: "anything but a banana".
        alone: of such an exception, whether it is not to be touched at all: "and leave the pear".
        definite: "the mug" is a certain one, "a mug" is any.
        place_in_list: which of those that were spoken of: the first is 1, the last is -1.
        superlative: which of them by a measure: "biggest"; empty if that was not said.
        said: all of this as it was said, but for articles and exceptions: "two mugs".
    """

    words: str = ""
    number: int | None = None
    purpose: str = ""
    pronoun: bool = False
    other: bool = False
    exceptions: tuple["Thing", ...] = ()
    definite: bool = False
    place_in_list: int | None = None
    superlative: str = ""
    alone: bool = False
    said: str = field(default="", compare=False)

    @property
    def is_so_many(self) -> bool:
        """Whether it stands for a certain number of things: "both of them", not "two of them"."""
        return self.pronoun and self.definite and (self.number or 0) > 1


@dataclass(frozen=True, slots=True)
class Things:
    """Several things, of which all are meant, or one, or as many as `number` says."""

    members: tuple[Thing, ...]
    one_of: bool = False
    number: int = 1
    in_order: bool = False
    """Whether the words say that this is the order: "the mug, then the pear"."""

    @property
    def exceptions(self) -> tuple[Thing, ...]:
        """What none of them is to be."""
        return tuple(but for thing in self.members for but in thing.exceptions)

    def without(self, left_out: tuple[Thing, ...]) -> "Things":
        """The same, and none of them is to be one of these."""
        members = (replace(t, exceptions=(*t.exceptions, *left_out)) for t in self.members)
        return replace(self, members=tuple(members)) if left_out else self


EVERYTHING = Things((Thing(number=ALL, definite=True, said="everything"),))


@dataclass(frozen=True, slots=True)
class Task:
    """One thing to do.

    Attributes:
        verb: what to do.
        things: with what; None for "go to the kitchen".
        source: where it is, by the words; None if they do not say.
        goal: where to, or to whom; None if they do not say.
        unless: what to do instead if there is none.
        sought: of a condition: what has to be there, and where; None if it is `things` itself.
        conditional: whether it is to be done only if there is such a thing.
        said: the verb as it was said.
    """

    verb: CommandKind
    things: Things | None = None
    source: Where | None = None
    goal: Where | None = None
    conditional: bool = False
    sought: "Task | None" = None
    unless: "Task | None" = None
    said: str = field(default="", compare=False)

    def without(self, left_out: tuple[Thing, ...]) -> "Task":
        """The same less some things; what names none is done with all but these."""
        if not left_out:
            return self
        return replace(self, things=(self.things or EVERYTHING).without(left_out))


SO = Task(CommandKind.CHECK, said="so")
"""The condition of "if so, bring it": what was asked before."""


# --- what may be said ---


@dataclass(frozen=True, slots=True)
class Request:
    """Tasks, in the order in which they were said."""

    tasks: tuple[Task, ...]
    first: bool = False
    """Whether it is to be done before what is under way: "bring it first"."""
    agrees: bool = False
    """Whether it begins with a yes: "okay, bring it"."""
    later: bool = False
    """Whether it is not to be done now, but after what is under way: "bring it later"."""


@dataclass(frozen=True, slots=True)
class Refusal:
    """Something is not to be done: "do not touch the hammer".

    Attributes:
        words: what.
        more: whether something else may be asked for behind it, which is not clear.
    """

    words: str
    more: bool = False


@dataclass(frozen=True, slots=True)
class Unable:
    """A deed that no robot of ours does: "throw the ball"."""

    verb: str
    rest: str = ""
    instead: str = field(default="", compare=False)
    """What can be done with things instead, as a clause; empty if nothing can."""
    more: bool = field(default=False, compare=False)
    """Whether something else is to be done, too."""


@dataclass(frozen=True, slots=True)
class Again:
    """The same once more: "do that again"."""


@dataclass(frozen=True, slots=True)
class Correction:
    """Not that, but this: "no, the banana"; or that and this: "and the pear".

    Attributes:
        meant: what is meant; things only: the deed is that of before. None if only a place is.
        wrong: what is not meant, if it was said.
        source: where it is instead: "no, from the desk".
        goal: where it is to go instead: "no, to the kitchen".
        place: one of these two: "no, in the kitchen".
        left_out: what of it is not meant: "to the desk, but not the pear".
        adds: whether what was meant before still is.
        denies: whether it begins with a no.
    """

    meant: "Request | Things | None" = None
    wrong: Things | None = None
    source: Where | None = None
    goal: Where | None = None
    place: Where | None = None
    left_out: tuple[Thing, ...] = ()
    adds: bool = False
    denies: bool = False


class About(StrEnum):
    """What a question to the robot about itself is about."""

    ABILITIES = "abilities"
    DOING = "doing"
    HAND = "hand"
    WHERE_PUT = "where_put"
    WHERE = "where"
    KNOWN = "known"
    """What is known of things, without looking: which there are, and where they usually are."""
    WHERE_FOUND = "where_found"
    DONE = "done"
    """What came of what was asked for last."""
    ASKED = "asked"
    """What that was."""
    REMEMBERED = "remembered"
    """Where things are, as far as was seen and heard."""
    WHY = "why"
    SELF = "self"


@dataclass(frozen=True, slots=True)
class Question:
    """A question that needs no deed to be answered."""

    about: About
    words: str = ""
    things: Things | None = None


@dataclass(frozen=True, slots=True)
class Statement:
    """Where something is, or is not, as the person says; and `more` said in the same breath."""

    things: Things
    where: Where
    denied: bool = False
    """Whether it is said that it is not there."""
    more: "Statement | None" = None


class Choice(StrEnum):
    """An answer that picks without naming."""

    YES = "yes"
    NO = "no"
    UNKNOWN = "unknown"
    """The person does not know, or will not say."""
    ANY = "any"
    NEAREST = "nearest"
    """Any, by what takes least time."""
    ALL = "all"
    BOTH = "both"


@dataclass(frozen=True, slots=True)
class Answer:
    """What may answer a question that is open."""

    choice: Choice | None = None
    place_in_list: int | None = None
    """The first is 1, the last is -1."""
    things: Things | None = None
    where: tuple[Where, ...] = ()
    told: bool = field(default=False, compare=False)
    """Of a place, whether it is said as a statement is: "it is on the sofa"."""
    first: bool = False
    """Whether it is wanted before others: "the mug first"."""


class Courtesy(StrEnum):
    """What is said for its own sake."""

    HELLO = "hello"
    THANKS = "thanks"
    GOODBYE = "goodbye"


@dataclass(frozen=True, slots=True)
class Unread:
    """What the grammar cannot read; `at` is the word where it gave up, which `begins` there."""

    words: str
    at: str = ""
    begins: int = field(default=-1, compare=False)


Said = (
    Request
    | Refusal
    | Unable
    | Again
    | Correction
    | Question
    | Statement
    | Answer
    | Courtesy
    | Unread
)
