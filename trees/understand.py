"""What is asked for? The grammar of commands says, else the language model and the person do."""

from dataclasses import replace

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from executive.records import Utterance
from executive.types import Command, CommandKind, MissionStatus, Question, QuestionKind
from trees.context import MissionContext
from trees.model import ModelAction, RankKinds, WriteCommand
from trees.nodes import Step, fallback, sequence
from trees.person import AskYesNo
from trees.places import TO_THE_PERSON

_CARRYING = (CommandKind.BRING, CommandKind.TAKE, CommandKind.PUT_DOWN)


def understand(context: MissionContext) -> Behaviour:
    """Words -> `situation.request.command`."""
    readers: list[Behaviour] = [ReadCommand("grammar reads it", context)]
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
            return self.fail("this is no command that the grammar knows")
        command = _by_its_goal(command)
        self.situation.request.command = command
        source = f"from {command.source}" if command.source else ""
        goal = f"to {command.goal}" if command.goal else ""
        return self.succeed(" ".join(filter(None, (command.kind, command.target, source, goal))))


def _by_its_goal(command: Command) -> Command:
    """What is brought or taken somewhere is put there; what is put by the person is brought."""
    if command.goal.lower() in TO_THE_PERSON and command.kind in (*_CARRYING, CommandKind.PUT):
        return replace(command, kind=CommandKind.BRING, goal="")
    if command.goal and command.kind in _CARRYING:
        return replace(command, kind=CommandKind.PUT)
    return command


class HasKnownName(Step):
    """Succeeds if a known thing is named, so that there is something to do it with."""

    def update(self) -> Status:
        """Look for the names; a model that writes may still choose another."""
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
        text = f"Do you mean: {kind} {target}?"
        return Question(QuestionKind.CONFIRM, target, text, tuple(objects))

    def agreed(self) -> None:
        """The command stands."""

    def unresolved(self) -> str:
        """It is not known what was asked for."""
        return f"I am not sure what '{self.situation.request.words}' asks for"


class NotUnderstood(Step):
    """What nobody can read is the person's to say again; always fails."""

    def update(self) -> Status:
        """Say what can be said."""
        self.situation.request.command = None
        self.situation.ending.status = MissionStatus.NOT_UNDERSTOOD
        words = self.situation.request.words
        said = f"'{words}'" if words.strip() else "what you said"
        return self.fail(
            f"I do not understand {said}; "
            'say for example "Find an apple", "Take the mug" or "Bring a sugar_box"'
        )
