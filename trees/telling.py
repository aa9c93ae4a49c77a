"""What the robot says to the person: each utterance on one line; commands in words."""

from collections.abc import Iterable
from dataclasses import replace

from executive.language.commands import THING
from executive.language.phrases import is_plural
from executive.language.wording import as_said, either
from executive.records import Utterance
from executive.text import printable
from executive.types.commands import ALL, HELD, Command, CommandKind
from executive.types.home import PERSON
from trees.context import MissionContext

TO_THE_PERSON = frozenset(("me", "us", "here", PERSON))
"""Words for a goal that is the speaker."""
NEXT_TO = "next to "
"""A goal that begins so names a thing."""
BETWEEN = "between "
"""A goal that begins so names two pieces of furniture."""
NUMBERS = ("none", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten")


def tell(context: MissionContext, text: str) -> None:
    """Say something, on one line, to the person and to the log."""
    said = printable(text)
    context.recorder.record(Utterance("robot", said))
    context.user.tell(said)


def sentence(text: str) -> str:
    """The text with a full stop, unless it ends with a mark already."""
    return text if text.endswith((".", "!", "?", "…")) else f"{text}."


def in_one_sentence(context: MissionContext, command: Command) -> str:
    """All that a command asks for, in words: "bring the mug from the desk"."""
    instead = in_one_sentence(context, command.unless) if command.unless else ""
    return f"{_deed(context, command)}{_condition(context, command)}" + (
        f", or else {instead}" * bool(instead)
    )


def in_one_breath(context: MissionContext, commands: Iterable[Command]) -> str:
    """All that several commands ask for: "bring the mug and take the pear"."""
    return " and ".join(in_one_sentence(context, command) for command in commands)


def _condition(context: MissionContext, command: Command) -> str:
    """The condition, as in " if the mug is on the desk"; empty if it has none, or is a check."""
    if not command.conditional or command.kind == CommandKind.CHECK:
        return ""
    if command.sought is None:
        return " if I find it"
    sought = _deed(context, replace(command.sought, kind=CommandKind.CHECK))
    return f" if {sought.removeprefix('check whether ')}".replace("if look for", "if I find")


def _deed(context: MissionContext, command: Command) -> str:
    """The command without its condition."""
    what, goal = _things(context, command), to_where(context, command)
    there = _where(context, command, command.source) if command.source else ""
    source = f"from {_place(context, command, command.source)}" if command.source else ""
    match command.kind:
        case CommandKind.PUT_DOWN:
            parts: tuple[str, ...] = ("put", what, "down")
        case CommandKind.PUT_BACK:
            parts = ("put", what, "back", source, goal)
        case CommandKind.GO if command.goal in TO_THE_PERSON:
            parts = ("come to you",)
        case CommandKind.GO:
            parts = ("go to", _place(context, command, command.goal or command.target))
        case CommandKind.CHECK if there:
            are = "are" if is_plural(command.target) else "is"
            parts = ("check whether", what, are, there)
        case CommandKind.CHECK:
            parts = ("look for", what)
        case CommandKind.TELL if there and not command.target:
            parts = ("tell what is", there)
        case CommandKind.FIND | CommandKind.COUNT | CommandKind.TELL:
            parts = (command.kind, what, there)
        case CommandKind.CLEAR if command.source and not command.target:
            parts = ("clear", _place(context, command, command.source))
        case _:
            parts = (command.kind.replace("_", " "), what, source, goal)
    return " ".join(filter(None, parts))


def _things(context: MissionContext, command: Command) -> str:
    """What a command is about, as in "three fruits but not the pear"."""
    if _is_another(context, command):
        return f"another {as_said(command.words, command.target)}"
    left_out = either([_one_thing(context, but) for but in command.exceptions])
    return _target(context, command) + f" but not {left_out}" * bool(left_out)


def _is_another(context: MissionContext, command: Command) -> bool:
    """Whether all that the target can mean is left out: "another mug, not this one"."""
    find = context.knowledge.objects_named
    left_out = {name for but in command.exceptions for name in find(but)}
    named = set() if command.target in (HELD, THING) else {*find(command.target)}
    return bool(named) and named <= left_out


def _target(context: MissionContext, command: Command) -> str:
    """What a command is about, whatever it leaves out."""
    knowledge, target = context.knowledge, command.target
    if target == HELD:
        return target
    if target == THING:
        return _anything(command)
    if command.number > 1 and not command.among:
        return f"{number(command.number)} {as_said(command.words, target)}"
    names = [name for name in target.split(" and ") if knowledge.called(name)]
    if names and " and ".join(names) == target:
        return " and ".join(map(context.say.the, names))
    named = knowledge.objects_named(target)
    if len(named) == 1:
        return context.say.the(named[0])
    if knowledge.is_place(target):
        return _place(context, command, target)
    return as_said(command.words, target)


def _anything(command: Command) -> str:
    """The word for things of any kind."""
    if command.kind == CommandKind.CHECK:
        return "anything"
    return "something" if command.kind.means.searches and command.number != ALL else "everything"


def number(count: int) -> str:
    """A number; a small one in letters."""
    return NUMBERS[count] if count < len(NUMBERS) else str(count)


def _one_thing(context: MissionContext, words: str) -> str:
    named = context.knowledge.objects_named(words)
    return context.say.the(named[0]) if len(named) == 1 else words


def _place(context: MissionContext, command: Command, words: str) -> str:
    """A place in the command: furniture by its name, anything else as it was said."""
    named = context.knowledge.places_named(words)
    if len(named) == 1:
        return context.say.the(named[0])
    said = as_said(command.words, words)
    return f"the {said}" if named and said.islower() else said


def to_where(context: MissionContext, command: Command) -> str:
    """The goal of a command, with a preposition; empty if it has none."""
    if not command.goal or command.goal in TO_THE_PERSON:
        return "to you" if command.goal else ""
    return _where(context, command, command.goal, "to")


def _where(context: MissionContext, command: Command, words: str, unknown: str = "at") -> str:
    """A place in the command, with a preposition: `unknown` for words that name no place."""
    named = context.knowledge.places_named(words)
    if len(named) == 1 or words == " or ".join(named):
        return either(context.say.at_each(named))
    if words.startswith(NEXT_TO):
        things = context.knowledge.objects_named(words.removeprefix(NEXT_TO))
        return f"{NEXT_TO}{context.say.the(things[0])}" if len(things) == 1 else words
    return f"{'in' if named else unknown} {_place(context, command, words)}"
