"""What does the person ask for? The grammar reads it; or the model, and the person confirms."""

from dataclasses import replace
from itertools import chain

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from executive.language.commands import LEAVE_OUT_PLACES
from executive.language.meaning import Answer, Correction, Request, Said, Unread
from executive.records import Utterance
from executive.types.commands import HELD, Command
from executive.types.dialogue import Question, QuestionKind
from executive.types.outcome import MissionStatus
from trees.asking import AskYesNo
from trees.at_hand import differs
from trees.attention import attend_to
from trees.context import MissionContext
from trees.corrections import correct
from trees.meant import leaves_out_a_place, less_what_is_left_out
from trees.model import ModelAction, RankKinds, WriteCommand
from trees.nodes import FirstOf, Step, fallback, sequence
from trees.order import begin_next
from trees.passed_over import passed_over
from trees.telling import in_one_sentence, tell


def understand(context: MissionContext) -> Behaviour:
    """Read the words; writes request.command, and further tasks to the agenda.

    Tasks that come from the agenda were read before.
    """
    request = context.situation.request

    def from_agenda() -> list[Command]:
        return [request.command] if request.command else []

    readers: list[Behaviour] = [
        FirstOf("on the agenda", from_agenda, TakeUp("take it up", context)),
        ReadCommand("grammar reads it", context),
        sequence(
            "a slip",
            ReadPastSlips("is like a command", context),
            ConfirmCommand("ask do you mean", context),
        ),
    ]
    if context.model is not None:
        readers.append(let_the_model_read(context))
    return fallback("understand", *readers, NotUnderstood("not understood", context))


def let_the_model_read(context: MissionContext) -> Behaviour:
    """The model chooses a command about what exists, and the person confirms it."""
    read: type[ModelAction] = RankKinds if context.parameters.elicit == "rank" else WriteCommand
    return sequence(
        "llm reads it",
        HasKnownName("speaks of a known thing", context),
        read("choose", context),
        ConfirmCommand("ask do you mean", context),
    )


class TakeUp(Step):
    """Succeeds: the current task comes from the agenda, and was understood before.

    Reads request.command.
    """

    source = "person"

    def update(self) -> Status:
        """Name the task in the log."""
        return self.succeed(named(self.situation.request.asked_for))


class ReadCommand(Step):
    """Reads the words with the grammar of commands.

    Reads request.words; writes request.command and agenda.tasks, else request.remark.
    """

    source = "person"

    def update(self) -> Status:
        """Read the words, put all tasks on the agenda, and begin the first."""
        words, spoken = self.situation.request.words, self.situation.dialogue.spoken
        self.context.recorder.record(Utterance("person", words))
        holds = self.situation.hand.in_hand is not None
        commands = self.context.interpreter.commands(words, spoken, holds=holds)
        if not commands:
            self.situation.request.remark = self.context.interpreter.remark(words, spoken)
            return self.fail("this is no command that the grammar knows")
        if leaves_out_a_place(self.context, chain.from_iterable(commands)):
            self.situation.request.remark = f"I cannot {LEAVE_OUT_PLACES}."
            return self.fail("a place is not meant")
        self.situation.agenda.add(less_what_is_left_out(self.context, commands))
        begin_next(self.context)
        return self.succeed("; ".join(map(named, chain.from_iterable(commands))))


class ReadPastSlips(Step):
    """Reads words with typing errors, if they are then a command about known things.

    Reads request.words; writes request.command and agenda.tasks.
    """

    source = "person"

    def update(self) -> Status:
        """Read words that are like a verb of ours, and like the name of a known thing."""
        words = self.situation.request.words
        if self.situation.request.remark:
            return self.fail("it was read")
        commands = self.context.interpreter.without_slips(words)
        if not commands:
            return self.fail("it is like no command")
        known: list[tuple[Command, ...]] = []
        for group in commands:
            targets = [self._known(command.target) for command in group]
            if None in targets:
                return self.fail(f"'{group[targets.index(None)].target}' is like no known name")
            known.append(
                tuple(
                    replace(command, target=target or "", words=words)
                    for command, target in zip(group, targets, strict=True)
                )
            )
        self.situation.agenda.add(tuple(known))
        begin_next(self.context)
        return self.succeed("; ".join(f"{c.kind} {c.target}" for c in chain.from_iterable(known)))

    def _known(self, target: str) -> str | None:
        """The target if it is known, else the known name that it is like; None if there is none."""
        knowledge = self.context.knowledge
        if target == HELD or knowledge.objects_named(target):
            return target
        return knowledge.near_name(target)


class HasKnownName(Step):
    """Succeeds if the words name a known thing, so that the model has something to choose.

    Fails if the grammar did read the words: the model must not read them in another way, because
    they may say what not to do. A model that only writes, behind a server, is asked without a known
    name, too: it may know other words for the things.

    Reads request.words and request.remark; writes request.guess.
    """

    def update(self) -> Status:
        """Look for known names in the words."""
        if self.situation.request.remark:
            return self.fail("it was read")
        names = self.context.knowledge.names_in(self.situation.request.words)
        model = self.context.model
        if not names and (self.context.parameters.elicit == "rank" or not model or model.can_rank):
            return self.fail("no known thing is named")
        self.situation.request.guess = " and ".join(names)
        return self.succeed(self.situation.request.guess)


class ConfirmCommand(AskYesNo):
    """Asks whether a guess is right: what a model has read is never done without asking.

    Reads request.command and agenda.tasks.
    """

    def question(self) -> Question:
        """Say all that would be done, and which words were left out."""
        first, knowledge = self.situation.request.asked_for, self.context.knowledge
        names = knowledge.names_in(first.target)
        objects = tuple(one for name in names for one in knowledge.objects_named(name))
        commands = (first, *(task.command for task in self.situation.agenda.tasks))
        wanted = ", then ".join(in_one_sentence(self.context, command) for command in commands)
        text = f"Do you mean: {wanted}?"
        if others := passed_over(self.context, commands):
            text += f" I make nothing of {' and '.join(map(repr, others))}."
        return Question(QuestionKind.CONFIRM, first.target, text, objects)

    def agreed(self) -> None:
        """Do nothing: the command stands as it is."""

    def understood(self, answer: str) -> bool:
        """Take yes or no, or the same request again; not with another request behind it."""
        said = self.context.interpreter.read(answer)
        if self._wish(said, answer):
            return False
        if isinstance(said, Request) and not said.later:
            self._agrees = True  # "bring it", if just that was the question
            return True
        return super().understood(answer)

    def _attend_to(self, said: Said, words: str) -> bool:
        """Change the command as the answer asks for: "yes, to the desk"."""
        if isinstance(said, Answer | Correction) and self.context.interpreter.only(words):
            tell(self.context, attend_to(self.context, words, f"I {self.doing()}."))
            return True
        if (wish := self._wish(said, words)) is None:
            return super()._attend_to(said, words)
        tell(self.context, correct(self.context, wish, words, f"I {self.doing()}."))
        return True

    def _wish(self, said: Said, words: str) -> Correction | None:
        """What the answer asks for beyond yes or no; None if nothing new."""
        if isinstance(said, Unread):
            said = self.context.interpreter.after_yes(words)
        if isinstance(said, Request):
            said = Correction(said) if differs(self.context, said, words) else said
        return said if isinstance(said, Correction) else None

    def unresolved(self) -> str:
        """It is not known what the words ask for."""
        return f"I am not sure what '{self.situation.request.words}' asks for"


def named(command: Command) -> str:
    """The command for the log: "bring mug from desk", "put mug to sofa"."""
    kind = command.kind.replace("_", " ")
    source = f"from {command.source}" if command.source else ""
    goal = f"to {command.goal}" if command.goal else ""
    return " ".join(filter(None, (kind, command.target, source, goal)))


class NotUnderstood(Step):
    """Gives up on words that nobody can read; always fails.

    Reads request.remark; writes ending.status, unless the words were read and cannot be done.
    """

    def update(self) -> Status:
        """Say why the words cannot be done; else give examples of what can be said."""
        self.situation.request.command = None
        self.situation.agenda.tasks.clear()
        if remark := self.situation.request.remark:
            return self.fail(remark.removesuffix("."))
        self.situation.ending.status = MissionStatus.NOT_UNDERSTOOD
        why = self.context.interpreter.not_understood(self.situation.request.words)
        return self.fail(
            f'{why}; say for example "Find an apple", "Take the mug" or "Bring a sugar box"'
        )
