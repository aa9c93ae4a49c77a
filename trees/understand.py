"""What is asked for? The grammar of commands says, else the language model and the person do."""

import re
from collections.abc import Sequence
from dataclasses import replace
from itertools import chain

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from executive.colors import COLORS, OTHER_SPELLINGS
from executive.language.placed import placed
from executive.records import Utterance
from executive.types import HELD, Command, CommandKind, MissionStatus, Question, QuestionKind
from trees.asking import AskYesNo
from trees.context import MissionContext
from trees.model import ModelAction, RankKinds, WriteCommand
from trees.nodes import FirstOf, Step, fallback, sequence
from trees.order import begin_next
from trees.place_words import places_in
from trees.telling import in_one_sentence


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
        self.situation.agenda.add(commands)
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

    def unresolved(self) -> str:
        """It is not known what was asked for."""
        return f"I am not sure what '{self.situation.request.words}' asks for"


def named(command: Command) -> str:
    """A command in the log: "bring mug from desk", "put mug to sofa"."""
    kind = command.kind.replace("_", " ")
    source = f"from {command.source}" if command.source else ""
    goal = f"to {command.goal}" if command.goal else ""
    return " ".join(filter(None, (kind, command.target, source, goal)))


def passed_over(context: MissionContext, commands: Sequence[Command]) -> list[str]:
    """What stands in the words, and nothing was made of, as it was said.

    That is things and places, colours, numbers, and what it depends on.
    """
    knowledge, words = context.knowledge, context.situation.request.words
    read = " and ".join(name for one in commands for name in (one.target, *one.exceptions))
    things = [name for name in knowledge.names_in(words) if name not in knowledge.names_in(read)]
    spoken_of = {place for one in commands for place in _places_of(context, one)}
    places = [
        place
        for place in placed(words, knowledge.is_place)
        if place and not {*places_in(context, place)} <= spoken_of
    ]
    said = set(re.findall(r"[a-z]+", words.lower()))
    colors = [
        color
        for color in (*COLORS, *OTHER_SPELLINGS)
        if color in said
        and not any(knowledge.objects_named(f"{color} {c.target}") for c in commands)
    ]
    others = context.interpreter.passed_over(words, commands)
    things_said = (context.as_said(context.say.words(name)) for name in things)
    return [*dict.fromkeys((*things_said, *places, *colors, *others))]


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
        self.situation.agenda.tasks.clear()
        if remark := self.situation.request.remark:
            return self.fail(remark.removesuffix("."))
        self.situation.ending.status = MissionStatus.NOT_UNDERSTOOD
        why = self.context.interpreter.not_understood(self.situation.request.words)
        return self.fail(
            f'{why}; say for example "Find an apple", "Take the mug" or "Bring a sugar box"'
        )
