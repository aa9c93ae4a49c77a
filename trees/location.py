"""Where may it be? The ontology may know one place, or the language model several; else ask.

This is the flow of the paper's section "Integrated use of ontological knowledge base and LLM". Its
consistency verification is made of behaviours, so that the log shows every step.
"""

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from executive.records import Verified
from executive.situation import Consultation, candidates_from
from executive.types.knowledge import Source
from trees.context import MissionContext
from trees.model import Again, AskFurniture, Inquire, RankPlaces, Summarize
from trees.nodes import Check, EachOf, Optionally, Step, fallback, sequence
from trees.person import AskWhere


def resolve_location(context: MissionContext) -> Behaviour:
    """Find places where the object may be; writes search.candidates, the likeliest first."""
    sources: list[Behaviour] = [OntologyKnowsPlace("ontology knows one place", context)]
    if context.model is not None:
        elicit = rank_places if context.parameters.elicit == "rank" else generate_places
        sources.append(elicit(context))
    return fallback("which places", *sources, AskWhere("ask where", context))


def rank_places(context: MissionContext) -> Behaviour:
    """The model scores the known places, and so cannot invent any."""
    return RankPlaces("llm ranks places", context)


def generate_places(context: MissionContext) -> Behaviour:
    """The model writes a list, and only its real places are kept (the paper's way)."""
    begin = BeginConsultation("begin", context)
    return sequence(
        "llm lists places",
        begin,
        Inquire("inquire", context),
        fallback(
            "read or summarize",
            ReadReply("read", context),
            sequence("repair", Summarize("summarize", context), ReadReply("read again", context)),
        ),
        fallback(
            "verify or ask again",
            existence_check(context),
            sequence(
                "retry",
                Again("again", context),
                ReadReply("read", context),
                existence_check(context),
            ),
        ),
        AdoptFurniture("adopt", context),
    )


def existence_check(context: MissionContext) -> Behaviour:
    """Keep what exists, expand rooms into their furniture; fail if nothing is left."""
    situation = context.situation

    def choose(room: str) -> None:
        situation.search.consultation.room = room

    return sequence(
        "existence check",
        VerifyNames("names exist", context),
        EachOf(
            "each room",
            lambda: tuple(situation.search.consultation.rooms),
            Optionally(
                "if it helps",
                situation,
                sequence(
                    "expand room",
                    AskFurniture("furniture", context),
                    ReadReply("read", context),
                    VerifyFurniture("furniture exists", context),
                ),
            ),
            choose=choose,
        ),
        Check("something is left", context, lambda: bool(situation.search.consultation.furniture)),
    )


class OntologyKnowsPlace(Step):
    """Succeeds if the ontology has just one place for the object, and the robot was not there yet.

    Reads request.object and search.looks; writes search.candidates, or search.default_locations.
    """

    source = Source.ONTOLOGY

    def update(self) -> Status:
        """Look the object up; of several places, the model may say which is likeliest."""
        assert self.situation.request.object
        usual = self.context.knowledge.usual_places(self.situation.request.object)
        if len(usual) == 1 and usual[0] in self.situation.search.looks.visited:
            name, say = self.situation.request.object, self.context.say
            but = say.agree(name, "is its place, but it is", "is their place, but they are")
            return self.fail(f"{say.the(usual[0])} {but} not there")
        if len(usual) == 1:
            self.situation.search.candidates = candidates_from(usual, Source.ONTOLOGY)
            return self.succeed(usual[0])
        self.situation.search.default_locations = usual
        return self.fail(f"the ontology has {len(usual) or 'no'} places for it")


class BeginConsultation(Step):
    """Forgets earlier exchanges with the model. Writes search.consultation."""

    def update(self) -> Status:
        """Begin an empty consultation."""
        self.situation.search.consultation = Consultation()
        return Status.SUCCESS


class ReadReply(Step):
    """Preprocessing: takes the names from a reply that is in the output format.

    Reads and writes search.consultation.
    """

    def update(self) -> Status:
        """Read the names."""
        assert self.context.advice
        names = self.context.advice.lister.read(self.situation.search.consultation.reply)
        if names is None:
            return self.fail("the language model's reply is not in the output format")
        self.situation.search.consultation.names = names
        return self.succeed(", ".join(names))


class VerifyNames(Step):
    """Existence check: drops unknown names, and sets rooms aside to be expanded.

    Reads and writes search.consultation.
    """

    takes_rooms = True

    def update(self) -> Status:
        """Look the names up in the ontology."""
        assert self.context.advice
        consultation, among = (
            self.situation.search.consultation,
            self.situation.search.default_locations,
        )
        verdict = self.context.advice.lister.verify(consultation.names, among)
        new = [name for name in verdict.furniture if name not in consultation.furniture]
        consultation.furniture.extend(new)
        if self.takes_rooms:
            consultation.rooms = list(verdict.rooms)
        self.context.recorder.record(
            Verified(self.name, verdict.furniture, verdict.rooms, verdict.dropped)
        )
        if not (verdict.furniture or (verdict.rooms and self.takes_rooms)):
            return self.fail("the language model named no place that exists here")
        return self.succeed(f"dropped: {', '.join(verdict.dropped) or 'nothing'}")


class VerifyFurniture(VerifyNames):
    """Existence check of a room's furniture; rooms are not expanded a second time."""

    takes_rooms = False


class AdoptFurniture(Step):
    """Makes candidates of the places that passed, and where the robot has not looked yet.

    Reads search.consultation; writes search.candidates.
    """

    source = Source.LLM

    def update(self) -> Status:
        """Keep the model's order."""
        furniture = self.situation.search.consultation.furniture
        new = self.situation.search.not_visited(candidates_from(furniture, Source.LLM))
        if not new:
            return self.fail("the language model named only places that were looked at")
        self.situation.search.candidates = new
        return self.succeed(", ".join(candidate.place for candidate in new))
