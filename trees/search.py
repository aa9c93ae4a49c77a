"""The search by stages: where the words say, where it was, where it may be; else ask the person."""

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from executive.language.wording import beginning, either
from executive.records import Activity
from executive.situation import candidates_from
from executive.types.knowledge import Candidate, Source
from trees.context import MissionContext
from trees.driving import Visit
from trees.held import HoldWhereToLook
from trees.location import resolve_location
from trees.looking import LookAtCandidate, LookCloser, SeeTarget
from trees.nodes import Check, FirstOf, Step, fallback, sequence
from trees.person import Announce, AskWhere
from trees.recall import MemoryKnowsPlaces, Recall
from trees.telling import tell


def search_by_stages(context: MissionContext) -> Behaviour:
    """The paper's flow: one source after the other, each with its list of places, then the person.

    Reads request.object; the thing that is seen is search.detection, its place search.found.
    """
    situation = context.situation

    def look(name: str, *candidates: Behaviour) -> Behaviour:
        announce = Announce("announce", context)
        elsewhere = may_be_elsewhere(context)
        return sequence(name, elsewhere, *candidates, announce, visit_candidates(context))

    return fallback(
        "search",
        Check("in my hand", context, lambda: situation.hand.in_hand == situation.request.object),
        look_where_the_words_say(context),
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


def look_where_the_words_say(context: MissionContext) -> Behaviour:
    """Look at the place in the words, as in "the mug from the desk"; fails if there is none."""
    situation = context.situation

    def who() -> Source:
        """The person; but the memory, if the robot itself saw the thing there for a larger task."""
        known = set(context.facts.places_of(situation.request.thing))
        seen = situation.agenda.wholes and known & set(situation.request.from_places)
        return Source.MEMORY if seen else Source.USER

    def named() -> list[tuple[Candidate, ...]]:
        places = candidates_from(situation.request.from_places, who())
        new = situation.search.not_visited(places)
        return [new] if new else []

    def choose(candidates: tuple[Candidate, ...]) -> None:
        situation.search.candidates = candidates

    return FirstOf(
        "look where the words say",
        named,
        fallback(
            "there",
            sequence("look", Announce("announce", context), visit_candidates(context)),
            SayNotThere("say it is not there", context),
        ),
        choose=choose,
    )


def may_be_elsewhere(context: MissionContext) -> Check:
    """Whether to look elsewhere, too: not if the thing is meant because the robot saw it there."""
    return Check("it is meant wherever it is", context, lambda: not is_meant_there(context))


def is_meant_there(context: MissionContext) -> bool:
    """Whether the thing is one part of a larger task, one that the robot saw at the named place."""
    wholes = context.situation.agenda.wholes
    whole = wholes[-1].command if wholes else None
    return whole is not None and bool(whole.source) and not (whole.among or whole.conditional)


def eyes_for_it(context: MissionContext) -> tuple[Behaviour, ...]:
    """A check that stops a hopeless search; none if perception recognises everything."""
    return (Recognises("would recognise it", context),) if context.blind_to else ()


def visit_candidates(context: MissionContext) -> Behaviour:
    """Drive from candidate to candidate and look, until the thing is seen."""

    def choose(candidate: Candidate) -> None:
        context.situation.search.candidate = candidate

    return FirstOf(
        "visit",
        lambda: context.situation.search.candidates,
        sequence(
            "go and look",
            HoldWhereToLook("choice", context),
            Visit("drive", context),
            look_over(context),
            activity=Activity.SEARCHING,
        ),
        choose=choose,
    )


def look_over(context: MissionContext) -> Behaviour:
    """Look at every view of the place until the thing is seen; remember if it is not there."""

    def views() -> range:
        place = context.situation.search.place
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
            sequence("glance", LookAtCandidate("aim", context), see(context)),
            choose=choose,
        ),
        NotHere("not here", context),
    )


def see(context: MissionContext) -> Behaviour:
    """Look for the thing; look closer if it is in doubt, or not wholly in the picture."""
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
    """Fails if the thing would not be recognised even in full view."""

    def update(self) -> Status:
        """Succeed if the thing is in the hand: it need not be recognised."""
        name = self.situation.request.object
        if name in self.context.blind_to and name != self.situation.hand.in_hand:
            say = self.context.say
            not_known = f"my detector does not know {say.it(name)}"
            return self.fail(f"I would not recognise {say.the(name)}: {not_known}")
        return Status.SUCCESS


class NotHere(Step):
    """Remembers that the thing is not here, if every view of the place was seen; always fails.

    Reads search.candidate, search.looks and search.detection; writes search.gone.
    """

    def update(self) -> Status:
        """Conclude only from views that were seen; else say why one was not."""
        name, search, say = self.situation.request.object, self.situation.search, self.context.say
        assert name
        place = search.place
        if not search.looks.all_without(place):
            return self.fail(search.looks.why_not(name, place, say))
        self.context.facts.missed(name, place)
        search.gone = search.detection is not None
        return self.fail(f"no {say.words(name)} {say.at(place)}")


class SayNotThere(Step):
    """Tells that the thing is not where the words say; always fails.

    Reads request.from_places, search.looks and agenda.wholes.
    """

    def update(self) -> Status:
        """Tell it if the search goes on; of places that were not seen, say why."""
        name, search = self.situation.request.thing, self.situation.search
        say, places = self.context.say, [c.place for c in search.candidates]
        said = f"{say.are(name)} not {either(say.at_each(places))}"
        if not all(map(search.looks.all_without, places)):
            said = search.so_far(name, say)
        if not is_meant_there(self.context):
            tell(self.context, f"{beginning(said)}. I look further.")
        return self.fail(said)


class GiveUpSearch(Step):
    """Fails, and says where the thing was looked for.

    Reads search.looks and dialogue.no_help.
    """

    def update(self) -> Status:
        """Sum up the search; if the person was asked, say why they could not help."""
        name, silence = self.situation.request.thing, self.situation.dialogue.no_help
        say = self.context.say
        so_far = self.situation.search.so_far(name, say) or f"I do not know where {say.are(name)}"
        return self.fail(f"{so_far}, and {silence}" if silence else so_far)
