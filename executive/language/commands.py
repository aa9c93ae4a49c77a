"""From what was said to a command that the tree can carry out, or to a word on why not."""

from collections.abc import Iterable, Sequence
from dataclasses import replace

from executive.language.folding import asks_for_things, is_it
from executive.language.meaning import (
    ME,
    SO,
    About,
    Again,
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
    Where,
)
from executive.language.phrases import is_plural
from executive.types.commands import HELD, Command, CommandKind, Commands

_QUESTIONS = {
    CommandKind.COUNT: "count things",
    CommandKind.TELL: "tell what is somewhere",
    CommandKind.CHECK: "check whether something is there",
    CommandKind.CLEAR: "clear a table",
}
_DEEDS = [_QUESTIONS.get(kind) or kind.replace("_", " ") for kind in CommandKind]
CAN = f"I can {', '.join(_DEEDS[:-1])} and {_DEEDS[-1]}, one after the other"
NOT_KNOWN_WHAT = "I hear '{}', and do not understand the rest."
"""Said of a negation that is about nothing that there is to do."""
WILL_NOT = "Then I will not."
NOT_KEPT = " I do not keep that in mind: what you ask for later counts."
SAY_INSTEAD = " Say once more what I am to do instead."
SAY_THE_REST = " Say once more what else I am to do."
LEAVE_OUT_PLACES = "leave out places; say where I am to look, or to put things"
UNTOLD = "I cannot tell you that so far."
COURTESIES = {
    Courtesy.HELLO: "Hello!",
    Courtesy.THANKS: "You are welcome.",
    Courtesy.GOODBYE: "Goodbye!",
}
THING = "thing"
_NOT_SEEN = (Relation.UNDER, Relation.BEHIND, Relation.IN_FRONT_OF, Relation.ABOVE)
"""Sides of furniture where nothing is looked for."""
_LOOKING = (CommandKind.FIND, CommandKind.COUNT, CommandKind.CHECK, CommandKind.TELL)


def commands_in(said: Said, words: str) -> Commands | str | None:
    """The tasks; or what to say of it, if it was read but is not to be done, or cannot be.

    None if there is nothing to say: it was not read, or answers a question.
    """
    match said:
        case Request():
            return _commands(said.tasks, words)
        case Refusal():
            return WILL_NOT + (SAY_INSTEAD if said.more else NOT_KEPT)
        case Again():
            return "There is nothing yet that I could do again."
        case Unable():
            instead = f" things; {said.instead}" * bool(said.instead)
            return f"I cannot {said.verb}{instead}." + SAY_THE_REST * said.more
        case Question():
            return UNTOLD if said.about not in (About.ABILITIES, About.SELF) else talk(said)
        case Courtesy():
            return talk(said)
        case Statement():
            return "I take note of where things are when I am at nothing else."
        case Correction():
            return "I am doing nothing that this could change; say all that I am to do."
    return None


def left_alone(said: Request) -> str:
    """The names of what is not to be touched, whatever else is done."""
    exceptions = (but for task in said.tasks if task.things for but in task.things.exceptions)
    return " and ".join(but.words for but in exceptions if but.alone)


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


def _commands(tasks: Iterable[Task], words: str) -> Commands | str:
    """A command for each thing of each task; or why one of them cannot be done."""
    commands: list[tuple[Command, ...]] = []
    for task in tasks:
        if why := _why_not(task):
            return f"{why}. {CAN}."
        each = tuple(_command(task, things, words) for things in _each(task))
        in_order = task.things is not None and task.things.in_order
        if (what_else := _what_else(each)) and commands and _is_for_it(commands[-1], each):
            commands[-1] = (replace(commands[-1][0], conditional=True, unless=what_else),)
        else:
            commands += [(one,) for one in each] if in_order else [each]
    return tuple(commands)


def _what_else(each: Sequence[Command]) -> Command | None:
    """What is to be done if a thing cannot be found: "if you cannot find it, bring the pear"."""
    match each:
        case [Command(kind=CommandKind.CHECK, conditional=True, sought=None, source="") as check]:
            return check.unless
    return None


def _is_for_it(before: Sequence[Command], each: Sequence[Command]) -> bool:
    """Whether that is about the thing of the task before, which was asked for come what may."""
    return [one.target for one in before if not one.conditional] == [one.target for one in each]


def _each(task: Task) -> tuple[Things | None, ...]:
    """Of several things that are all meant, each one.

    A condition is about all of them; so is what one hand can do with but one.
    """
    things = task.things
    if things is None or things.one_of or task.conditional or task.verb == CommandKind.TAKE:
        return (things,)
    return tuple(Things((thing,)) for thing in things.members)


def _command(task: Task, things: Things | None, words: str) -> Command:
    if task.conditional:
        return _conditional(task, words)
    members = things.members if things else ()
    brings = task.verb == CommandKind.BRING or (task.verb == CommandKind.PUT and task.goal == ME)
    return Command(
        CommandKind.BRING if brings else task.verb,
        _held(things) if task.verb == CommandKind.PUT_DOWN else _names(things, task.verb),
        words,
        source=in_words(task.source) if task.source else "",
        goal=in_words(task.goal) if task.goal and not brings else "",
        purpose=" and ".join(thing.purpose for thing in members if thing.purpose),
        exceptions=tuple(but.words for thing in members for but in _left_out(task, thing)),
        number=_number(task, members),
        among=tuple(map(_name, members)) if len(members) > 1 else (),
        superlative=_superlative(task),
        plural=task.verb.means.searches and _means_several(members),
    )


def _conditional(task: Task, words: str) -> Command:
    """What is to be done if there is such a thing; where a place is named, only there."""
    sought = task.sought or Task(CommandKind.CHECK, task.things, task.source)
    if sought.things is None or is_it(sought.things):  # "take the mug if it is on the desk"
        sought = replace(sought, things=task.things)
    if is_it(task.things) or task.things == sought.things:
        task = replace(task, things=sought.things, source=task.source or sought.source)
    [deed] = (_command(replace(task, conditional=False), task.things, words),)
    asks = task.verb == CommandKind.CHECK  # "is it there? If not, ..."
    apart = sought.source is not None or _words_of(sought.things) != _words_of(task.things)
    unless = task.unless
    if unless and is_it(unless.things):
        unless = replace(unless, things=task.things)
    return replace(
        deed,
        conditional=True,
        sought=_command(sought, sought.things, words) if apart and not asks else None,
        unless=_command(unless, unless.things, words) if unless else None,
    )


def _words_of(things: Things | None) -> tuple[str, ...]:
    return tuple(thing.words for thing in things.members) if things else ()


def _number(task: Task, members: Sequence[Thing]) -> int:
    """How many, if it was said; that it is one, only counts where a place may have several."""
    if len(members) > 1:
        several = task.things and not task.things.one_of
        return len(members) if several or not task.things else task.things.number % len(members)
    counts = task.verb.means.searches or task.verb == CommandKind.CLEAR
    if not members or not counts:
        return 0
    number = members[0].number or 0
    return number if number != 1 or task.source else 0


def _means_several(members: Sequence[Thing]) -> bool:
    """Whether these are all of a kind, but for a name like "scissors"."""
    if len(members) != 1 or members[0].number is not None:
        return False
    return members[0].definite and not members[0].pronoun and is_plural(members[0].words)


def _superlative(task: Task) -> str:
    members = task.things.members if task.things and task.verb == CommandKind.TELL else ()
    return next((thing.superlative for thing in members), "")


def _why_not(task: Task) -> str:
    """Why the tree cannot do it, as a clause; empty if it can."""
    if task.sought == SO:
        return "I do not know what that depends on; say all of it"
    for place in (task.source, task.goal):
        if place and place.pronoun:
            return f"I do not know where '{place.words}' is; say the name of the place"
    if task.verb in _QUESTIONS and task.source and task.source.relation in _NOT_SEEN:
        return f"I can look on furniture, or in it, but not '{in_words(task.source)}'"
    if task.verb == CommandKind.PUT_DOWN and task.source:
        return "I put down only what I hold"
    if task.verb in (CommandKind.TELL, CommandKind.CLEAR) and not (
        task.source or asks_for_things(task)
    ):
        return f"I can {task.verb} only at a place; say which"
    things = task.things.members if task.things else ()
    if so_many := next((thing.said for thing in things if thing.is_so_many), ""):
        return f"I do not know which ones '{so_many}' are; say their names"
    if any(but.pronoun for thing in things for but in _left_out(task, thing)):
        return "I do not know what is not meant; say its name"
    if task.conditional and len(things) > 1:
        return "I can do things on a condition only one by one"
    parts = (part for part in (task.sought, task.unless) if part)
    return next(filter(None, map(_why_not, parts)), "")


def _left_out(task: Task, thing: Thing) -> tuple[Thing, ...]:
    """What is not meant; who only looks takes nothing: "find the mug and do not touch it"."""
    if task.verb not in _LOOKING:
        return thing.exceptions
    others = (but for but in thing.exceptions if not but.pronoun)
    return tuple(but for but in others if not but.alone or but.words != thing.words)


def _held(things: Things | None) -> str:
    """What is to be put down."""
    held = things is None or is_it(things) or _names(things) == THING
    return HELD if held or things is None else _names(things)


def _names(things: Things | None, verb: CommandKind = CommandKind.FIND) -> str:
    if things is None or verb == CommandKind.GO:
        return ""
    told = verb == CommandKind.TELL
    names = ((thing.words or THING) if told else _name(thing) for thing in things.members)
    return (" or " if things.one_of else " and ").join(names)


def _name(thing: Thing) -> str:
    """What it is called; "something" may be any thing.

    How many there are to be is no part of that, unless it is one: "one" may belong to the name.
    """
    named = thing.words or thing.purpose or thing.pronoun or thing.superlative
    if thing.number not in (None, 1) and thing.words:
        return f"{thing.superlative} {thing.words}".strip()
    return thing.said if named else THING


def in_words(where: Where) -> str:
    """A place as words that its name can be looked for in."""
    near = "" if where.relation.is_plain else f"{where.relation.replace('_', ' ')} "
    within = f" in {in_words(where.within)}" if where.within else ""
    return " or ".join([f"{near}{where.words}{within}", *map(in_words, where.others)])
