"""What there is to do, one task after the other, and what came of those that have ended."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any

from executive.situation.request import command_as_logged
from executive.situation.snapshot import NOT_LOGGED, logged_as
from executive.types import Command, TaskOutcome


@dataclass(frozen=True, slots=True)
class Task:
    """One thing to do; those that follow each other in one `group` may be done in any order."""

    command: Command
    group: int = 0


def _tasks(tasks: list[Task]) -> list[dict[str, Any] | None]:
    return [command_as_logged(task.command) for task in tasks]


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
    instead: Command | None = field(default=None, metadata=logged_as(plain=command_as_logged))
    """What is to be done at once in place of the task at hand; None for nothing."""
    taken_back: bool = False
    """Whether the task at hand is not to be done after all."""
    _groups: int = field(default=0, metadata=NOT_LOGGED)

    def add(self, commands: Iterable[tuple[Command, ...]]) -> None:
        """Do these, too, after all others."""
        for group in commands:
            self._groups += 1
            self.tasks += [Task(command, self._groups) for command in group]

    def replace(self, first: Command, others: Sequence[Command] = ()) -> None:
        """Do these at once in place of the task at hand, in this order."""
        self.instead = first
        before = self.tasks
        self.tasks = []
        self.add((command,) for command in others)
        self.tasks += before

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

    def visited(self) -> Iterator[str]:
        """Where the robot got to in the tasks that have ended."""
        for task in self.ended:
            yield from task.visited
