"""Where may the thing be? The ontology's only place, else the language model, else the person.

The flow of the paper's section "Integrated use of ontological knowledge base and LLM". Each step of
its consistency verification is a behaviour of its own, so that the log shows it.
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
    """Find places for the object: writes `situation.search.candidates`, likeliest first."""
    sources: list[Behaviour] = [OntologyKnowsPlace("ontology knows one place", context)]
    if context.model is not None:
        elicit = rank_places if context.parameters.elicit == "rank" else generate_places
        sources.append(elicit(context))
    return fallback("which places", *sources, AskWhere("ask where", context))


def rank_places(context: MissionContext) -> Behaviour:
    """The model scores the known places, so it cannot invent any."""
    return RankPlaces("llm ranks places", context)


def generate_places(context: MissionContext) -> Behaviour:
    """The model writes a list, of which only existing places are kept (the paper's method)."""
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
    """Keep the places that exist, expand rooms into furniture; fail if nothing is left."""
    thought = context.situation

    def choose(room: str) -> None:
        thought.search.consultation.room = room

    return sequence(
        "existence check",
        VerifyNames("names exist", context),
        EachOf(
            "each room",
            lambda: tuple(thought.search.consultation.rooms),
            Optionally(
                "if it helps",
                thought,
                sequence(
                    "expand room",
                    AskFurniture("furniture", context),
                    ReadReply("read", context),
                    VerifyFurniture("furniture exists", context),
                ),
            ),
            choose=choose,
        ),
        Check("something is left", context, lambda: bool(thought.search.consultation.furniture)),
    )


class OntologyKnowsPlace(Step):
    """Succeeds if the object has exactly one default location, which was not visited yet."""

    source = Source.ONTOLOGY

    def update(self) -> Status:
        """Look it up; if there are several, keep them to restrict what the model may say."""
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
    """Discards the results of earlier exchanges."""

    def update(self) -> Status:
        """Reset the consultation."""
        self.situation.search.consultation = Consultation()
        return Status.SUCCESS


class ReadReply(Step):
    """Preprocessing: extracts the names from a reply in the output format; else fails."""

    def update(self) -> Status:
        """Parse the reply."""
        assert self.context.advice
        names = self.context.advice.lister.read(self.situation.search.consultation.reply)
        if names is None:
            return self.fail("the language model's reply is not in the output format")
        self.situation.search.consultation.names = names
        return self.succeed(", ".join(names))


class VerifyNames(Step):
    """Existence check: drops unknown names, and sets rooms aside to be expanded."""

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
    """The verified places that were not visited yet become the candidates."""

    source = Source.LLM

    def update(self) -> Status:
        """Keep the model's order."""
        furniture = self.situation.search.consultation.furniture
        new = self.situation.search.not_visited(candidates_from(furniture, Source.LLM))
        if not new:
            return self.fail("the language model named only places that were looked at")
        self.situation.search.candidates = new
        return self.succeed(", ".join(candidate.place for candidate in new))
