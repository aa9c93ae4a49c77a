"""Tasks in parts: with several things, with one of several, or with a condition."""

from collections.abc import Sequence
from dataclasses import replace

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from executive.types.commands import ALL, Command, CommandKind
from trees.context import MissionContext
from trees.meant import just_seen, things_meant
from trees.nodes import Check, EachOf, Step, fallback, sequence
from trees.place_words import not_seen_yet
from trees.places import destination_of_all, taken_from
from trees.survey import not_seen, nothing_there, survey
from trees.unknown import nearest, unresolved
from trees.wholes import without_condition


def several(context: MissionContext) -> Behaviour:
    """Split a task into parts, which go on the agenda.

    The goal has to be known before anything is done. If the words say where the things are, the
    robot first goes there to see which ones there are.
    """
    request = context.situation.request

    def somewhere() -> Sequence[str]:
        command = request.command
        return [command.source] if command and command.source and not command.among else []

    return sequence(
        "several",
        Check("several things", context, lambda: is_in_parts(context)),
        fallback(
            "in parts",
            OnACondition("on a condition", context),
            sequence(
                "each of them",
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


class OnACondition(Step):
    """Succeeds if the task has a condition; the first part is to check it.

    A thing that is to be put next to another one is such a task: the other one is found first.

    Reads request.command; writes agenda.wholes and agenda.tasks.
    """

    def update(self) -> Status:
        """Split the task; if the condition has no check of its own, the first part is the deed."""
        command = self.situation.request.command
        assert command
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
    """Succeeds if there are such things; makes tasks of as many as are wanted.

    Reads request.command and survey.seen; writes agenda.wholes and agenda.tasks.
    """

    def update(self) -> Status:
        """The parts are the given names, else the things that were seen, else all of the class."""
        command, found = self.situation.request.command, self.situation.survey.found
        assert command
        why = not_seen(self.context) if self.situation.survey.seen else ""
        if self.situation.survey.seen:
            if not found:
                return self.fail("; ".join(filter(None, (nothing_there(self.context), why))))
            parts = [part_of(command, name, place) for name, place in found.items()]
        elif command.among:
            parts = [part_of(command, name, command.source) for name in command.among]
        else:
            parts = [part_of(command, name, "") for name in self._meant(command)]
        if not parts:
            near = nearest(self.context, command.target)
            return self.fail(unresolved(self.context, command.target, near))
        wanted = len(parts) if command.number == ALL else max(command.number, 1)
        unseen = why if command.number == ALL or wanted > len(parts) else ""
        self.situation.agenda.split(command, parts, min(wanted, len(parts)), unseen)
        return self.succeed(", ".join(part.target for part in parts))

    def _meant(self, command: Command) -> Sequence[str]:
        """All things that the words mean.

        For "put back", those that the robot took, if there are any; for "the fruits", those that
        were just seen, if there are any.
        """
        names, nearer = things_meant(self.context, command), list[str]()
        if command.kind == CommandKind.PUT_BACK:
            nearer = [name for name in names if taken_from(self.context, name)]
        elif command.plural:
            nearer = [name for name in names if name in just_seen(self.context)]
        return nearer or names


def part_of(command: Command, name: str, place: str) -> Command:
    """The same deed with one thing, at a place if one is given."""
    return replace(
        command, target=name, source=place, purpose="", exceptions=(), number=0, among=()
    )
