"""The words of a command that the grammar ignored."""

import re
from collections.abc import Sequence

from executive.colors import COLORS, OTHER_SPELLINGS
from executive.language.phrases import words_of
from executive.language.placed import placed
from executive.types.commands import Command, CommandKind
from trees.context import MissionContext
from trees.place_words import places_in


def passed_over(context: MissionContext, commands: Sequence[Command]) -> list[str]:
    """The ignored words, as they were said: things, places, colours, numbers and conditions."""
    knowledge, words = context.knowledge, context.situation.request.words
    conditions = [part for one in commands for part in (one.sought, one.unless) if part]
    commands = [*commands, *conditions]
    read = " and ".join(name for one in commands for name in (one.target, *one.exceptions))
    things = [name for name in knowledge.names_in(words) if name not in knowledge.names_in(read)]
    spoken_of = {place for one in commands for place in _places_of(context, one)}
    places = [
        place
        for place in placed(words, knowledge.is_place)
        if place and not {*places_in(context, place)} <= spoken_of
    ]
    said = set(re.findall(r"[a-z]+", words.lower()))
    colors = [
        color
        for color in (*COLORS, *OTHER_SPELLINGS)
        if color in said
        and not any(knowledge.objects_named(f"{color} {c.target}") for c in commands)
    ]
    others = context.interpreter.passed_over(words, commands)
    things_said = (context.as_said(context.say.words(name)) for name in things)
    return [*dict.fromkeys((*things_said, *places, *colors, *others))]


def _places_of(context: MissionContext, command: Command) -> set[str]:
    """The furniture that a command names."""
    return {
        *places_in(context, command.source),
        *places_in(context, command.goal),
        *(places_in(context, command.target) if command.kind == CommandKind.GO else ()),
    }


def passed_over_in_name(context: MissionContext, said: str, name: str) -> str:
    """The known words beside the name of a thing, which would say more: "mug desk" -> "desk".

    They name a thing, a place, a number or a condition; empty if none do.
    """
    knowledge, named = context.knowledge, words_of(context.say.words(name))
    rest = [word for word in said.split() if not set(words_of(word)) <= set(named)]
    words = " ".join(rest)
    if not rest or len(rest) == len(said.split()):
        return ""
    says_more = (
        knowledge.is_place(words)
        or knowledge.names_in(words)
        or context.interpreter.passed_over(words, ())
    )
    return words if says_more else ""
