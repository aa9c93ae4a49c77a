"""Which of the things that were offered does an answer mean?"""

from collections.abc import Sequence

from executive.language.meaning import (
    Answer,
    Choice,
    Correction,
    Request,
    Said,
    Task,
    Thing,
    Things,
)
from executive.language.phrases import spoken


def picked(said: Said, options: Sequence[str]) -> tuple[str, ...]:
    """Those of the options that are meant without their names: "the second one", "any", "both".

    None are if it names something, or picks what is not there.
    """
    if not isinstance(said, Answer):
        return ()
    if said.place_in_list is not None:
        number = said.place_in_list or len(options) + 1
        number -= number > 0
        return (options[number],) if -len(options) <= number < len(options) else ()
    match said.choice:
        case Choice.ANY:
            return tuple(options[:1])
        case Choice.ALL:
            return tuple(options)
        case Choice.BOTH if len(options) == 2:
            return tuple(options)
        case Choice.YES if said.things is None and len(options) == 1:
            return tuple(options)
    if said.things and _is_any(said.things):
        left_out = {but.words for but in said.things.exceptions}  # "anything but the apple"
        return tuple(option for option in options if spoken(option) not in left_out)[:1]
    return ()


def how_many_of(said: Answer) -> int:
    """How many of those that were offered, if any will do: "two of them"; 0 if it says no such."""
    match said.things:
        case Things(members=[Thing(pronoun=True, number=int(number), definite=False)]):
            return number if number > 1 else 0
    return 0


def named(said: Said) -> str:
    """The words for the things that an answer names: "no, the pear" -> "pear"; empty if none."""
    things = things_in(said.meant if isinstance(said, Correction) else said)
    members = things.members if things else ()
    return " or ".join(_words(thing) for thing in members if not thing.pronoun)


def things_in(said: Said | Things | None) -> Things | None:
    """The things that an answer, or one task, is about; None if there are none, or several."""
    match said:
        case Answer(things=things) | Request(tasks=[Task(things=things)]):
            return things
        case Things():
            return said
    return None


def _words(thing: Thing) -> str:
    return thing.words or thing.said


def _is_any(things: Things) -> bool:
    """Whether it is "one of them", "anything but ..."."""
    return [(t.pronoun or not t.words, t.number) for t in things.members] == [(True, 1)]
