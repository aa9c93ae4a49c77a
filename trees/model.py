"""Leaves that call the language model."""

from abc import abstractmethod
from dataclasses import replace

from py_trees.common import Status

from executive.interfaces.llm import Advice, LanguageModel
from executive.language.placed import placed
from executive.records import Activity
from executive.types.commands import Command, CommandKind
from executive.types.knowledge import Source
from executive.types.llm import ChatRequest
from executive.types.results import Replied, Result, Scored
from trees.context import MissionContext
from trees.nodes import Action, why_of
from trees.telling import sentence, tell


class ModelAction(Action):
    """One call of the language model."""

    source = Source.LLM
    activity = Activity.THINKING

    def __init__(self, name: str, context: MissionContext) -> None:
        """The model may take as long as the parameters allow."""
        super().__init__(name, context, context.parameters.model_s)
        assert context.model is not None
        assert context.advice is not None
        self.model: LanguageModel = context.model
        self.advice: Advice = context.advice
        self._began: float | None = None

    def doing(self) -> str:
        """It waits for the model."""
        return "ask the language model"

    def initialise(self) -> None:
        """Note the time, and start."""
        self._began = self.context.clock.now()
        super().initialise()

    def terminate(self, new_status: Status) -> None:
        """Add up the time spent thinking."""
        if self._began is not None:
            self.situation.model.thinking_time_s += self.context.clock.now() - self._began
            self._began = None
        super().terminate(new_status)

    def cancel(self, request: int) -> None:
        """Cancel the request."""
        self.model.cancel(request)

    def failed(self, result: Result) -> Status:
        """Tell the person that the model does not help, and why; then fail."""
        why = why_of(result)
        self._warn(why)
        return self.fail(why)

    def out_of_time(self) -> Status:
        """Fail because the model did not answer in time."""
        self._warn(f"nothing came within {self._patience_s:g} s")
        return self.fail(f"the language model did not answer within {self._patience_s:g} s")

    def _warn(self, why: str) -> None:
        """Tell the person, once a mission."""
        if not self.situation.model.failure:
            self.situation.model.failure = why
            tell(self.context, sentence(f"My language model does not answer: {why}"))


class RankPlaces(ModelAction):
    """Has every allowed place scored, and keeps the likeliest.

    Reads request.object and search.default_locations; writes search.candidates.
    """

    @property
    def among(self) -> tuple[str, ...]:
        """The places that may be scored; empty for all places of the home."""
        return self.situation.search.default_locations

    def start(self) -> int:
        """Request the scores."""
        assert self.situation.request.object
        ranking = self.advice.ranker.ranking(self.situation.request.object, self.among)
        return self.model.rank(ranking)

    def ended(self, result: Result) -> Status:
        """Keep the places worth a visit: all of those that the ontology named, else the top k."""
        if not isinstance(result, Scored):
            return self.failed(result)
        ranked = self.situation.search.not_visited(self.advice.ranker.ranked(result))
        if not ranked:
            return self.fail("the language model ranked only places that were looked at")
        if not self.situation.search.default_locations:
            ranked = ranked[: self.context.parameters.top_k]
        self.situation.search.candidates = ranked
        return self.succeed(", ".join(map(str, ranked)))


class Chat(ModelAction):
    """Has the model write a reply, and keeps it in search.consultation."""

    @abstractmethod
    def request(self) -> ChatRequest:
        """The prompt."""

    def start(self) -> int:
        """Send the prompt."""
        return self.model.chat(self.request())

    def ended(self, result: Result) -> Status:
        """Keep the reply, and the exchange for later prompts."""
        if not isinstance(result, Replied):
            return self.failed(result)
        self.advice.lister.remember(result.request, result.text)
        self.situation.search.consultation.reply = result.text
        return self.succeed(result.text)

    @property
    def thing(self) -> str:
        """Name of the object that is searched."""
        assert self.situation.request.object
        return self.situation.request.object


class Inquire(Chat):
    """The prompt `general_pos`; or `multiple_pos` if the ontology knows several places."""

    def request(self) -> ChatRequest:
        """Ask for likely places."""
        return self.advice.lister.inquiry(self.thing, self.situation.search.default_locations)


class Summarize(Chat):
    """The prompt `summarize`: the last reply in the output format."""

    def request(self) -> ChatRequest:
        """Ask for the same places in the right format."""
        return self.advice.lister.summarize(self.thing, self.situation.search.consultation.reply)


class Again(Chat):
    """The prompt `again`: no place of the last reply exists."""

    def request(self) -> ChatRequest:
        """Ask for places that exist."""
        return self.advice.lister.again(self.thing, self.situation.search.default_locations)


class AskFurniture(Chat):
    """The prompt `furniture`: which furniture of a room that the model named?"""

    def request(self) -> ChatRequest:
        """Ask for the furniture of the current room."""
        room = self.situation.search.consultation.room
        return self.advice.lister.furniture(
            self.thing, room, self.situation.search.default_locations
        )


class RankKinds(ModelAction):
    """Has the kinds of command scored; the words themselves name the thing and the places.

    Reads request.words and request.guess; writes request.command.
    """

    def start(self) -> int:
        """Request the scores."""
        return self.model.rank(self.advice.reader.ranking(self.situation.request.words))

    def ended(self, result: Result) -> Status:
        """Make a command of the likeliest kind."""
        if not isinstance(result, Scored):
            return self.failed(result)
        kind, words = self.advice.reader.ranked(result), self.situation.request.words
        guess = self.situation.request.guess
        source, goal = placed(words, self.context.knowledge.is_place)
        if goal and kind.means.grasps:
            kind = CommandKind.PUT
        goal = goal if kind == CommandKind.PUT else ""
        self.situation.request.command = Command(kind, guess, words, source=source, goal=goal)
        return self.succeed(f"{kind} {guess}")


class WriteCommand(ModelAction):
    """Has the model write the command in plain words, with things and places that exist.

    The grammar reads these words, so that they mean the same as if the person had said them.
    Reads request.words; writes request.command and agenda.tasks.
    """

    def start(self) -> int:
        """Ask for the plain words."""
        return self.model.chat(self.advice.reader.inquiry(self.situation.request.words))

    def ended(self, result: Result) -> Status:
        """Read the reply; fail unless it is a command about what exists."""
        if not isinstance(result, Replied):
            return self.failed(result)
        plain = self.advice.reader.read(result.text)
        commands = self.context.interpreter.commands(plain) if plain else ()
        if not commands:
            return self.fail("the language model named no command that can be carried out")
        agenda, words = self.situation.agenda, self.situation.request.words
        agenda.add(tuple(replace(one, words=words) for one in group) for group in commands)
        self.situation.begin(agenda.take(agenda.tasks[0]))
        return self.succeed(plain)
