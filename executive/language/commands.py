"""From what was said to a command that the tree can carry out, or to a word on why not."""

from collections.abc import Sequence
from dataclasses import replace

from executive.language.meaning import (
    ME,
    About,
    Choice,
    Correction,
    Courtesy,
    Question,
    Refusal,
    Relation,
    Request,
    Said,
    Statement,
    Task,
    Thing,
    Things,
    Unable,
    Verb,
    Where,
)
from executive.types import HELD, Command, CommandKind

_DEEDS = [kind.replace("_", " ") for kind in CommandKind]
CAN = f"I can {', '.join(_DEEDS[:-1])} and {_DEEDS[-1]}, one thing at a time"
CANNOT = {
    Verb.CLEAR: "I cannot tidy up so far",
    Verb.COUNT: "I cannot count things so far",
    Verb.TELL: "I cannot tell what is there so far",
    Verb.CHECK: "I cannot tell whether something is there so far, but I can find it",
}
UNTOLD = "I cannot tell you that so far."
COURTESIES = {
    Courtesy.HELLO: "Hello!",
    Courtesy.THANKS: "You are welcome.",
    Courtesy.GOODBYE: "Goodbye!",
}
THING = "thing"
_ALONE = (Verb.FIND, Verb.TAKE, Verb.BRING)
"""Deeds that another one with "it" may follow, which has them in it."""


def command_in(said: Said, words: str) -> Command | str | None:
    """The command; or what to say of it, if it was read but is not to be done, or cannot be.

    None if there is nothing to say: it was not read, or answers a question.
    """
    match said:
        case Request():
            return _command(_folded(said.tasks), words)
        case Refusal():
            return "Then I will not."
        case Unable():
            return f"I cannot {said.verb}."
        case Question():
            return UNTOLD if said.about not in (About.ABILITIES, About.SELF) else talk(said)
        case Courtesy():
            return talk(said)
        case Statement():
            return "I cannot take note of that so far; I ask when I need to know it."
        case Correction():
            return "I am doing nothing that this could change; say all that I am to do."
    return None


def talk(said: Said, things: Sequence[str] = ()) -> str:
    """What to say to what asks for no deed; `things` are examples. Empty if it is nothing such."""
    if isinstance(said, Courtesy):
        return COURTESIES[said]
    if not isinstance(said, Question) or said.about not in (About.ABILITIES, About.SELF):
        return ""
    a, b, c = (*things, "mug", "apple", "hammer")[:3]
    return (
        f"{CAN}. Say for example 'Find the {a}', 'Take the {b}', 'Bring me the {c}' or "
        "'Put it down'; 'stop' ends what I do, 'quit' ends the session."
    )


def agrees(said: Said) -> bool | None:
    """Whether it says yes or no; None if it says neither."""
    match said:
        case Request(agrees=True):
            return True
        case Correction(denies=True) | Refusal():
            return False
    choice = getattr(said, "choice", None)
    return {Choice.YES: True, Choice.NO: False}.get(choice) if choice else None


def _folded(tasks: Sequence[Task]) -> tuple[Task, ...]:
    """As few tasks as say the same: "find the mug and bring it" is "bring the mug"."""
    folded: list[Task] = []
    for task in tasks:
        before = folded[-1] if folded else None
        if before and before.verb == Verb.GO and before.goal not in (None, ME) and _places(task):
            folded[-1] = replace(task, source=before.goal)
        elif before and before.verb in _ALONE and not before.goal and _goes_on(task):
            folded[-1] = replace(before, verb=task.verb, goal=task.goal, said=task.said)
        else:
            folded.append(task)
    return tuple(folded)


def _places(task: Task) -> bool:
    """Whether it has a thing that may be where the robot was told to go before."""
    return task.verb in _ALONE and task.source is None and not _is_it(task.things)


def _goes_on(task: Task) -> bool:
    """Whether it is about the thing of the task before."""
    further = task.verb in (Verb.TAKE, Verb.BRING, Verb.PUT)
    return further and _is_it(task.things) and task.source is None and not task.conditional


def _is_it(things: Things | None) -> bool:
    if things is None or len(things.members) != 1:
        return False
    [thing] = things.members
    return thing.pronoun and not thing.other and thing.number is None


def _command(tasks: tuple[Task, ...], words: str) -> Command | str:
    """What the tree can do: one task, with one kind of thing."""
    if len(tasks) != 1:
        return "I can do one thing at a time so far; tell me the first, then the next."
    [task] = tasks
    if why := _why_not(task):
        return f"{why}. {CAN}."
    if task.goal == ME and task.verb == Verb.PUT:
        task = replace(task, verb=Verb.BRING)
    members = task.things.members if task.things else ()
    return Command(
        CommandKind(task.verb),
        _held(task.things) if task.verb == Verb.PUT_DOWN else _names(task.things),
        words,
        source=_in_words(task.source) if task.source else "",
        goal=_in_words(task.goal) if task.goal and task.verb != Verb.BRING else "",
        purpose=" and ".join(thing.purpose for thing in members if thing.purpose),
        exceptions=tuple(but.words for thing in members for but in thing.exceptions),
    )


def _why_not(task: Task) -> str:
    """Why the tree cannot do it, as a clause; empty if it can."""
    if task.conditional:
        return "I cannot do things on a condition so far"
    if task.verb.value not in {kind.value for kind in CommandKind}:
        return CANNOT[task.verb]
    for place in (task.source, task.goal):
        if place and place.pronoun:
            return f"I do not know where '{place.words}' is; say the name of the place"
    if task.verb == Verb.PUT_DOWN and task.source:
        return "I put down only what I hold"
    things = task.things.members if task.things else ()
    if any(but.pronoun for thing in things for but in thing.exceptions):
        return "I do not know what is not meant; say its name"
    if any(thing.number not in (None, 1) for thing in things):
        return f"I cannot {task.verb} several things at once so far"
    return ""


def _held(things: Things | None) -> str:
    """What is to be put down."""
    held = things is None or _is_it(things) or _names(things) == THING
    return HELD if held or things is None else _names(things)


def _names(things: Things | None) -> str:
    if things is None:
        return ""
    return (" or " if things.one_of else " and ").join(map(_name, things.members))


def _name(thing: Thing) -> str:
    """What it is called; "something" may be any thing."""
    named = thing.words or thing.purpose or thing.pronoun
    return thing.said if named else THING


def _in_words(where: Where) -> str:
    """A place as words that its name can be looked for in."""
    near = {Relation.NEXT_TO: "next to ", Relation.UNDER: "under "}.get(where.relation, "")
    within = f" in {_in_words(where.within)}" if where.within else ""
    return " or ".join([f"{near}{where.words}{within}", *map(_in_words, where.others)])
