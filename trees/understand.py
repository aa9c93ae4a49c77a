"""What is asked for? The grammar of commands says, else the language model and the person do."""

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
    """Words -> `situation.request.command`, and `situation.agenda` if there is more to do.

    The next tasks need no reading: they come from the agenda.
    """
    request = context.situation.request

    def at_hand() -> list[Command]:
        return [request.command] if request.command else []

    readers: list[Behaviour] = [
        FirstOf("on the agenda", at_hand, TakeUp("take it up", context)),
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
    """The model chooses what may be meant, among what exists; the person has the last word."""
    read: type[ModelAction] = RankKinds if context.parameters.elicit == "rank" else WriteCommand
    return sequence(
        "llm reads it",
        HasKnownName("speaks of a known thing", context),
        read("choose", context),
        ConfirmCommand("ask do you mean", context),
    )


class TakeUp(Step):
    """The task at hand is understood: it was on the agenda.

    Reads request.command.
    """

    source = "person"

    def update(self) -> Status:
        """Name it."""
        assert self.situation.request.command
        return self.succeed(named(self.situation.request.command))


class ReadCommand(Step):
    """Words -> commands, by the grammar of commands.

    Reads request.words; writes request.command and agenda.tasks, else request.remark.
    """

    source = "person"

    def update(self) -> Status:
        """Read the words."""
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
    """Words with a slip of the finger in them -> command, if it is about a known thing."""

    source = "person"

    def update(self) -> Status:
        """The word for the deed has to be like one, and so has the name."""
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
        """The target if it is known, else the name that it is a slip of, if it is one."""
        knowledge = self.context.knowledge
        if target == HELD or knowledge.objects_named(target):
            return target
        return knowledge.near_name(target)


class HasKnownName(Step):
    """Succeeds if a known thing is named, so that there is something to do it with.

    What the grammar did read is not the model's to read otherwise: it may say what not to do. A
    model that writes and cannot score, behind a server, may know other words for the things.
    """

    def update(self) -> Status:
        """Look for the names; a model that writes may still choose another."""
        if self.situation.request.remark:
            return self.fail("it was read")
        names = self.context.knowledge.names_in(self.situation.request.words)
        model = self.context.model
        if not names and (self.context.parameters.elicit == "rank" or not model or model.can_rank):
            return self.fail("no known thing is named")
        self.situation.request.guess = " and ".join(names)
        return self.succeed(self.situation.request.guess)


class ConfirmCommand(AskYesNo):
    """Asks whether this is what was asked for: a model's reading is never simply done."""

    def question(self) -> Question:
        """Say what would be done, all of it."""
        assert self.situation.request.command
        first, knowledge = self.situation.request.command, self.context.knowledge
        names = knowledge.names_in(first.target)
        objects = tuple(one for name in names for one in knowledge.objects_named(name))
        commands = (first, *(task.command for task in self.situation.agenda.tasks))
        wanted = ", then ".join(in_one_sentence(self.context, command) for command in commands)
        text = f"Do you mean: {wanted}?"
        if others := passed_over(self.context, commands):
            text += f" I make nothing of {' and '.join(map(repr, others))}."
        return Question(QuestionKind.CONFIRM, first.target, text, objects)

    def agreed(self) -> None:
        """The command stands."""

    def understood(self, answer: str) -> bool:
        """A yes or no with a wish behind it is more than that: "yes, to the desk"."""
        said = self.context.interpreter.read(answer)
        if self._wish(said, answer):
            return False
        if isinstance(said, Request) and not said.later:
            self._agrees = True  # "bring it", where that was asked about
            return True
        return super().understood(answer)

    def _attend_to(self, said: Said, words: str) -> bool:
        """Do what is wished in place of what was asked about, or beside it."""
        if isinstance(said, Answer | Correction) and self.context.interpreter.only(words):
            tell(self.context, attend_to(self.context, words, f"I {self.doing()}."))
            return True
        if (wish := self._wish(said, words)) is None:
            return super()._attend_to(said, words)
        tell(self.context, correct(self.context, wish, words, f"I {self.doing()}."))
        return True

    def _wish(self, said: Said, words: str) -> Correction | None:
        """What is wished beside a yes or no; None if nothing is, or what was asked about."""
        if isinstance(said, Unread):
            said = self.context.interpreter.after_yes(words)
        if isinstance(said, Request):
            said = Correction(said) if differs(self.context, said, words) else said
        return said if isinstance(said, Correction) else None

    def unresolved(self) -> str:
        """It is not known what was asked for."""
        return f"I am not sure what '{self.situation.request.words}' asks for"


def named(command: Command) -> str:
    """A command in the log: "bring mug from desk", "put mug to sofa"."""
    kind = command.kind.replace("_", " ")
    source = f"from {command.source}" if command.source else ""
    goal = f"to {command.goal}" if command.goal else ""
    return " ".join(filter(None, (kind, command.target, source, goal)))


class NotUnderstood(Step):
    """What nobody can read is the person's to say again; always fails."""

    def update(self) -> Status:
        """Say what can be said; what was read, and is not to be or cannot be done, has a reason."""
        self.situation.request.command = None
        self.situation.agenda.tasks.clear()
        if remark := self.situation.request.remark:
            return self.fail(remark.removesuffix("."))
        self.situation.ending.status = MissionStatus.NOT_UNDERSTOOD
        why = self.context.interpreter.not_understood(self.situation.request.words)
        return self.fail(
            f'{why}; say for example "Find an apple", "Take the mug" or "Bring a sugar box"'
        )
