"""What is asked for? The grammar of commands says, else the language model and the person do."""

from dataclasses import replace

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from executive.language.placed import placed
from executive.records import Utterance
from executive.types import HELD, Command, CommandKind, MissionStatus, Question, QuestionKind
from trees.context import MissionContext
from trees.model import ModelAction, RankKinds, WriteCommand
from trees.nodes import Step, fallback, sequence
from trees.person import AskYesNo, is_place, places_in
from trees.places import TO_THE_PERSON


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
        """Say what would be done."""
        assert self.situation.request.command
        command, knowledge = self.situation.request.command, self.context.knowledge
        names = knowledge.names_in(command.target)
        objects = tuple(one for name in names for one in knowledge.objects_named(name))
        text = f"Do you mean: {in_one_sentence(self.context, command)}?"
        if others := passed_over(self.context, command):
            text += f" I make nothing of {' and '.join(map(repr, others))}."
        return Question(QuestionKind.CONFIRM, command.target, text, objects)

    def agreed(self) -> None:
        """The command stands."""

    def unresolved(self) -> str:
        """It is not known what was asked for."""
        return f"I am not sure what '{self.situation.request.words}' asks for"


def in_one_sentence(context: MissionContext, command: Command) -> str:
    """All that a command asks for, in words: "bring the mug from the desk"."""
    knowledge, target = context.knowledge, command.target
    names = [name for name in target.split(" and ") if knowledge.called(name)]
    named = knowledge.objects_named(target)
    if names and " and ".join(names) == target:
        what = " and ".join(map(context.say.the, names))
    elif len(named) == 1:
        what = context.say.the(named[0])
    else:
        what = context.as_said(target)
    but = f"but not {' or '.join(command.exceptions)}" if command.exceptions else ""
    source = _where(context, command.source, "from") if command.source else ""
    to = "to" if command.kind == CommandKind.GO else ""
    goal = _where(context, command.goal, to) if command.goal else ""
    verb = command.kind.replace("_", " ")
    return " ".join(filter(None, (verb, what, but, source, goal)))


def _where(context: MissionContext, words: str, to: str) -> str:
    """A place that a command names, as one says it: "from the desk", "in the kitchen"."""
    named = places_in(context, words) if is_place(context, words) else ()
    if words.lower() in TO_THE_PERSON:
        return f"{to or 'to'} you"
    if len(named) == 1:
        return f"{to} {context.say.the(named[0])}" if to else context.say.at(named[0])
    article = "the " if named else ""
    return f"{to or 'in'} {article}{context.as_said(words)}"


def passed_over(context: MissionContext, command: Command) -> list[str]:
    """Things and places in the words of which nothing was made, as they were said."""
    knowledge, words = context.knowledge, context.situation.request.words
    read = " and ".join((command.target, *command.exceptions))
    things = [name for name in knowledge.names_in(words) if name not in knowledge.names_in(read)]
    places = [
        place
        for place in placed(words, knowledge.is_place)
        if place and not {*places_in(context, place)} <= _places_of(context, command)
    ]
    return [*(context.as_said(context.say.words(name)) for name in things), *places]


def _places_of(context: MissionContext, command: Command) -> set[str]:
    """The furniture that a command speaks of."""
    return {
        *places_in(context, command.source),
        *places_in(context, command.goal),
        *(places_in(context, command.target) if command.kind == CommandKind.GO else ()),
    }


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
            'say for example "Find an apple", "Take the mug" or "Bring a sugar box"'
        )
