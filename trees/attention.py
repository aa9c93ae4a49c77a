"""What is said while the robot is at something is answered at once, and the tree goes by it.

A question is answered, and what is told is remembered; a further wish goes on the agenda; a
correction takes the place of the task at hand; what is taken back is not done.
"""

from executive.language.commands import commands_in
from executive.language.corrections import as_correction, corrected
from executive.language.meaning import (
    Answer,
    Correction,
    Courtesy,
    Question,
    Refusal,
    Request,
    Statement,
)
from executive.language.spoken import Spoken, resolved, with_names
from executive.replies import Standing, about, reply
from executive.situation import Situation
from executive.text import too_long
from executive.types import Command, Commands
from trees.context import MissionContext
from trees.telling import in_one_sentence

_IT = frozenset(("it", "that", "this", "them"))


def attend_to(context: MissionContext, words: str, now: str) -> str:
    """Note what follows from words that answer no question, and say what to say to them.

    Args:
        context: whom it is about; its agenda is changed, and its facts.
        words: what the person said.
        now: what the robot is doing, as a sentence.
    """
    if why := too_long(words):
        return f"Sorry: {why}."
    request, agenda = context.situation.request, context.situation.agenda
    at_hand = agenda.whole_of(request.command)
    spoken = spoken_now(context.situation)
    said = context.interpreter.read(words)
    correction = as_correction(said)
    if isinstance(said, Answer):
        said = resolved(said, spoken)  # "it is on the sofa"
    match said:
        case Courtesy():
            return context.interpreter.talk(words)
        case Question() | Statement():
            return _reply(context, said, now) or context.interpreter.talk(words)
        case Refusal() if at_hand and _is_about(context, said, at_hand):
            return _take_back(context, at_hand)
        case Request():
            return _add(context, commands_in(resolved(said, spoken), words), now)
    if correction and at_hand:
        return _correct(context, correction, at_hand, words, now)
    why_not = context.interpreter.remark(words)
    return why_not or f"{context.interpreter.not_understood(words)}. {now}"


def spoken_now(situation: Situation) -> Spoken:
    """What "it" and "there" are: what the task at hand is about."""
    request, before = situation.request, situation.dialogue.spoken
    if not request.command:
        return before
    things = (request.object or request.command.target,)
    place = request.goal or request.command.goal or request.command.source or before.place
    return Spoken(things, request.command.target, place, before.request)


def _reply(context: MissionContext, said: Question | Statement, now: str) -> str:
    """Answer; if the thing that is looked for is elsewhere, look there from now on."""
    situation = context.situation
    meant = resolved(said, spoken_now(situation))
    visited = situation.search.looks.visited
    visits = [one for one in situation.search.candidates if one.place in visited]
    standing = Standing(situation.hand.in_hand, now, visits)
    answer = reply(meant, standing, context.knowledge, context.facts)
    is_it = about(meant, context.knowledge) == (situation.request.object,)
    searches = situation.search.found is None and not situation.has_it
    if isinstance(meant, Statement) and is_it and searches:
        situation.agenda.instead = situation.request.command
    return answer


def _correct(
    context: MissionContext, said: Correction, at_hand: Command, words: str, now: str
) -> str:
    """Do this instead of the task at hand, or beside it."""
    spoken = spoken_now(context.situation)
    commands = corrected(with_names(said, spoken), at_hand, words)
    if said.adds or not isinstance(commands, tuple):
        return _add(context, commands, now)
    first, *others = [command for group in commands for command in group]
    context.situation.agenda.replace(first, others)
    then = " and ".join(in_one_sentence(context, one) for one in (first, *others))
    return f"All right: I {then} instead."


def _add(context: MissionContext, commands: Commands | str | None, now: str) -> str:
    """Do these afterwards."""
    if not isinstance(commands, tuple):
        return commands or f"I do not understand that. {now}"
    context.situation.agenda.add(commands)
    wishes = [in_one_sentence(context, one) for group in commands for one in group]
    return f"All right: I {' and '.join(wishes)} afterwards."


def _take_back(context: MissionContext, at_hand: Command) -> str:
    """Do not do it, nor any part of it."""
    context.situation.agenda.take_back()
    context.situation.request.command = at_hand
    return f"Then I do not {in_one_sentence(context, at_hand)}."


def _is_about(context: MissionContext, said: Refusal, at_hand: Command) -> bool:
    """Whether it is the task at hand that is not to be done."""
    knowledge, request = context.knowledge, context.situation.request
    names = knowledge.names_in(said.words)
    named = {one for name in names for one in knowledge.objects_named(name)}
    if named:
        return request.object in named or bool(named & set(knowledge.objects_named(at_hand.target)))
    return bool(_IT & set(said.words.lower().split()))
