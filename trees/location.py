"""Where may it be? Where it was, else the ontology's one place, else the language model, else ask.

The flow of the paper's section "Integrated use of ontological knowledge base and LLM", with its
consistency verification spelled out as behaviours, so that every step is seen in the log.
"""

from abc import abstractmethod

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from executive.interfaces import Advisor, LanguageModel
from executive.records import Verified
from executive.situation import Consultation, candidates_from
from executive.types import DELIVERY, ChatRequest, Replied, Result, Scored, Source
from trees.context import MissionContext
from trees.nodes import Action, Check, EachOf, Optionally, Step, fallback, sequence, why_of
from trees.person import AskWhere, sentence, tell


def resolve_location(context: MissionContext) -> Behaviour:
    """An object -> `situation.candidates`, likeliest first, with who said so."""
    sources: list[Behaviour] = [OntologyKnowsPlace("ontology knows one place", context)]
    if context.model is not None:
        elicit = rank_places if context.parameters.elicit == "rank" else generate_places
        sources.append(elicit(context))
    return fallback("which places", *sources, AskWhere("ask where", context))


def rank_places(context: MissionContext) -> Behaviour:
    """The model scores the known places: it cannot invent any."""
    return RankPlaces("llm ranks places", context)


def generate_places(context: MissionContext) -> Behaviour:
    """The model writes a list, of which only real places are kept (the paper's way)."""
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
    thought = context.situation

    def choose(room: str) -> None:
        thought.consultation.room = room

    return sequence(
        "existence check",
        VerifyNames("names exist", context),
        EachOf(
            "each room",
            lambda: tuple(thought.consultation.rooms),
            choose,
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
        ),
        Check("something is left", context, lambda: bool(thought.consultation.furniture)),
    )


class MemoryKnowsPlaces(Step):
    """Succeeds if the thing was seen somewhere in this home, or was said to be there."""

    def update(self) -> Status:
        """Recall it."""
        assert self.situation.object
        known = self.context.facts.places_of(self.situation.object)
        here = self.context.knowledge.has_place
        places = [place for place in known if place == DELIVERY or here(place)]
        if not places:
            return self.fail(f"I have not seen the {self.situation.object}")
        self.situation.candidates = candidates_from(places, Source.MEMORY)
        return self.succeed(", ".join(places))


class OntologyKnowsPlace(Step):
    """Succeeds if the ontology has exactly one default location for the object, still unvisited."""

    def update(self) -> Status:
        """Look it up; several are kept to narrow down what the model may say."""
        assert self.situation.object
        usual = self.context.knowledge.usual_places(self.situation.object)
        if len(usual) == 1 and usual[0] in self.situation.looks.visited:
            return self.fail(f"{usual[0]} is its place, but it is not there")
        if len(usual) == 1:
            self.situation.candidates = candidates_from(usual, Source.ONTOLOGY)
            return self.succeed(usual[0])
        self.situation.default_locations = usual
        return self.fail(f"the ontology has {len(usual) or 'no'} places for it")


class BeginConsultation(Step):
    """Forgets what earlier exchanges left."""

    def update(self) -> Status:
        """Begin with nothing."""
        self.situation.consultation = Consultation()
        return Status.SUCCESS


class ModelAction(Action):
    """One call of the language model."""

    def __init__(self, name: str, context: MissionContext) -> None:
        """Give the model as long as the parameters allow."""
        super().__init__(name, context, context.parameters.model_s)
        assert context.model is not None
        assert context.advisor is not None
        self.model: LanguageModel = context.model
        self.advisor: Advisor = context.advisor
        self._began: float | None = None

    def initialise(self) -> None:
        """Mark the time, and start."""
        self._began = self.context.clock.now()
        super().initialise()

    def terminate(self, new_status: Status) -> None:
        """Count the time spent thinking."""
        if self._began is not None:
            self.situation.thinking_time_s += self.context.clock.now() - self._began
            self._began = None
        super().terminate(new_status)

    def cancel(self, request: int) -> None:
        """Stop the model."""
        self.model.cancel(request)

    def failed(self, result: Result) -> Status:
        """Warn the person that the model is of no help, and why; then go on without."""
        why = why_of(result)
        self._warn(why)
        return self.fail(why)

    def out_of_time(self) -> Status:
        """Say that the model did not answer."""
        self._warn(f"nothing came within {self._patience_s:g} s")
        return self.fail(f"the language model did not answer within {self._patience_s:g} s")

    def _warn(self, why: str) -> None:
        """Once a mission."""
        if not self.situation.model_failure:
            self.situation.model_failure = why
            tell(self.context, sentence(f"My language model does not answer: {why}"))


class RankPlaces(ModelAction):
    """Has every allowed place scored, and keeps the likeliest."""

    def start(self) -> int:
        """Ask for the scores."""
        assert self.situation.object
        return self.model.rank(
            self.advisor.ranking(self.situation.object, self.situation.default_locations)
        )

    def ended(self, result: Result) -> Status:
        """Keep as many as are worth a visit; all of them if the ontology named them."""
        if not isinstance(result, Scored):
            return self.failed(result)
        ranked = self.situation.not_visited(self.advisor.ranked(result))
        if not ranked:
            return self.fail("the language model ranked only places that were looked at")
        if not self.situation.default_locations:
            ranked = ranked[: self.context.parameters.top_k]
        self.situation.candidates = ranked
        return self.succeed(", ".join(map(str, ranked)))


class Chat(ModelAction):
    """Asks the model to write, and keeps the reply."""

    @abstractmethod
    def request(self) -> ChatRequest:
        """What to ask."""

    def start(self) -> int:
        """Ask."""
        return self.model.chat(self.request())

    def ended(self, result: Result) -> Status:
        """Keep the reply, and remember the exchange."""
        if not isinstance(result, Replied):
            return self.failed(result)
        self.advisor.remember(result.request, result.text)
        self.situation.consultation.reply = result.text
        return self.succeed(result.text)

    @property
    def thing(self) -> str:
        """Name of the object that is looked for."""
        assert self.situation.object
        return self.situation.object


class Inquire(Chat):
    """`general_pos` where the ontology knows no place, `multiple_pos` where it knows several."""

    def request(self) -> ChatRequest:
        """Ask for the likely places."""
        return self.advisor.inquiry(self.thing, self.situation.default_locations)


class Summarize(Chat):
    """`summarize`: put the last reply into the output format."""

    def request(self) -> ChatRequest:
        """Ask for the same in the right form."""
        return self.advisor.summarize(self.thing, self.situation.consultation.reply)


class Again(Chat):
    """`again`: no place of the last reply exists."""

    def request(self) -> ChatRequest:
        """Ask for places from the list."""
        return self.advisor.again(self.thing, self.situation.default_locations)


class AskFurniture(Chat):
    """`furniture`: a room was named; which furniture in it?"""

    def request(self) -> ChatRequest:
        """Ask for the room at hand."""
        room = self.situation.consultation.room
        return self.advisor.furniture(self.thing, room, self.situation.default_locations)


class ReadReply(Step):
    """Preprocessing: the names in the reply, if it keeps to the output format."""

    def update(self) -> Status:
        """Read it."""
        assert self.context.advisor
        names = self.context.advisor.read(self.situation.consultation.reply)
        if names is None:
            return self.fail("the language model's reply is not in the output format")
        self.situation.consultation.names = names
        return self.succeed(", ".join(names))


class VerifyNames(Step):
    """Existence check: unknown names are dropped, rooms are set aside to be expanded."""

    takes_rooms = True

    def update(self) -> Status:
        """Hold the names against the ontology."""
        assert self.context.advisor
        consultation, among = self.situation.consultation, self.situation.default_locations
        verdict = self.context.advisor.verify(consultation.names, among)
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
    """Existence check of a room's furniture: rooms are not expanded a second time."""

    takes_rooms = False


class AdoptFurniture(Step):
    """What passed, and was not looked at yet, becomes the list of candidates."""

    def update(self) -> Status:
        """Keep the model's order."""
        furniture = self.situation.consultation.furniture
        new = self.situation.not_visited(candidates_from(furniture, Source.LLM))
        if not new:
            return self.fail("the language model named only places that were looked at")
        self.situation.candidates = new
        return self.succeed(", ".join(candidate.place for candidate in new))
