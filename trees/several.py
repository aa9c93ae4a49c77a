"""Tasks that are done part by part: with several things, or on a condition."""

from collections.abc import Sequence
from dataclasses import replace

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from executive.language.commands import THING
from executive.language.meaning import Answer, Choice, Correction, Request, Said, Thing, Things
from executive.types.commands import ALL, Command, CommandKind
from executive.types.dialogue import Question, QuestionKind
from trees.asking import AskYesNo
from trees.context import MissionContext
from trees.corrections import correct
from trees.meant import just_seen, meant, things_meant
from trees.nodes import Check, EachOf, Step, fallback, sequence
from trees.place_words import not_seen_yet
from trees.places import destination_of_all, taken_from
from trees.survey import not_seen, nothing_there, survey
from trees.telling import number, tell
from trees.unknown import nearest, unresolved
from trees.wholes import without_condition


def several(context: MissionContext) -> Behaviour:
    """Split a task into its parts, and put these on the agenda.

    The goal must be known before anything is done. If the words name the place of the things, the
    robot goes there to see which things there are.
    """
    request = context.situation.request

    def somewhere() -> Sequence[str]:
        command = request.command
        return [command.source] if command and command.source and not command.among else []

    def all_there_is() -> Sequence[Command]:
        command = request.command
        return [command] if command and is_all_there_is(context, command) else []

    return sequence(
        "several",
        Check("several things", context, lambda: is_in_parts(context)),
        fallback(
            "in parts",
            OnACondition("on a condition", context),
            sequence(
                "each of them",
                EachOf("if it is all there is", all_there_is, AskWhetherAll("ask", context)),
                destination_of_all(context),
                EachOf("if it is somewhere", somewhere, survey(context)),
                EachThing("each thing", context),
            ),
        ),
    )


def is_in_parts(context: MissionContext) -> bool:
    """Whether the current task has to be done in parts."""
    command = context.situation.request.command
    return command is not None and (command.is_plural or bool(not_seen_yet(context)))


def is_all_there_is(context: MissionContext, command: Command) -> bool:
    """Whether every thing of the home is to be carried: "bring everything" seldom means that."""
    if command.number != ALL or command.source or not command.kind.means.carries:
        return False
    find, names = context.knowledge.objects_named, things_meant(context, command)
    everything = {*meant(context.knowledge, command)} == {*find(THING)}
    return everything and len(names) > 1 and which_of_all(context, command) == names


class AskWhetherAll(AskYesNo):
    """Asks whether really every thing is to be carried.

    Reads request.command.
    """

    def question(self) -> Question:
        """Say how many they are."""
        command = self.situation.request.asked_for
        names = things_meant(self.context, command)
        text = f"Do you mean all {number(len(names))} things that I know, wherever they are?"
        return Question(QuestionKind.CONFIRM, command.target, text, names)

    def agreed(self) -> None:
        """All are meant."""

    def understood(self, answer: str) -> bool:
        """Beside yes and no, all may be said again; who names some means these."""
        said = self.context.interpreter.read(answer)
        if isinstance(said, Answer) and said.choice == Choice.ALL:
            self._agrees = True
            return True
        return _some_of_all(said) is None and super().understood(answer)

    def _attend_to(self, said: Said, words: str) -> bool:
        """Do what was asked for with those that are named: "no, only the fruits"."""
        if (some := _some_of_all(said)) is None:
            return super()._attend_to(said, words)
        tell(self.context, correct(self.context, some, words, f"I {self.doing()}."))
        return True

    def unresolved(self) -> str:
        """It may be fewer."""
        return "I do not know which things you mean"


def _some_of_all(said: Said) -> Correction | None:
    """What is wished instead of all that there is; None if nothing is named."""
    match said:
        case Answer(things=Things(members=[Thing(pronoun=False), *_]) as things):
            return Correction(things)
        case Correction(meant=Request() | Things()):
            return said
    return None


class OnACondition(Step):
    """Succeeds if the task has a condition; checking it becomes the first part.

    If a thing is to be put beside another one, finding that is such a condition.

    Reads request.command; writes agenda.wholes and agenda.tasks.
    """

    def update(self) -> Status:
        """Begin with the condition; if it names no place, begin with the deed, which shows it."""
        command = self.situation.request.asked_for
        if not command.conditional and (beside := not_seen_yet(self.context)):
            either = tuple(beside.split(" or "))
            among = either if len(either) > 1 else ()
            find = Command(CommandKind.FIND, beside, command.words, among=among)
            command = replace(command, conditional=True, sought=find)
            self.situation.request.command = command
        if not command.conditional:
            return Status.FAILURE
        first = command.sought or without_condition(command)
        self.situation.agenda.split(command, (first,), wanted=1)
        return self.succeed(first.kind)


class EachThing(Step):
    """Succeeds if there are such things; as many as the person wants become tasks.

    Reads request.command and survey.seen; writes agenda.wholes and agenda.tasks.
    """

    def update(self) -> Status:
        """Take the things that were seen, or those that were named, or all of the class."""
        command, found = self.situation.request.asked_for, self.situation.survey.found
        why = not_seen(self.context) if self.situation.survey.seen else ""
        if self.situation.survey.seen:
            if not found:
                return self.fail("; ".join(filter(None, (nothing_there(self.context), why))))
            parts = [part_of(command, name, place) for name, place in found.items()]
        elif command.among:
            parts = [part_of(command, name, command.source) for name in command.among]
        else:
            parts = [part_of(command, name, "") for name in which_of_all(self.context, command)]
        if not parts:
            near = nearest(self.context, command.target)
            return self.fail(unresolved(self.context, command.target, near))
        wanted = len(parts) if command.number == ALL else max(command.number, 1)
        unseen = why if command.number == ALL or wanted > len(parts) else ""
        self.situation.agenda.split(command, parts, min(wanted, len(parts)), unseen)
        return self.succeed(", ".join(part.target for part in parts))


def which_of_all(context: MissionContext, command: Command) -> tuple[str, ...]:
    """All things that the words mean.

    If they are to be put back, only those that the robot has taken, if it took any. Of a plural
    like "the fruits", only those that were just seen, if any were.
    """
    names, nearer = things_meant(context, command), tuple[str, ...]()
    if command.kind == CommandKind.PUT_BACK:
        nearer = tuple(name for name in names if taken_from(context, name))
    elif command.plural:
        nearer = tuple(name for name in names if name in just_seen(context))
    return nearer or names


def part_of(command: Command, name: str, place: str) -> Command:
    """The same deed with one thing, at a place if one is given."""
    return replace(
        command, target=name, source=place, purpose="", exceptions=(), number=0, among=()
    )
