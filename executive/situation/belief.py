"""The state of a search by belief and plan: where the thing may be, and what to do next."""

from dataclasses import dataclass, field
from typing import Any

from executive.belief import Belief, Statement
from executive.plan import Plan
from executive.situation.looks import Looks
from executive.situation.snapshot import NOT_LOGGED, logged_as

MOST_LOGGED = 20
"""The log keeps this many places of a belief, the likeliest."""


def _plain(belief: Belief) -> dict[str, Any]:
    """A belief as JSON for the log."""
    return {
        "places": [
            {
                "place": likely.place,
                "probability": round(likely.probability, 4),
                "shares": {s.source: round(s.probability, 4) for s in likely.shares},
            }
            for likely in belief.places[:MOST_LOGGED]
        ],
        "elsewhere": round(belief.elsewhere, 4),
    }


def _plan(plan: Plan | None) -> dict[str, Any] | None:
    """A plan as JSON for the log."""
    return {"order": list(plan.order), "ask_after": plan.ask_after} if plan else None


@dataclass(frozen=True, slots=True)
class Leg:
    """A drive between two places that is going on, or was broken off.

    Attributes:
        start: the place where it began.
        place: its goal.
        since_s: when it began (mission time, s).
        driven_s: how long it lasted (s), if it was broken off; None while it goes on.
    """

    start: str
    place: str
    since_s: float
    driven_s: float | None = None


@dataclass
class Whereabouts:
    """The state of one search by a belief and a plan.

    Attributes:
        belief: where the thing may be, by the statements and the looks so far.
        plan: the best plan for this belief; None before the first.
        away: seconds to drive to each planned place from here and look there.
        statements: what the sources said, the most trusted first.
        named: places that the person, or the memory, named after a look there: worth another.
        consulted: whether the language model was asked in this search.
        thinks: whether the language model is still working on that.
        news: whether a source said something since the plan was made.
        is_fresh: whether the plan was made during a drive and is not yet followed.
        answered: the places that the person gave as their answer in this search.
        announced: the places that the person was told the robot goes to, those still to come.
        is_told: whether the person was told of the next place.
        leg: the drive on which the robot is between two places; None if it is at one.
        is_over: whether nothing is left to look at, and nobody to ask.
    """

    belief: Belief = field(default_factory=Belief, metadata=logged_as(plain=_plain))
    plan: Plan | None = field(default=None, metadata=logged_as(plain=_plan))
    away: dict[str, float] = field(default_factory=dict, metadata=NOT_LOGGED)
    statements: tuple[Statement, ...] = field(default=(), metadata=NOT_LOGGED)
    named: set[str] = field(default_factory=set, metadata=NOT_LOGGED)
    consulted: bool = field(default=False, metadata=NOT_LOGGED)
    thinks: bool = field(default=False, metadata=NOT_LOGGED)
    news: bool = field(default=False, metadata=NOT_LOGGED)
    is_fresh: bool = field(default=False, metadata=NOT_LOGGED)
    answered: tuple[str, ...] = field(default=(), metadata=NOT_LOGGED)
    announced: tuple[str, ...] = field(default=(), metadata=NOT_LOGGED)
    is_told: bool = field(default=False, metadata=NOT_LOGGED)
    leg: Leg | None = field(default=None, metadata=NOT_LOGGED)
    is_over: bool = field(default=False, metadata=NOT_LOGGED)

    def begin(self) -> None:
        """Begin a new search, without statements."""
        self.statements, self.named, self.announced = (), set(), ()
        self.answered, self.consulted, self.is_over = (), False, False
        self.thinks = self.news = self.is_fresh = self.is_told = False
        self.leg = None

    def hear(self, statement: Statement, *, first: bool = False) -> None:
        """Add a statement as the least trusted one, or, if `first`, as the most trusted."""
        others, self.news = self.statements, True
        self.statements = (statement, *others) if first else (*others, statement)

    def may_look_at(self, place: str, looks: Looks) -> bool:
        """Whether to look at a place: it was not tried yet, or was named again since."""
        seen = place in looks.visited or place in looks.unreached
        return place in self.named or not seen

    def is_hidden(self, looks: Looks) -> bool:
        """Whether some place of the person's answer could not be seen, and none is left to try."""
        left = self.named.intersection(self.answered)
        return not left and any(map(looks.failed, self.answered))
