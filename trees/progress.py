"""What the robot says while it acts: where it drives, with what, and why it goes on."""

from executive.language.wording import beginning
from executive.types.commands import CommandKind
from executive.types.home import DELIVERY, PERSON
from trees.context import MissionContext


def on_to_the_next(context: MissionContext) -> str:
    """That the thing was not at the last place, or why this is unknown; empty at the first."""
    search, say = context.situation.search, context.say
    places = [candidate.place for candidate in search.candidates]
    at = places.index(search.place) if search.place in places else 0
    if at == 0:
        return ""
    there, before = say.the(places[at]), places[at - 1]
    looked_at = before in search.looks.visited or before in search.looks.unreached
    if before in context.situation.survey.found.values() or not looked_at:
        return f"On to {there}."
    if search.looks.all_without(before) and before not in search.looks.unreached:
        return f"Not here; on to {there}."
    name = context.situation.request.thing
    why = search.looks.why_not(name, before, say)
    return f"{beginning(why)}; on to {there}."


def on_the_way(context: MissionContext, place: str) -> str:
    """Where the robot drives, and what it carries."""
    situation, say = context.situation, context.say
    held = situation.hand.in_hand
    if held and place == DELIVERY:
        return f"I have {say.the(held)}, and bring {say.it(held)}."
    if held and place != PERSON:
        return f"I take {say.the(held)} to {say.the(place)}."
    if place != PERSON:
        return f"I drive to {say.the(place)}."
    if situation.dialogue.away and situation.dialogue.heads_for == PERSON:
        return "I try to come back once more."
    if situation.request.asks_to(CommandKind.FIND) and situation.search.found:
        return f"I have seen {say.it(situation.request.thing)}, and come back."
    return "I come back." if situation.dialogue.away else "I come to you."
