"""What is to be done when somebody corrects what they asked for: "no, the banana"."""

from dataclasses import replace

from executive.language.anew import in_place_of
from executive.language.commands import commands_in, in_words
from executive.language.meaning import (
    ME,
    Answer,
    Correction,
    Request,
    Said,
    Task,
    Thing,
    Things,
    Where,
)
from executive.types.commands import Command, CommandKind, Commands

_CARRIED = (CommandKind.BRING, CommandKind.TAKE, CommandKind.PUT)
"""What of these is done, depends on where the thing is to go."""


def corrected(said: Correction, at_hand: Command, words: str) -> Commands | str:
    """The tasks in place of the one at hand, or beside it; or why one of them cannot be done."""
    if said.goal and at_hand.kind in _CARRIED:
        brings = said.goal == ME
        at_hand = replace(at_hand, kind=CommandKind.BRING if brings else CommandKind.PUT, goal="")
        said = replace(said, goal=None) if brings else said
    if said.goal and not at_hand.kind.means.at_goal:
        return f"I do not understand '{words}'."
    match said.meant:
        case Request() as request:
            read = commands_in(request, words)
        case Things(members=[place]) if at_hand.kind == CommandKind.GO:
            return corrected(Correction(goal=Where(place.words)), at_hand, words)
        case Things() as things:
            task = in_place_of(_said_before(at_hand), things)
            read = commands_in(Request((task,)), words)
        case _:
            return ((_elsewhere(said, at_hand, words),),)
    if not isinstance(read, tuple):
        return read or f"I do not understand '{words}'."
    if isinstance(said.meant, Request):
        return read
    placed = _elsewhere(said, at_hand, words)
    return tuple(
        tuple(replace(one, source=placed.source, goal=placed.goal) for one in group)
        for group in read
    )


def _said_before(at_hand: Command) -> Task:
    """What was asked for, as far as other things may take the place of its own."""
    things = Things((Thing(at_hand.target),)) if at_hand.target else None
    return Task(at_hand.kind, things, said=at_hand.kind)


def as_correction(said: Said) -> Correction | None:
    """An answer that says what is not meant, too: "the banana, not the apple"."""
    match said:
        case Answer(things=Things(members=[Thing(words=str(words), exceptions=[_, *_]) as thing])):
            if words and thing.definite:
                meant = Things((replace(thing, exceptions=()),))
                return Correction(meant, Things(thing.exceptions))
    return said if isinstance(said, Correction) else None


def _elsewhere(said: Correction, at_hand: Command, words: str) -> Command:
    """The same in another place; one without "from" and "to" is where the verb has use for one."""
    source, goal = said.source, said.goal
    if at_hand.sought and at_hand.sought.kind == CommandKind.FIND:  # beside what was to be found
        at_hand = replace(at_hand, conditional=False, sought=None)
    if said.place and at_hand.kind.means.at_goal:
        goal = said.place
    elif said.place:
        source = said.place
    return replace(
        at_hand,
        words=words,
        source=in_words(source) if source else at_hand.source,
        goal=in_words(goal) if goal else at_hand.goal,
    )
