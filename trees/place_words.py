"""Which places the words mean, as far as this is known without a question."""

import re
from collections.abc import Sequence

from executive.language.answers import picked
from executive.language.commands import in_words
from executive.language.meaning import Answer
from executive.types.commands import CommandKind
from executive.types.home import DELIVERY, FLOOR
from trees.context import MissionContext
from trees.recall import is_here
from trees.telling import BETWEEN, NEXT_TO

ON_TOP = "on top of "
"""A goal that begins so is impossible for furniture in which things are put, not on it."""
BESIDE = ("under ", "behind ", "in front of ", "above ", "left of ", "right of ", BETWEEN, NEXT_TO)
"""A goal that begins so is impossible: nothing can be put there."""


def places_in(context: MissionContext, answer: str) -> tuple[str, ...]:
    """The places that the words name, including the delivery table."""
    if DELIVERY in re.findall(r"[a-z]+", answer.lower()):
        return (DELIVERY,)
    return context.knowledge.places_named(answer)


def is_place(context: MissionContext, words: str) -> bool:
    """Whether the words name only places, or what is next to or between them."""
    delivery = DELIVERY in re.findall(r"[a-z]+", words.lower())
    beside = words.lower().removeprefix(NEXT_TO).removeprefix(BETWEEN)
    return delivery or context.knowledge.is_place(beside)


# --- where the thing, or the robot, is to go ---


def goal_words(context: MissionContext) -> str:
    """The words for where to; who only goes has them in the place of a thing, too."""
    command = context.situation.request.asked_for
    alone = command.target if command.kind == CommandKind.GO else ""
    return command.goal or alone


def neighbours(context: MissionContext) -> tuple[str, ...]:
    """The things next to one of which the thing is to be put: "next to the mug"."""
    goal, goes = goal_words(context), context.situation.request.asks_to(CommandKind.GO)
    things = _beside_one_of(goal)
    return tuple(one for t in things for one in context.knowledge.objects_named(t) if not goes)


def _beside_one_of(goal: str) -> list[str]:
    """The things in "next to the mug or next to the pear"; empty if any part is not "next to"."""
    parts = goal.split(" or ")
    beside = [part.removeprefix(NEXT_TO) for part in parts if part.startswith(NEXT_TO)]
    return beside if len(beside) == len(parts) else []


def known_at(context: MissionContext, thing: str) -> tuple[str, ...]:
    """Where the robot remembers a thing, within this home."""
    known = context.facts.places_of(thing)
    return tuple(p for p in known if is_here(context, p))


def not_seen_yet(context: MissionContext) -> str:
    """The words for the neighbour, if that has to be found first; else empty."""
    things, hand = neighbours(context), context.situation.hand
    if hand.in_hand in things or any(known_at(context, thing) for thing in things):
        return ""
    return " or ".join(_beside_one_of(goal_words(context))) if things else ""


def goals_in(context: MissionContext) -> tuple[str, ...]:
    """The places that the goal names; empty if nothing can be put there."""
    goal, goes = goal_words(context), context.situation.request.asks_to(CommandKind.GO)
    beside = goal.startswith(BETWEEN) if goes else cannot_be_put(context, goal)
    return places_in(context, goal) if is_place(context, goal) and not beside else ()


def cannot_be_put(context: MissionContext, goal: str) -> bool:
    """Whether a goal is a side of furniture where nothing can be put."""
    if goal.startswith(ON_TOP):
        return any(context.say.at(place).startswith("in ") for place in places_in(context, goal))
    return goal.startswith(BESIDE)


def not_to_be_put(context: MissionContext, answer: str) -> str:
    """The goal in an answer if nothing can be put there; else empty."""
    match context.interpreter.read(answer):
        case Answer(where=[place]) if cannot_be_put(context, goal := in_words(place)):
            return goal
    return ""


def options_in(context: MissionContext) -> tuple[str, ...]:
    """The places that the goal may mean if it leaves open which; a goal with "or" does not."""
    return goals_in(context) if may_be_several(context, goal_words(context)) else ()


def may_be_several(context: MissionContext, words: str) -> bool:
    """Whether words for one place leave open which; "the desk or the sofa" does not."""
    parts = re.split(r"\bor\b", words)
    return not all(is_one(context, places_in(context, part)) for part in parts)


def may_be(context: MissionContext, words: str, options: Sequence[str]) -> str:
    """That it is unknown which of these places is meant, as a clause."""
    return f"'{context.as_said(words)}' may be {context.say.any_of(options)}"


def chosen_of(context: MissionContext, answer: str, options: Sequence[str]) -> tuple[str, ...]:
    """The offered places that an answer means."""
    if chosen := picked(context.interpreter.read(answer), options):
        return chosen
    if not (named := places_in(context, answer)):
        kind = goal_words(context)
        named = places_in(context, f"{answer.removesuffix(' one')} {kind}")  # "the coffee" table
    return tuple(place for place in named if place in options)


def unknown_place(context: MissionContext, words: str) -> str:
    """That a place is unknown, as a clause."""
    return f"I know no place '{context.as_said(words)}'"


def only_on_furniture(goal: str) -> str:
    """That nothing can be put there, as a clause; `goal` as the person said it."""
    return f"I can put things on furniture, or in it, but not '{goal}'"


def unknown_goal(context: MissionContext) -> str:
    """Why the goal is unknown, as a clause."""
    request, goal = context.situation.request, goal_words(context)
    goes = request.asks_to(CommandKind.GO)
    if things := neighbours(context):
        return f"I do not know where {context.say.are(things[0])}"
    if goes and goal.startswith(BETWEEN):
        return f"I can go to furniture, but not '{context.as_said(goal)}'"
    if cannot_be_put(context, goal) and not goes:
        return only_on_furniture(context.as_said(goal))
    if FLOOR in goal.split():
        return "I put nothing on the floor"
    if goal:
        return f"I do not know where '{context.as_said(goal)}' is"
    put = f"put {context.say.the(request.thing)}"
    return "I do not know where to " + ("go" if goes else put)


def is_one(context: MissionContext, named: Sequence[str]) -> bool:
    """Whether these are one place (or none), or all the furniture of one room."""
    if len(named) < 2:
        return True
    furniture = {place.name: place.room for place in context.knowledge.places()}
    rooms = {furniture.get(name) for name in named}
    return len(rooms) == 1 and set(named) == {n for n, room in furniture.items() if room in rooms}


def best_first(context: MissionContext, named: Sequence[str]) -> tuple[str, ...]:
    """The places, the ones where things are put down most easily first."""
    order = {place: number for number, place in enumerate(context.handiest)}
    return tuple(sorted(named, key=lambda place: order.get(place, len(order))))
