"""Look around at places to see what is there: for questions, and for tasks with several things."""

from collections.abc import Callable, Mapping
from dataclasses import replace

import numpy as np
from py_trees.behaviour import Behaviour
from py_trees.common import Status

from executive.language.commands import THING
from executive.language.wording import Wording, listed
from executive.records import Activity
from executive.situation import candidates_from
from executive.situation.looks import alike
from executive.types.home import DELIVERY
from executive.types.knowledge import Candidate, Source
from executive.types.perception import Detection
from executive.types.results import Result, Saw
from trees.context import MissionContext
from trees.driving import Visit
from trees.expected import seen_soonest, whereabouts
from trees.looking import LookAtCandidate, SeeTarget
from trees.meant import things_meant
from trees.nodes import EachOf, Optionally, Step, sequence
from trees.place_words import is_place, places_in, unknown_place
from trees.telling import tell
from trees.unknown import nearest, unresolved


def survey(context: MissionContext, enough: Callable[[], bool] = lambda: False) -> Behaviour:
    """Look at the places in the words until it is `enough`, or all is seen.

    Writes `situation.survey`. A place that cannot be reached is skipped; if all are, it fails.
    """
    situation = context.situation

    def choose(candidate: Candidate) -> None:
        situation.search.candidate = candidate

    return sequence(
        "look around",
        KnowsWhatToLookFor("knows what", context),
        KnowsWhereToLook("knows where", context),
        EachOf(
            "each place",
            lambda: situation.search.candidates,
            EachOf(
                "unless it is enough",
                lambda: [] if enough() else [None],
                look_at_all(context),
            ),
            choose=choose,
        ),
        SawSomething("saw some place", context),
    )


def look_at_all(context: MissionContext) -> Behaviour:
    """Drive to the current place and look at all of it, if possible; always succeeds."""
    situation = context.situation

    def views() -> range:
        assert situation.search.candidate
        place = situation.search.candidate.place
        parts = context.robot.views(place)
        situation.search.looks.begin(place, parts)
        situation.survey.look_at(place)
        return range(parts)

    def choose(view: int) -> None:
        situation.search.view = view

    return Optionally(
        "if it can be seen",
        situation,
        sequence(
            "look at all of it",
            Visit("drive", context),
            EachOf(
                "each view",
                views,
                sequence("glance", LookAtCandidate("aim", context), SeeAll("see", context)),
                choose=choose,
            ),
            RememberWhatIsGone("remember", context),
            activity=Activity.SEARCHING,
        ),
    )


class SeeAll(SeeTarget):
    """Takes a picture and keeps all that is in it with enough confidence.

    Reads search.candidate and search.view; writes survey.seen and search.looks.
    """

    def ended(self, result: Result) -> Status:
        """Note each thing and its place, which may be other furniture behind this place."""
        search, survey = self.situation.search, self.situation.survey
        assert search.candidate
        if not isinstance(result, Saw):
            return self.failed(result)
        self._remember(result.detections)
        for seen in result.detections:
            if seen.confidence >= self.context.parameters.min_confidence:
                survey.see(self._where(seen).place, seen.label)
                lengths = lengths_of(seen)
                survey.lengths[seen.label] = max(lengths, survey.lengths.get(seen.label, ()))
        search.looks.without(search.candidate.place, search.view)
        return self.succeed(", ".join(survey.seen[search.candidate.place]))


class RememberWhatIsGone(Step):
    """Remembers that what was believed to be here, and was not seen, is gone; always succeeds.

    Reads search.candidate, search.looks and survey.seen.
    """

    def update(self) -> Status:
        """Conclude only if every view of the place was seen."""
        search, seen = self.situation.search, self.situation.survey.seen
        assert search.candidate
        place, facts = search.candidate.place, self.context.facts
        if search.looks.all_without(place):
            believed = [name for name, places in facts.beliefs().items() if place in places]
            for name in believed:
                if name not in seen[place]:
                    facts.missed(name, place)
            facts.looked(place)
        return Status.SUCCESS


class KnowsWhatToLookFor(Step):
    """Succeeds if the words name known things; without any, the survey is about everything.

    Reads request.command; writes survey.about.
    """

    def update(self) -> Status:
        """Look the words up."""
        command = self.situation.request.command
        assert command
        if not command.target:
            return self.succeed("everything")
        about = things_meant(self.context, command)
        if not about:
            near = nearest(self.context, command.target)
            return self.fail(unresolved(self.context, command.target, near))
        self.situation.survey.about = about
        return self.succeed(", ".join(about))


class KnowsWhereToLook(Step):
    """Succeeds if the words name places of this home; without any, looks everywhere.

    "Everywhere" includes the delivery table.

    Reads request.command and survey.about; writes search.candidates.
    """

    source = Source.USER

    def update(self) -> Status:
        """Order the places so that the things are seen as soon as possible; tell the person."""
        context, command = self.context, self.situation.request.command
        assert command
        places = places_in(context, command.source) if command.source else ()
        if command.source and not (places and is_place(context, command.source)):
            return self.fail(unknown_place(context, command.source))
        everywhere = (*(place.name for place in context.knowledge.places()), DELIVERY)
        anywhere = whereabouts(context, replace(command, source=""))
        order = seen_soonest(context, [anywhere.of(place) for place in places or everywhere])
        self.situation.search.candidates = candidates_from(order, Source.USER)
        where = listed(context.say.at_each(order)) if places else "everywhere"
        tell(context, f"I look {where}.")
        return self.succeed(", ".join(order))


class SawSomething(Step):
    """Fails if no place could be looked at.

    Reads survey.seen and search.looks.
    """

    def update(self) -> Status:
        """Say why."""
        if self.situation.survey.seen:
            return Status.SUCCESS
        return self.fail(not_seen(self.context))


def not_seen(context: MissionContext) -> str:
    """Which places were not seen, or not all of them, and why, as a clause; empty if all were."""
    looks, say = context.situation.search.looks, context.say
    seen = (p for p in context.situation.survey.seen if p not in looks.unreached)
    in_part = {p: looks.unseen.get(p, "") for p in seen if not looks.all_without(p)}
    clauses = [
        f"I {failed} {listed([say.the(place) for place in places])}" + f": {why}" * bool(why)
        for failed, all_places in (
            ("could not get to", looks.unreached),
            ("did not see all of", in_part),
        )
        for why, places in alike(all_places).items()
    ]
    return "; ".join(clauses)


def found_where(found: Mapping[str, str], say: Wording) -> str:
    """Things and where they are: "the apple and the pear on the desk, the mug on the sofa"."""
    places = dict.fromkeys(found.values())
    groups = (
        f"{listed([say.the(name) for name, at in found.items() if at == place])} {say.at(place)}"
        for place in places
    )
    return listed(tuple(groups)) if len(places) < 3 else ", ".join(groups)


def nothing_there(context: MissionContext) -> str:
    """That none of the things is where the robot looked, as a clause."""
    command = context.situation.request.command
    assert command
    is_about_all = command.target in ("", THING)
    what = "nothing" if is_about_all else f"no {context.say.words(command.target)}"
    places = tuple(context.situation.survey.seen)
    where = context.say.at(places[0]) if len(places) == 1 else "there"
    return f"I see {what} {where if command.source else 'anywhere'}"


def lengths_of(seen: Detection) -> tuple[float, ...]:
    """Lengths along the principal axes of the visible surface (m), longest first; empty if unknown.

    Each is the length of a uniform bar with the same variance: L = sqrt(12 var). For a square, it
    is the same for any choice of axes.
    """
    count = len(seen.points)
    if count < 3:
        return ()
    spread = np.linalg.svd(seen.points - seen.points.mean(axis=0), compute_uv=False)
    return tuple(float(length) for length in spread * np.sqrt(12 / count))
