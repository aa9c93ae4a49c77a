"""A question to the person: repeated while the answer makes no sense, and in the end given up."""

from abc import abstractmethod
from dataclasses import replace

from py_trees.common import Status

from executive.language.meaning import Answer, Refusal, Said, Unread
from executive.language.wording import as_said, listed
from executive.records import Activity, Utterance
from executive.text import printable, too_long
from executive.types.dialogue import Question
from executive.types.knowledge import Source
from executive.types.results import Answered, Result
from trees.attention import attend_to
from trees.context import MissionContext
from trees.nodes import Action, why_of
from trees.telling import tell


class Ask(Action):
    """Asks a question, and asks again while the answer makes no sense.

    Writes dialogue.inquiries; and dialogue.no_help if there is no useful answer.
    """

    source = Source.USER
    activity = Activity.ASKING

    def __init__(self, name: str, context: MissionContext) -> None:
        """Each answer may take as long as the parameters allow."""
        super().__init__(name, context, context.parameters.answer_s)
        self._tries = 0
        self._attended = False

    @abstractmethod
    def question(self) -> Question:
        """The question for this try."""

    @abstractmethod
    def understood(self, answer: str) -> bool:
        """Use the answer; return whether it made sense."""

    @abstractmethod
    def unresolved(self) -> str:
        """What stays unknown without an answer, as a clause."""

    def declines(self, answer: str) -> bool:
        """Whether the answer means that the person does not know or does not want to say."""
        return self.context.interpreter.declines(answer)

    def initialise(self) -> None:
        """Ask for the first time."""
        self._tries, self._attended = 0, False
        super().initialise()

    def start(self) -> int:
        """Ask the user; return the number of the request."""
        question = self.question()
        question = replace(question, text=printable(question.text))
        self._tries += 1
        self.situation.dialogue.inquiries += 1
        self.context.recorder.record(Utterance("robot", question.text))
        return self.context.user.ask(question)

    def ended(self, result: Result) -> Status:
        """Use the answer, ask again, or accept that there is no answer."""
        if not isinstance(result, Answered):
            self.situation.dialogue.inquiries -= 1  # nobody was there to hear it
            return self._no_help(why_of(result))
        self.context.recorder.record(Utterance("person", result.text))
        unread = too_long(result.text)
        said = self.context.interpreter.read(result.text)
        refuses = isinstance(said, Refusal) and said.words != ""
        if not unread and not refuses and self.declines(result.text):
            return self._no_help("you could not tell me")
        if not unread and self.understood(result.text):
            if more := self._passed_over(said, result.text):
                tell(self.context, f"I make nothing of {listed(more)}.")
            return self.succeed(result.text)
        self._attended = not unread and self._attend_to(said, result.text)
        if self.situation.agenda.interrupts:
            return Status.RUNNING  # the tree interrupts this behaviour in the same tick
        if self._tries < self.context.parameters.questions:
            return self.start_again()
        return self._no_help(unread or f"I did not understand your answer '{result.text}'")

    def _passed_over(self, said: Said, words: str) -> list[str]:
        """The things in an unparsed answer that the question is not about, as said."""
        request, knowledge = self.situation.request, self.context.knowledge
        about = {request.object, *request.options}
        names = knowledge.names_in(words) if isinstance(said, Unread) else ()
        others = (name for name in names if not about & {*knowledge.objects_named(name)})
        return [f"'{as_said(words, self.context.say.words(name))}'" for name in others]

    def _attend_to(self, said: Said, words: str) -> bool:
        """Handle a further wish, a correction or a question; whether it was one of these."""
        if isinstance(said, Answer | Unread):
            return False
        tell(self.context, attend_to(self.context, words, f"I {self.doing()}."))
        return True

    def doing(self) -> str:
        """To follow "I"."""
        return "wait for your answer"

    def out_of_time(self) -> Status:
        """Note that nobody answered."""
        return self._no_help(f"nobody answered within {self._patience_s:g} s")

    def cancel(self, request: int) -> None:
        """Withdraw the question."""
        self.context.user.cancel(request)

    def _no_help(self, why: str) -> Status:
        self.situation.dialogue.no_help = why
        return self.fail(f"{self.unresolved()}, and {why}")


class AskYesNo(Ask):
    """Asks whether something is so; fails if it is not."""

    _agrees: bool | None = None

    @abstractmethod
    def agreed(self) -> None:
        """Act on a yes."""

    def declines(self, answer: str) -> bool:
        """A "no" is an answer here."""
        return self.context.interpreter.agrees(answer) is None and super().declines(answer)

    def understood(self, answer: str) -> bool:
        """Recognise yes and no."""
        self._agrees = self.context.interpreter.agrees(answer)
        if self._agrees:
            self.agreed()
        return self._agrees is not None

    def ended(self, result: Result) -> Status:
        """Fail on a no, too; after a yes, the message names the command."""
        status = super().ended(result)
        if status != Status.SUCCESS:
            return status
        if not self._agrees:
            return self.fail(f"{self.unresolved()}, and you said no")
        assert self.situation.request.command
        return self.succeed(
            f"{self.situation.request.command.kind} {self.situation.request.command.target}"
        )
