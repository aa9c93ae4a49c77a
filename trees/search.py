"""Go and look: where it was, where it may be, where the person says, until the thing is seen."""

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from executive.records import Activity
from executive.types import Candidate
from trees.context import MissionContext
from trees.location import resolve_location
from trees.nodes import Check, FirstOf, Step, fallback, sequence
from trees.person import Announce, AskWhere
from trees.recall import MemoryKnowsPlaces, Recall
from trees.robot import LookAtCandidate, LookCloser, SeeTarget, Visit


def search(context: MissionContext) -> Behaviour:
    """An object -> `situation.search.detection` and `situation.search.found`."""
    situation = context.situation

    def look(name: str, *candidates: Behaviour) -> Behaviour:
        return sequence(name, *candidates, Announce("announce", context), visit_candidates(context))

    return fallback(
        "search",
        Check("in my hand", context, lambda: situation.hand.in_hand == situation.request.object),
        look("look where it was", MemoryKnowsPlaces("memory knows it", context)),
        *(
            look(f"look where the {source.name} says", Recall("it knows a place", context, source))
            for source in context.sources
        ),
        look("look where it may be", resolve_location(context)),
        look(
            "look where the person says",
            Check("person may help", context, lambda: not situation.dialogue.no_help),
            AskWhere("ask where", context),
        ),
        GiveUpSearch("not found", context),
    )


def eyes_for_it(context: MissionContext) -> tuple[Behaviour, ...]:
    """What stops a search that would be in vain; nothing if perception recognises everything."""
    return (Recognises("would recognise it", context),) if context.blind_to else ()


def visit_candidates(context: MissionContext) -> Behaviour:
    """Drive from candidate to candidate and look, until the thing is seen."""

    def choose(candidate: Candidate) -> None:
        context.situation.search.candidate = candidate

    return FirstOf(
        "visit",
        lambda: context.situation.search.candidates,
        choose,
        sequence(
            "go and look",
            Visit("drive", context),
            look_over(context),
            activity=Activity.SEARCHING,
        ),
    )


def look_over(context: MissionContext) -> Behaviour:
    """Look at every part of the place until the thing is seen; remember if it is not there."""

    def views() -> range:
        assert context.situation.search.candidate
        place = context.situation.search.candidate.place
        parts = context.robot.views(place)
        context.situation.search.looks.begin(place, parts)
        return range(parts)

    def choose(view: int) -> None:
        context.situation.search.view = view

    return fallback(
        "look over",
        FirstOf(
            "each view",
            views,
            choose,
            sequence("glance", LookAtCandidate("aim", context), see(context)),
        ),
        NotHere("not here", context),
    )


def see(context: MissionContext) -> Behaviour:
    """Look for the thing; what is not sure, or not wholly in the picture, is looked at closer."""
    return fallback(
        "look hard",
        SeeTarget("see", context),
        sequence(
            "look twice",
            Check("perhaps it is", context, lambda: context.situation.search.doubtful is not None),
            LookCloser("aim closer", context),
            SeeTarget("see closer", context, closer=True),
        ),
    )


class Recognises(Step):
    """Fails if the thing would not be recognised if it were in view."""

    def update(self) -> Status:
        """What is in the hand need not be."""
        name = self.situation.request.object
        if name in self.context.blind_to and name != self.situation.hand.in_hand:
            return self.fail(f"I would not recognise the {name}: my detector does not know it")
        return Status.SUCCESS


class NotHere(Step):
    """Remembers that the thing is not here, if every part of the place was seen; always fails.

    Reads search.candidate, search.looks and search.detection; writes search.gone.
    """

    def update(self) -> Status:
        """Only what was looked at can be known."""
        name, search = self.situation.request.object, self.situation.search
        assert name
        assert search.candidate
        place = search.candidate.place
        if not search.looks.all_without(place):
            return self.fail(search.looks.why_not_all(name, place))
        self.context.facts.missed(name, place)
        search.gone = search.detection is not None
        return self.fail(f"no {name} at {place}")


class GiveUpSearch(Step):
    """Fails, and says where the thing was looked for.

    Reads search.looks and dialogue.no_help.
    """

    def update(self) -> Status:
        """Sum up the search, and why the person could not help if they were asked."""
        name, silence = self.situation.request.object, self.situation.dialogue.no_help
        so_far = self.situation.search.so_far(name) or f"I do not know where the {name} is"
        return self.fail(f"{so_far}, and {silence}" if silence else so_far)
