"""What a participant goes through, step by step."""

from dataclasses import dataclass
from enum import StrEnum

from executive.page.study.file import Condition, Study, Task
from executive.page.study.order import balanced, rotated


class Kind(StrEnum):
    """What a step is."""

    CONSENT = "consent"
    INSTRUCTIONS = "instructions"
    PART = "part"
    """A condition begins."""
    TASK = "task"
    QUESTIONNAIRE = "questionnaire"
    THANKS = "thanks"


@dataclass(frozen=True)
class Step:
    """One step of one participant.

    Attributes:
        kind: what it is.
        condition: in which one; empty outside of any.
        position: the how-manieth condition that is of this participant, from 1; 0 outside.
        name: of the task or questionnaire.
        turn: the how-manieth task that is of its condition, from 1; 0 for what is none.
    """

    kind: Kind
    condition: str = ""
    position: int = 0
    name: str = ""
    turn: int = 0

    @property
    def key(self) -> str:
        """Tells it from the other steps of its participant."""
        return "/".join(part for part in (self.kind, self.condition, self.name) if part)


def order(study: Study, number: int) -> tuple[Condition, ...]:
    """The conditions as the participant of this number (from 1) meets them."""
    if study.order == "as written":
        return study.conditions
    return balanced(study.conditions, number)


def steps(study: Study, number: int) -> tuple[Step, ...]:
    """All steps of the participant of this number (from 1)."""
    found = [Step(Kind.CONSENT), Step(Kind.INSTRUCTIONS)]
    found += [Step(Kind.QUESTIONNAIRE, name=name) for name in study.at_start]
    for position, condition in enumerate(order(study, number), 1):
        where = condition.name, position
        found.append(Step(Kind.PART, *where))
        for turn, task in enumerate(_tasks(study, number + position), 1):
            found.append(Step(Kind.TASK, *where, task.name, turn))
        found += [Step(Kind.QUESTIONNAIRE, *where, name) for name in study.after_each]
    found += [Step(Kind.QUESTIONNAIRE, name=name) for name in study.at_end]
    return (*found, Step(Kind.THANKS))


def _tasks(study: Study, by: int) -> tuple[Task, ...]:
    return rotated(study.tasks, by) if study.task_order == "rotated" else study.tasks
