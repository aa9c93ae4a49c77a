"""Look on, or ask? Where to look next: the plan that costs least, made anew at every step."""

from collections.abc import Iterable
from itertools import takewhile
from math import inf, isfinite

from py_trees.common import Status

from executive.belief import ANYWHERE, PLAN, Belief, Likely, Statement, in_order
from executive.plan import Chance, Plan, Prices, best_plan
from executive.records import Planned, WaysTold
from executive.types import Candidate, Source
from trees.context import MissionContext
from trees.hearing import PERSON_TRUST, believed
from trees.nodes import Step
from trees.person import AskWhere, who_says
from trees.telling import tell

MOST_PLANNED = 60
"""Among so many places it is planned, the likeliest; the others come in when those are done."""
WORTH_TELLING = 0.01
"""What is less likely is no candidate, unless it is next."""
MOST_TOLD = 3
"""So many places the person is told of at once."""
NOBODY_SAYS = "it may be anywhere", "they may be anywhere"
USUALLY = "it is usually there", "they are usually there"
"""Where the ontology has several default locations."""


class Ways:
    """How long ways take, as the robot told; what was asked anew is recorded, for a replay."""

    def __init__(self, context: MissionContext) -> None:
        """Ask nothing yet."""
        self._context = context
        self._told: dict[str, dict[str, float]] = {}

    def seconds(self, start: str, places: Iterable[str]) -> list[float]:
        """Of the ways from here, and of looking at all of each place (s)."""
        robot, look_s = self._context.robot, self._context.parameters.look_s
        wanted = tuple(places)
        ways = self.driving(start, wanted)
        return [way + look_s * robot.views(p) for p, way in zip(wanted, ways, strict=True)]

    def driving(self, start: str, places: Iterable[str]) -> list[float]:
        """Of the ways alone (s)."""
        told, wanted = self._told.setdefault(start, {}), tuple(places)
        if new := tuple(place for place in wanted if place not in told):
            told |= {place: self._context.robot.seconds(start, place) for place in new}
            ways = tuple(told[p] if isfinite(told[p]) else -1.0 for p in new)
            self._context.recorder.record(WaysTold(start, new, ways))
        return [told[place] for place in wanted]


class PlanNext(Step):
    """Plans; succeeds if the next thing to do is a look, and chooses the place for it.

    Writes search.whereabouts, search.candidates and search.candidate.
    """

    source = PLAN

    def __init__(self, name: str, context: MissionContext, ways: Ways) -> None:
        """Plan with these ways."""
        super().__init__(name, context)
        self._ways = ways

    def update(self) -> Status:
        """Decide by what is known now."""
        whereabouts = self.situation.search.whereabouts
        whereabouts.belief = belief = believed(self.context)
        whereabouts.plan = plan = self._plan(belief)
        whereabouts.is_over = plan.is_over
        said = decision(plan, belief)
        self.context.recorder.record(planned(self.situation.request.object or "", plan, belief))
        if plan.is_over or plan.asks:
            return self.fail(said)
        first, *others = (belief.of(place) for place in plan.order)
        likely = [first, *(other for other in others if other.probability >= WORTH_TELLING)]
        search = self.situation.search
        search.candidates = tuple(Candidate(o.place, o.source, o.probability) for o in likely)
        search.candidate = search.candidates[0]
        whereabouts.named.discard(search.candidate.place)
        return self.succeed(str(first))

    def _plan(self, belief: Belief) -> Plan:
        search, parameters = self.situation.search, self.context.parameters
        whereabouts, looks = search.whereabouts, search.looks
        worth = [o for o in belief.places if whereabouts.may_look_at(o.place, looks)]
        likely = worth[:MOST_PLANNED]
        places = [one.place for one in likely]
        helps = not (self.situation.dialogue.no_help or whereabouts.answered)
        return best_plan(
            [Chance(one.place, one.probability) for one in likely],
            self._ways.seconds(self.situation.dialogue.at, places),
            [self._ways.seconds(place, places) for place in places],
            Prices(parameters.question_s if helps else inf, parameters.visit_s),
            elsewhere=max(0.0, 1 - sum(one.probability for one in likely)),
        )


def decision(plan: Plan, belief: Belief) -> str:
    """What is decided and why, as a clause."""
    asking, looking = (f"{e.cost:.0f} s" if e else "" for e in (plan.asking, plan.looking))
    if plan.is_over:
        return "I have looked everywhere"
    if plan.asks:
        return (
            f"I ask, because looking on would cost {looking} and asking {asking}"
            if looking
            else "I ask, because there is nowhere left to look"
        )
    why = f"asking would cost {asking} and looking on {looking}" if asking else f"that is {looking}"
    return f"I look at {belief.of(plan.order[0])}: {why}"


def planned(thing: str, plan: Plan, belief: Belief) -> Planned:
    """The record of a decision."""
    expected, asking, looking = plan.expected, plan.asking, plan.looking
    likely: tuple[Likely, ...] = belief.places[:MOST_PLANNED]
    doing = "give up" if plan.is_over else "ask" if plan.asks else "look"
    return Planned(
        thing=thing,
        decision=doing,
        order=plan.order,
        ask_after=-1 if plan.ask_after is None else plan.ask_after,
        seconds=expected.seconds,
        visits=expected.visits,
        questions=expected.questions,
        cost=expected.cost,
        may_ask=asking is not None,
        asking_cost=asking.cost if asking else 0.0,
        may_look=looking is not None,
        looking_cost=looking.cost if looking else 0.0,
        places=tuple(one.place for one in likely),
        probabilities=tuple(one.probability for one in likely),
        says=tuple(", ".join(f"{s.source} {s.probability:.2f}" for s in o.shares) for o in likely),
        elsewhere=belief.elsewhere,
        text=f"{decision(plan, belief)}.",
    )


class AskWhereItIs(AskWhere):
    """Asks where the thing is, and believes the answer.

    Reads request.object and search.looks; writes search.whereabouts.
    """

    def understood(self, answer: str) -> bool:
        """The places that are named are worth a look, even if they had one."""
        before = self.situation.search.candidates
        if not super().understood(answer):
            return False
        search = self.situation.search
        places = [candidate.place for candidate in search.candidates]
        search.candidates = before
        said = Statement(Source.USER, in_order(places), PERSON_TRUST)
        search.whereabouts.hear(said, first=True)
        search.whereabouts.named.update(places)
        search.whereabouts.answered = True
        return True


class TellWhere(Step):
    """Tells where the robot is going to look, and who says so, unless that was told before.

    Reads search.candidates; writes search.whereabouts.
    """

    def update(self) -> Status:
        """Say it."""
        whereabouts = self.situation.search.whereabouts
        first, *_ = candidates = self.situation.search.candidates
        if whereabouts.announced[:1] != (first.place,):
            alike = takewhile(lambda candidate: candidate.source == first.source, candidates)
            whereabouts.announced = tuple(c.place for c in alike)[:MOST_TOLD]
            self._tell(whereabouts.announced, first.source)
        whereabouts.announced = whereabouts.announced[1:]
        return self.succeed(first.place)

    def _tell(self, places: tuple[str, ...], source: str) -> None:
        name, say = self.situation.request.object or "", self.context.say
        usually = self.situation.search.default_locations
        others = {ANYWHERE: NOBODY_SAYS} | ({Source.ONTOLOGY: USUALLY} if usually else {})
        why = who_says(self.context, source, **others)
        where = ", then ".join(say.at_each(places))
        tell(self.context, f"I look for {say.the(name)} {where}: {why}.")
