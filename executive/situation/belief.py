"""What is believed of where the thing is, and what follows from it: to look on, or to ask."""

from dataclasses import dataclass, field
from typing import Any

from executive.belief import Belief, Statement
from executive.plan import Plan
from executive.situation.looks import Looks
from executive.situation.snapshot import NOT_LOGGED, logged_as

MOST_LOGGED = 20
"""So many places of a belief stand in the log, the likeliest."""


def _plain(belief: Belief) -> dict[str, Any]:
    """A belief as JSON can keep it."""
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
    """The order, and the moment to ask."""
    return {"order": list(plan.order), "ask_after": plan.ask_after} if plan else None


@dataclass(frozen=True, slots=True)
class Leg:
    """A drive between two places that is, or was, under way.

    Attributes:
        start: where it began.
        place: where it leads.
        since_s: when it began (mission time).
        driven_s: how long it went on, if it was broken off; None while it goes on.
    """

    start: str
    place: str
    since_s: float
    driven_s: float | None = None


@dataclass
class Whereabouts:
    """One search by a belief and a plan.

    Attributes:
        belief: where the thing may be, as the sources and the looks so far have it.
        plan: what is best to do by that; None before the first.
        away: how long the way from here and the look take of each place that was planned with (s).
        statements: what the sources say, as it was heard, the most trusted first.
        named: places that the person, or the memory, named after they were looked at: worth
            another look.
        consulted: whether the language model was asked in this search.
        thinks: whether it is still thinking about that.
        news: whether somebody said something since the plan was made.
        is_fresh: whether the plan was made on the way, and has still to be taken up.
        answered: where the person said that it is, when asked in this search.
        announced: the places that the person was told of, those that are still to come.
        is_told: whether the person was told of the place that is next.
        leg: the drive by which the robot is between two places; None if it is at one.
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
        """A new search: nothing is said yet."""
        self.statements, self.named, self.announced = (), set(), ()
        self.answered, self.consulted, self.is_over = (), False, False
        self.thinks = self.news = self.is_fresh = self.is_told = False
        self.leg = None

    def hear(self, statement: Statement, *, first: bool = False) -> None:
        """Take in what a source says: after the others, or as that which counts first."""
        others, self.news = self.statements, True
        self.statements = (statement, *others) if first else (*others, statement)

    def may_look_at(self, place: str, looks: Looks) -> bool:
        """Whether a look there is worth it: it was none yet, or it was named since."""
        seen = place in looks.visited or place in looks.unreached
        return place in self.named or not seen

    def is_hidden(self, looks: Looks) -> bool:
        """Whether a place that the person answered with was not to be seen, and none is left."""
        left = self.named.intersection(self.answered)
        return not left and any(map(looks.failed, self.answered))
