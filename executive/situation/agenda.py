"""The tasks of a mission: those still to do, and the outcomes of those that have ended."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import asdict, dataclass, field, replace
from typing import Any

from executive.situation.ending import TAKEN_BACK
from executive.situation.request import command_as_logged
from executive.situation.snapshot import NOT_LOGGED, logged_as
from executive.types.commands import Command, Commands
from executive.types.outcome import MissionStatus, TaskOutcome


@dataclass(frozen=True, slots=True)
class Task:
    """One task still to do.

    Attributes:
        group: consecutive tasks with the same group may be done in any order.
        depth: 0 for a task of its own; 1 for a part of a task, 2 for a part of a part, and so on.
    """

    command: Command
    group: int
    depth: int = 0


@dataclass
class Whole:
    """A task that was split into parts; the parts still to do are on the agenda."""

    command: Command = field(metadata=logged_as(plain=command_as_logged))
    wanted: int
    """How many of the parts have to be done."""
    unseen: str = ""
    """Why there may be unknown parts, as a clause; empty if all are known."""
    parts: list[TaskOutcome] = field(default_factory=list)
    """The outcomes of the parts that have ended."""

    @property
    def done(self) -> list[TaskOutcome]:
        """The parts that were done."""
        return [part for part in self.parts if part.status == MissionStatus.DONE]


def _tasks(tasks: list[Task]) -> list[dict[str, Any] | None]:
    return [command_as_logged(task.command) for task in tasks]


def _wholes(wholes: list[Whole]) -> list[dict[str, Any] | None]:
    return [command_as_logged(whole.command) for whole in wholes]


def _parts(wholes: list[Whole]) -> list[list[dict[str, Any]]]:
    return [[asdict(part) for part in whole.parts] for whole in wholes]


@dataclass
class Agenda:
    """The tasks of a mission, except the current one, which is `Request.command`.

    Tasks may be added at any time. If `instead` or `taken_back` is set, the tree interrupts the
    current task and goes on with the next.
    """

    tasks: list[Task] = field(default_factory=list, metadata=logged_as(plain=_tasks))
    """Tasks still to do, the next first."""
    ended: list[TaskOutcome] = field(default_factory=list)
    """The outcomes of the tasks that have ended, in order."""
    wholes: list[Whole] = field(
        default_factory=list, metadata=logged_as(plain=_wholes, beside={"parts": _parts})
    )
    """The task that is being done in parts; after it, a part of it that was itself split."""
    instead: Command | None = field(default=None, metadata=logged_as(plain=command_as_logged))
    """The command to do at once in place of the current task; None if there is none."""
    taken_back: bool = False
    """Whether the person took the current task back."""
    unsettled: bool = False
    """Whether the robot was grasping or putting down when the task was abandoned."""
    _groups: int = field(default=0, metadata=NOT_LOGGED)

    @property
    def whole_tasks(self) -> list[Task]:
        """Tasks still to do that are not parts of another task, the next first."""
        return [task for task in self.tasks if not task.depth]

    def add(self, commands: Iterable[tuple[Command, ...]]) -> None:
        """Append tasks, in groups."""
        self.tasks += self._in_groups(commands, 0)

    def split(
        self, command: Command, parts: Sequence[Command], wanted: int, unseen: str = ""
    ) -> None:
        """Split the current task into parts: do them in any order, until `wanted` of them are done.

        `unseen` says why there may be more parts than these; if it is not empty, the task does not
        count as all done.
        """
        self.wholes.append(Whole(command, wanted, unseen))
        self.go_on_with((tuple(parts),))

    def go_on_with(self, parts: Commands) -> None:
        """Insert these as the next parts of the innermost split task."""
        self.tasks[:0] = self._in_groups(parts, len(self.wholes))

    def drop_parts(self) -> None:
        """Remove the parts of the innermost split task that were not begun."""
        self.tasks = [task for task in self.tasks if task.depth < len(self.wholes)]

    @property
    def has_parts(self) -> bool:
        """Whether parts of the innermost split task are still to do."""
        return any(task.depth == len(self.wholes) for task in self.tasks)

    @property
    def goes_on(self) -> bool:
        """Whether there certainly is more to do once the current task is done."""
        if not self.wholes or any(task.depth < len(self.wholes) for task in self.tasks):
            return bool(self.tasks)
        whole = self.wholes[-1]
        found_first = whole.command.sought and whole.command.sought.kind.means.searches
        return bool(found_first) or (self.has_parts and whole.wanted - len(whole.done) > 1)

    def replace(self, first: Command, others: Sequence[Command] = ()) -> None:
        """Replace the current task by these, in this order."""
        self._leave_parts()
        self.instead = first
        self.tasks[:0] = self._in_groups([(command,) for command in others], 0)

    def take_back(self) -> None:
        """Take the current task back, with all its parts."""
        self._leave_parts()
        self.taken_back = True

    def limit(self, number: int) -> None:
        """Set how many parts of the split task to do; drop the current one if these are done."""
        whole = self.wholes[-1]
        whole.wanted, whole.unseen = number, ""
        whole.command = replace(whole.command, number=number)
        self.taken_back = len(whole.done) >= number

    def strike_out(self, task: Task) -> None:
        """Remove a task that was not begun; if it is a part, the other parts stay."""
        self.tasks.remove(task)
        command = task.command
        came_of_it = TaskOutcome(
            command.kind, command.target, None, MissionStatus.NOT_DONE, TAKEN_BACK, None
        )
        (self.wholes[task.depth - 1].parts if task.depth else self.ended).append(came_of_it)

    def change(self, task: Task, command: Command) -> None:
        """Change the command of a task that was not begun."""
        self.tasks[self.tasks.index(task)] = replace(task, command=command)

    def whole_of(self, at_hand: Command | None) -> Command | None:
        """The command of the whole that the current task is a part of, or of the task itself."""
        return self.wholes[0].command if self.wholes else at_hand

    @property
    def interrupts(self) -> bool:
        """Whether the current task has to be abandoned."""
        return self.taken_back or self.instead is not None

    def next_ones(self) -> tuple[Task, ...]:
        """The tasks of the first group: any of them may be next."""
        return tuple(task for task in self.tasks if task.group == self.tasks[0].group)

    def take(self, task: Task) -> Command:
        """Remove a task to begin it; return its command."""
        self.tasks.remove(task)
        return task.command

    def end(self, outcome: TaskOutcome) -> None:
        """Keep the outcome of a task, or of a part."""
        (self.wholes[-1].parts if self.wholes else self.ended).append(outcome)

    def visited(self) -> Iterator[str]:
        """The places that the robot visited in the tasks and parts that have ended."""
        for task in (*self.ended, *(part for whole in self.wholes for part in whole.parts)):
            yield from task.visited

    def _leave_parts(self) -> None:
        self.tasks = self.whole_tasks
        self.wholes.clear()

    def _in_groups(self, commands: Iterable[tuple[Command, ...]], depth: int) -> list[Task]:
        tasks: list[Task] = []
        for group in commands:
            self._groups += 1
            tasks += [Task(command, self._groups, depth) for command in group]
        return tasks
