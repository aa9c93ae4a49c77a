"""What there is to do, one task after the other, and what came of those that have ended."""

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
    """One thing to do.

    Those that follow each other in one `group` may be done in any order. What is a part of another
    task has its `depth`: 1, or more if that is a part itself.
    """

    command: Command
    group: int
    depth: int = 0


@dataclass
class Whole:
    """A task that is done in parts: those that are left are on the agenda."""

    command: Command = field(metadata=logged_as(plain=command_as_logged))
    wanted: int
    """How many of the parts are enough."""
    unseen: str = ""
    """Why there may be more parts than are known, as a clause; empty if there are not."""
    parts: list[TaskOutcome] = field(default_factory=list)
    """What came of those that have ended."""

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
    """The tasks of a mission; the one at hand is `Request.command`, and in none of these lists.

    A wish may be added at any time. `instead` replaces the task at hand, and what is `taken_back`
    is not done: the tree sees it, interrupts what it does, and goes on with the next.
    """

    tasks: list[Task] = field(default_factory=list, metadata=logged_as(plain=_tasks))
    """Those to be done yet, the next first."""
    ended: list[TaskOutcome] = field(default_factory=list)
    """What came of the others, in the order in which they ended."""
    wholes: list[Whole] = field(
        default_factory=list, metadata=logged_as(plain=_wholes, beside={"parts": _parts})
    )
    """The task that is being done in parts; behind it a part of it that is done so, too."""
    instead: Command | None = field(default=None, metadata=logged_as(plain=command_as_logged))
    """What is to be done at once in place of the task at hand; None for nothing."""
    taken_back: bool = False
    """Whether the task at hand is not to be done after all."""
    unsettled: bool = False
    """Whether the robot was handling something when the task was given up."""
    _groups: int = field(default=0, metadata=NOT_LOGGED)

    @property
    def whole_tasks(self) -> list[Task]:
        """Those to be done yet that are no part of another, the next first."""
        return [task for task in self.tasks if not task.depth]

    def add(self, commands: Iterable[tuple[Command, ...]]) -> None:
        """Do these, too, after all others."""
        self.tasks += self._in_groups(commands, 0)

    def split(
        self, command: Command, parts: Sequence[Command], wanted: int, unseen: str = ""
    ) -> None:
        """Do the task at hand in these parts, in any order, until so many of them are done.

        It is not all done if more may be meant than these: `unseen` says why that is not known.
        """
        self.wholes.append(Whole(command, wanted, unseen))
        self.go_on_with((tuple(parts),))

    def go_on_with(self, parts: Commands) -> None:
        """Do these next, as parts of the task that is done so."""
        self.tasks[:0] = self._in_groups(parts, len(self.wholes))

    def drop_parts(self) -> None:
        """Leave the parts that were not begun."""
        self.tasks = [task for task in self.tasks if task.depth < len(self.wholes)]

    @property
    def has_parts(self) -> bool:
        """Whether there are any such."""
        return any(task.depth == len(self.wholes) for task in self.tasks)

    @property
    def goes_on(self) -> bool:
        """Whether there is more to do for sure, once the task at hand is done."""
        if not self.wholes or any(task.depth < len(self.wholes) for task in self.tasks):
            return bool(self.tasks)
        whole = self.wholes[-1]
        found_first = whole.command.sought and whole.command.sought.kind.means.searches
        return bool(found_first) or (self.has_parts and whole.wanted - len(whole.done) > 1)

    def replace(self, first: Command, others: Sequence[Command] = ()) -> None:
        """Do these at once in place of the task at hand, in this order."""
        self._leave_parts()
        self.instead = first
        self.tasks[:0] = self._in_groups([(command,) for command in others], 0)

    def take_back(self) -> None:
        """Do not do the task at hand after all."""
        self._leave_parts()
        self.taken_back = True

    def limit(self, number: int) -> None:
        """Do so many parts of the task that is done so; with these done, not the one at hand."""
        whole = self.wholes[-1]
        whole.wanted, whole.unseen = number, ""
        whole.command = replace(whole.command, number=number)
        self.taken_back = len(whole.done) >= number

    def strike_out(self, task: Task) -> None:
        """Do not do a task that was not begun; if it is a part of one, the others are done."""
        self.tasks.remove(task)
        command = task.command
        came_of_it = TaskOutcome(
            command.kind, command.target, None, MissionStatus.NOT_DONE, TAKEN_BACK, None
        )
        (self.wholes[task.depth - 1].parts if task.depth else self.ended).append(came_of_it)

    def change(self, task: Task, command: Command) -> None:
        """Have a task that was not begun ask for something else."""
        self.tasks[self.tasks.index(task)] = replace(task, command=command)

    def whole_of(self, at_hand: Command | None) -> Command | None:
        """What the task at hand is a part of, or itself."""
        return self.wholes[0].command if self.wholes else at_hand

    @property
    def interrupts(self) -> bool:
        """Whether the task at hand is to be given up."""
        return self.taken_back or self.instead is not None

    def next_ones(self) -> tuple[Task, ...]:
        """Those that may be done next."""
        return tuple(task for task in self.tasks if task.group == self.tasks[0].group)

    def take(self, task: Task) -> Command:
        """Strike out a task that is begun; what it asks for."""
        self.tasks.remove(task)
        return task.command

    def end(self, outcome: TaskOutcome) -> None:
        """Keep what came of a task, or of a part of one."""
        (self.wholes[-1].parts if self.wholes else self.ended).append(outcome)

    def visited(self) -> Iterator[str]:
        """Where the robot got to in the tasks that have ended."""
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
