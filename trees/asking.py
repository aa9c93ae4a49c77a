"""A question to the person: asked again while the answers make no sense, given up in the end."""

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
    """Asks a question, and asks it again while the answers make no sense.

    Writes dialogue.inquiries, and dialogue.no_help if no answer helps.
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
        """The question; it may differ from try to try."""

    @abstractmethod
    def understood(self, answer: str) -> bool:
        """Take the answer in; return whether it makes sense."""

    @abstractmethod
    def unresolved(self) -> str:
        """What is unknown without an answer, as a clause."""

    def declines(self, answer: str) -> bool:
        """Whether the person says that they do not know."""
        return self.context.interpreter.declines(answer)

    def initialise(self) -> None:
        """Ask for the first time."""
        self._tries, self._attended = 0, False
        super().initialise()

    def start(self) -> int:
        """Ask, and record the question."""
        question = self.question()
        question = replace(question, text=printable(question.text))
        self._tries += 1
        self.situation.dialogue.inquiries += 1
        self.context.recorder.record(Utterance("robot", question.text))
        return self.context.user.ask(question)

    def ended(self, result: Result) -> Status:
        """Take the answer, ask again, or give up."""
        if not isinstance(result, Answered):
            self.situation.dialogue.inquiries -= 1  # nobody has heard the question
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
            return Status.RUNNING  # in this tick the tree will stop it for another task
        if self._tries < self.context.parameters.questions:
            return self.start_again()
        return self._no_help(unread or f"I did not understand your answer '{result.text}'")

    def _passed_over(self, said: Said, words: str) -> list[str]:
        """Other things that the answer names, if the grammar has not read all of it."""
        request, knowledge = self.situation.request, self.context.knowledge
        about = {request.object, *request.options}
        names = knowledge.names_in(words) if isinstance(said, Unread) else ()
        others = (name for name in names if not about & {*knowledge.objects_named(name)})
        return [f"'{as_said(words, self.context.say.words(name))}'" for name in others]

    def _attend_to(self, said: Said, words: str) -> bool:
        """Deal with words that are no answer: another request, a correction, a question."""
        if isinstance(said, Answer | Unread):
            return False
        tell(self.context, attend_to(self.context, words, f"I {self.doing()}."))
        return True

    def doing(self) -> str:
        """It waits for the answer."""
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
    """Asks a yes-no question; fails if the answer is no."""

    _agrees: bool | None = None

    @abstractmethod
    def agreed(self) -> None:
        """Do what follows from a yes."""

    def declines(self, answer: str) -> bool:
        """A "no" is an answer here."""
        return self.context.interpreter.agrees(answer) is None and super().declines(answer)

    def understood(self, answer: str) -> bool:
        """Take yes or no."""
        self._agrees = self.context.interpreter.agrees(answer)
        if self._agrees:
            self.agreed()
        return self._agrees is not None

    def ended(self, result: Result) -> Status:
        """Fail on a no, too; on a yes, the command is settled."""
        status = super().ended(result)
        if status != Status.SUCCESS:
            return status
        if not self._agrees:
            return self.fail(f"{self.unresolved()}, and you said no")
        return self.succeed(
            f"{self.situation.request.asked_for.kind} {self.situation.request.asked_for.target}"
        )
