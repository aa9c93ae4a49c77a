"""What is asked for? The grammar of commands says, else the language model and the person do."""

from dataclasses import replace

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from executive.records import Utterance
from executive.types import HELD, MissionStatus, Question, QuestionKind
from trees.context import MissionContext
from trees.model import ModelAction, RankKinds, WriteCommand
from trees.nodes import Step, fallback, sequence
from trees.person import AskYesNo


def understand(context: MissionContext) -> Behaviour:
    """Words -> `situation.request.command`."""
    readers: list[Behaviour] = [
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


class ReadCommand(Step):
    """Words -> command, by the grammar of commands."""

    source = "person"

    def update(self) -> Status:
        """Read the words."""
        self.context.recorder.record(Utterance("person", self.situation.request.words))
        command = self.context.interpreter.command(self.situation.request.words)
        if command is None:
            self.situation.request.remark = self.context.interpreter.remark(
                self.situation.request.words
            )
            return self.fail("this is no command that the grammar knows")
        self.situation.request.command = command
        source = f"from {command.source}" if command.source else ""
        goal = f"to {command.goal}" if command.goal else ""
        return self.succeed(" ".join(filter(None, (command.kind, command.target, source, goal))))


class ReadPastSlips(Step):
    """Words with a slip of the finger in them -> command, if it is about a known thing."""

    source = "person"

    def update(self) -> Status:
        """The word for the deed has to be like one, and so has the name."""
        words = self.situation.request.words
        if self.situation.request.remark:
            return self.fail("it was read")
        command = self.context.interpreter.without_slips(words)
        if command is None:
            return self.fail("it is like no command")
        target = self._known(command.target)
        if target is None:
            return self.fail(f"'{command.target}' is like no known name")
        self.situation.request.command = replace(command, target=target, words=words)
        return self.succeed(f"{command.kind} {target}")

    def _known(self, target: str) -> str | None:
        """The target if it is known, else the name that it is a slip of, if it is one."""
        knowledge = self.context.knowledge
        if target == HELD or knowledge.objects_named(target):
            return target
        return knowledge.near_name(target)


class HasKnownName(Step):
    """Succeeds if a known thing is named, so that there is something to do it with.

    What the grammar did read is not the model's to read otherwise: it may say what not to do.
    """

    def update(self) -> Status:
        """Look for the names; a model that writes may still choose another."""
        if self.situation.request.remark:
            return self.fail("it was read")
        names = self.context.knowledge.names_in(self.situation.request.words)
        if not names:
            return self.fail("no known thing is named")
        self.situation.request.guess = " and ".join(names)
        return self.succeed(self.situation.request.guess)


class ConfirmCommand(AskYesNo):
    """Asks whether this is what was asked for: a model's reading is never simply done."""

    def question(self) -> Question:
        """Say what would be done."""
        assert self.situation.request.command
        kind, target = self.situation.request.command.kind, self.situation.request.command.target
        knowledge = self.context.knowledge
        objects = [o for name in knowledge.names_in(target) for o in knowledge.objects_named(name)]
        place = self.situation.request.command.source
        what = f"{kind.replace('_', ' ')} {target}" + f" from {place}" * bool(place)
        text = f"Do you mean: {what}?"
        return Question(QuestionKind.CONFIRM, target, text, tuple(objects))

    def agreed(self) -> None:
        """The command stands."""

    def unresolved(self) -> str:
        """It is not known what was asked for."""
        return f"I am not sure what '{self.situation.request.words}' asks for"


class NotUnderstood(Step):
    """What nobody can read is the person's to say again; always fails."""

    def update(self) -> Status:
        """Say what can be said; what was read, and is not to be or cannot be done, has a reason."""
        self.situation.request.command = None
        if remark := self.situation.request.remark:
            return self.fail(remark.removesuffix("."))
        self.situation.ending.status = MissionStatus.NOT_UNDERSTOOD
        words = self.situation.request.words
        said = f"'{words}'" if words.strip() else "what you said"
        return self.fail(
            f"I do not understand {said}; "
            'say for example "Find an apple", "Take the mug" or "Bring a sugar_box"'
        )
