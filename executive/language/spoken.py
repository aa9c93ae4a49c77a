"""What was spoken of before: what "it", "there", "another" and "again" stand for."""

from dataclasses import dataclass, replace

from pydantic import TypeAdapter

from executive.language.meaning import Question, Request, Said, Statement, Task, Thing, Things
from executive.types.commands import CommandKind

QUESTIONS = (CommandKind.CHECK, CommandKind.COUNT, CommandKind.TELL)


@dataclass(frozen=True, slots=True)
class Spoken:
    """What was spoken of last.

    Attributes:
        things: names of the things that it was about, the last one at the end.
        called: how they were called: "fruit".
        place: where they are, or the robot is to be.
        request: what was asked for last, with names in it.
    """

    things: tuple[str, ...] = ()
    called: str = ""
    place: str = ""
    request: Request | None = None

    def to_json(self) -> str:
        """As a recording keeps it."""
        return _SPOKEN.dump_json(self, exclude_defaults=True).decode()

    @classmethod
    def from_json(cls, text: str) -> "Spoken":
        """As a recording kept it.

        Raises:
            ValueError: if it is something else.
        """
        return _SPOKEN.validate_json(text)


_SPOKEN = TypeAdapter(Spoken)
NOTHING = Spoken()


def after(said: Said, before: Spoken, *, things: tuple[str, ...] = (), place: str = "") -> Spoken:
    """What was spoken of, when this was said.

    Args:
        said: with names for pronouns.
        before: what was spoken of before.
        things: the objects that it turned out to be about.
        place: where they turned out to be.
    """
    match said:
        case Request():
            named = [task for task in said.tasks if task.things]
            kind = called(named[-1].things) if named else ""
            goal = next((t.goal.words for t in reversed(said.tasks) if t.goal), "")
            goal = goal or _asked_about(said.tasks[-1])
            things = things or _asked_for(said.tasks[-1])
            new = replace(before, request=said, called=kind or before.called)
        case Statement() | Question(things=Things()):
            assert said.things
            new, goal = replace(before, called=called(said.things)), ""
        case _:
            return before
    return replace(new, things=things or before.things, place=goal or place or before.place)


def _asked_about(task: Task) -> str:
    """The place of a question: "what is on the desk"; empty for a deed."""
    asked = task.source if task.verb in QUESTIONS else None
    return asked.words if asked and not asked.pronoun and not asked.others else ""


def _asked_for(task: Task) -> tuple[str, ...]:
    """The one thing of a question: "is there an apple"; none for a deed."""
    members = task.things.members if task.things and task.verb in QUESTIONS else ()
    return (members[0].words,) if len(members) == 1 and members[0].words else ()


def called(things: Things | None) -> str:
    """How the last of the things was called; empty for a pronoun."""
    thing = things.members[-1] if things and things.members else Thing()
    return "" if thing.pronoun else thing.words
