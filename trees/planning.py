"""Look on, or ask? At every step the robot makes the plan that costs least, and does its start."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import takewhile
from math import inf, isfinite

from py_trees.common import Status

from executive.belief import PLAN, Belief, Likely, Statement, in_order
from executive.language.wording import beginning
from executive.plan import Chance, Plan, Prices, best_plan
from executive.records import Planned
from executive.situation import Leg
from executive.types.knowledge import Candidate, Source
from trees.context import MissionContext
from trees.driving import EXPERIMENTER, Visit
from trees.hearing import PERSON_TRUST, believed
from trees.held import HoldWhereToLook
from trees.nodes import Step
from trees.person import AskWhere, who_says
from trees.telling import sentence, tell
from trees.ways import Ways

MOST_RECORDED = 60
"""A record of a plan has this many places of the belief, the likeliest."""
WORTH_TELLING = 0.01
"""A less likely place is no candidate, unless it is the next."""
MOST_TOLD = 3
"""The person is told of this many places at once."""
NOBODY_SAYS = "it may be anywhere", "they may be anywhere"
USUALLY = "it is usually there", "they are usually there"
"""Where the ontology has several default locations."""


class PlanNext(Step):
    """Makes a plan; succeeds if its next step is a look, and chooses the place.

    A plan that was just made on the way (`PlanStands`) is used, and no other made. Writes
    search.whereabouts, search.candidates and search.candidate.
    """

    source = PLAN

    def __init__(self, name: str, context: MissionContext, ways: Ways) -> None:
        """Plan with the durations of these ways."""
        super().__init__(name, context)
        self._ways = ways

    def update(self) -> Status:
        """Plan, unless there is a fresh plan, and follow it."""
        whereabouts = self.situation.search.whereabouts
        if not whereabouts.is_fresh:
            self.plan()
        whereabouts.is_fresh = whereabouts.is_told = False
        return self.follow()

    def plan(self) -> Plan:
        """Make the best plan for what is believed now, and keep both."""
        whereabouts = self.situation.search.whereabouts
        whereabouts.belief = believed(self.context)
        whereabouts.plan = plan = self._plan(whereabouts.belief)
        whereabouts.news = False
        return plan

    def follow(self) -> Status:
        """Record the plan and choose its first place; fail if it says to ask or to give up."""
        search = self.situation.search
        whereabouts = search.whereabouts
        belief, plan = whereabouts.belief, whereabouts.plan
        assert plan
        whereabouts.is_over = plan.is_over
        said = decision(plan, belief)
        thing = self.situation.request.thing
        self.context.recorder.record(planned(thing, plan, belief, whereabouts.away))
        if plan.is_over or plan.asks:
            return self.fail(said)
        first, *others = (belief.of(place) for place in plan.order)
        likely = [first, *(other for other in others if other.probability >= WORTH_TELLING)]
        search.candidates = tuple(Candidate(o.place, o.source, o.probability) for o in likely)
        search.candidate = search.candidates[0]
        whereabouts.named.discard(search.candidate.place)
        return self.succeed(str(first))

    def _plan(self, belief: Belief) -> Plan:
        """The best plan for this belief.

        If nobody can be asked, the probability of places that cannot be reached is spread over the
        others: no plan can do anything about it.
        """
        search, parameters = self.situation.search, self.context.parameters
        whereabouts, looks = search.whereabouts, search.looks
        worth = [o for o in belief.places if whereabouts.may_look_at(o.place, looks)]
        ends = whereabouts.is_hidden(looks) and not whereabouts.thinks
        likely = [] if ends else worth[: parameters.planned]
        places = [one.place for one in likely]
        from_here = self._from_here(places)
        whereabouts.away = dict(zip(places, from_here, strict=True))
        helps = not (self.situation.dialogue.no_help or whereabouts.answered)
        lost = (o for o in belief.places if o.place in looks.unreached and o not in worth)
        reach = 1.0 if helps else 1 - sum(one.probability for one in lost) or 1.0
        return best_plan(
            [Chance(one.place, one.probability / reach) for one in likely],
            from_here,
            [self._ways.seconds(place, places) for place in places],
            Prices(parameters.question_s if helps else inf, parameters.visit_s),
            elsewhere=max(0.0, 1 - sum(one.probability for one in likely) / reach),
        )

    def _from_here(self, places: Sequence[str]) -> list[float]:
        leg = self.situation.search.whereabouts.leg
        if leg is None:
            return self._ways.seconds(self.situation.dialogue.at, places)
        return self._ways.seconds_from_halfway(leg, places)


class PlanStands(PlanNext):
    """Fails if there is news, and the plan with it begins with another place or a question.

    A place that an experimenter chose stands in any case.
    """

    def update(self) -> Status:
        """Plan anew if there is news since the last plan."""
        search = self.situation.search
        assert search.candidate
        if not search.whereabouts.news or search.candidate.source == EXPERIMENTER:
            return self.succeed()
        if not search.whereabouts.may_look_at(search.place, search.looks):
            search.whereabouts.named.add(search.place)  # it was worth a look when chosen
        plan = self.plan()
        if plan.order[:1] == (search.place,) and not plan.asks:
            return self.follow()
        search.whereabouts.is_fresh = True
        return self.fail(f"not on to {search.place}: {decision(plan, search.whereabouts.belief)}")


class HoldAsPlanned(HoldWhereToLook):
    """Waits for the experimenter as `HoldWhereToLook` does; fails if news changes the plan.

    So the experimenter always sees what the robot would do now. Reads and writes
    search.candidate, search.candidates and search.whereabouts.
    """

    def __init__(self, name: str, context: MissionContext, ways: Ways) -> None:
        """Plan with the durations of these ways."""
        super().__init__(name, context)
        self._stands = PlanStands(name, context, ways)

    def update(self) -> Status:
        """Check the plan while waiting, unless the experimenter has chosen another place."""
        waits = self.is_under_way and not self.is_sent_elsewhere
        if waits and self._stands.update() == Status.FAILURE:
            return self.fail(self._stands.feedback_message)
        return super().update()


class DriveAsPlanned(Visit):
    """Drives to a place, and keeps how far it has come: plans on the way begin there.

    Reads search.candidate and search.looks; writes search.looks and search.whereabouts.
    """

    def start(self) -> int:
        """Set out; if the robot stands between two places, the length of the way is unknown."""
        search = self.situation.search
        start, now = self.situation.dialogue.at, self.context.clock.now()
        broken_off = search.whereabouts.leg is not None
        search.whereabouts.leg = None if broken_off else Leg(start, search.place, now)
        return super().start()

    def terminate(self, new_status: Status) -> None:
        """Note the arrival; or if the drive was interrupted, how long it has driven."""
        whereabouts, now = self.situation.search.whereabouts, self.context.clock.now()
        if whereabouts.leg and new_status == Status.INVALID:
            whereabouts.leg = replace(whereabouts.leg, driven_s=now - whereabouts.leg.since_s)
        else:
            whereabouts.leg = None
        super().terminate(new_status)


def decision(plan: Plan, belief: Belief) -> str:
    """What the plan says to do next, and why, as a clause."""
    asking, looking = (f"{e.cost:.0f} s" if e else "" for e in (plan.asking, plan.looking))
    if plan.is_over:
        return "nothing is left that is worth a look"
    if plan.asks:
        return (
            f"I ask, because looking on would cost {looking} and asking {asking}"
            if looking
            else "I ask, because there is nowhere left to look"
        )
    why = f"asking would cost {asking} and looking on {looking}" if asking else f"that is {looking}"
    return f"I look at {belief.of(plan.order[0])}: {why}"


def planned(thing: str, plan: Plan, belief: Belief, away: Mapping[str, float]) -> Planned:
    """The record of a plan."""
    expected, asking, looking = plan.expected, plan.asking, plan.looking
    likely: tuple[Likely, ...] = belief.places[:MOST_RECORDED]
    seconds = (away.get(one.place, inf) for one in likely)
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
        away=tuple(s if isfinite(s) else -1.0 for s in seconds),
    )


class HearOut(Step):
    """Waits for the answer of the language model.

    It is RUNNING although it has started nothing: the model's answer, which another behaviour has
    asked for, will wake the tree.
    """

    def update(self) -> Status:
        """Wait as long as the model thinks."""
        thinks = self.situation.search.whereabouts.thinks
        return Status.RUNNING if thinks else Status.SUCCESS


class AskWhereItIs(AskWhere):
    """Asks where the thing is, and believes the answer.

    Reads request.object and search.looks; writes search.whereabouts and search.looks.
    """

    def start(self) -> int:
        """Ask; the question itself says where the robot has looked in vain."""
        self.situation.search.looks.missed = ""
        return super().start()

    def understood(self, answer: str) -> bool:
        """The named places are worth a look, even if the robot has already looked there."""
        before = self.situation.search.candidates
        if not super().understood(answer):
            return False
        search = self.situation.search
        places = [candidate.place for candidate in search.candidates]
        search.candidates = before
        said = Statement(Source.USER, in_order(places), PERSON_TRUST)
        search.whereabouts.hear(said, first=True)
        search.whereabouts.named.update(places)
        search.whereabouts.answered = tuple(places)
        return True


class TellWhere(Step):
    """Tells where the robot is going to look, and who says so, unless that was already told.

    While the model still ranks the places, nothing is told yet: that takes little time. Reads
    search.candidates; writes search.whereabouts and search.looks.
    """

    def update(self) -> Status:
        """Tell it once; several places at once if the same source names them."""
        whereabouts = self.situation.search.whereabouts
        first, *_ = candidates = self.situation.search.candidates
        ranks = self.context.parameters.elicit == "rank"
        if whereabouts.is_told or (whereabouts.thinks and ranks):
            return self.succeed(first.place)
        whereabouts.is_told = True
        self._tell_missed()
        if whereabouts.announced[:1] != (first.place,):
            alike = takewhile(lambda candidate: candidate.source == first.source, candidates)
            whereabouts.announced = tuple(c.place for c in alike)[:MOST_TOLD]
            if whereabouts.thinks:
                whereabouts.announced = whereabouts.announced[:1]
            self._tell(whereabouts.announced, first.source)
        whereabouts.announced = whereabouts.announced[1:]
        return self.succeed(first.place)

    def _tell_missed(self) -> None:
        looks, name = self.situation.search.looks, self.situation.request.thing
        if looks.missed:
            why_not = looks.why_not(name, looks.missed, self.context.say)
            tell(self.context, sentence(beginning(why_not)))
        looks.missed = ""

    def _tell(self, places: tuple[str, ...], source: str) -> None:
        name, say = self.situation.request.thing, self.context.say
        the, where = say.the(name), ", then ".join(say.at_each(places))
        if self.situation.search.whereabouts.thinks:
            may_be = f"where {say.agree(name, 'it', 'they')} may be"
            tell(self.context, f"I look for {the} {where}, and think about {may_be} meanwhile.")
            return
        usually = self.situation.search.default_locations
        others = {EXPERIMENTER: NOBODY_SAYS} | ({Source.ONTOLOGY: USUALLY} if usually else {})
        why = who_says(self.context, source, **others)
        tell(self.context, f"I look for {the} {where}: {why}.")
