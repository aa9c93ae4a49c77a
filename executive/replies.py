"""Replies to what is not a command: questions about the robot and the home, and statements."""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace

from executive.belief import ANYWHERE
from executive.interfaces.knowledge import Facts, Knowledge
from executive.language.commands import in_words
from executive.language.meaning import (
    About,
    Question,
    Relation,
    Request,
    Said,
    Statement,
    Task,
    Things,
    Where,
)
from executive.language.phrases import spoken
from executive.language.wording import Wording, beginning, either, listed
from executive.types.commands import CommandKind
from executive.types.home import PERSON
from executive.types.knowledge import Candidate, Source

SAYS: Mapping[str, str] = {
    Source.ONTOLOGY: "that is its place",
    Source.LLM: "the language model's guess",
    Source.USER: "as you said",
    Source.MEMORY: "I remember it there",
    Source.HABITS: "people may have taken it there",
    ANYWHERE: "it may be anywhere",
}
"""How each source is named to the person; a `PlaceSource` has its own `says`."""
IDLE = "Nothing: I wait for what you say."
NOTHING_YET = "I did nothing yet."
AT_REST = "At rest: I wait for what you say."
SAYS_OF_SEVERAL: Mapping[str, str] = {
    **SAYS,
    Source.ONTOLOGY: "that is their place",
    Source.MEMORY: "I remember them there",
    Source.HABITS: "people may have taken them there",
    ANYWHERE: "they may be anywhere",
}
_WAYS = ("go", "drive", "look", "move", "search", "there")
"""Words of questions about where the robot went."""
_ROOMS = ("room", "rooms")
_FURNITURE = ("furniture", "places", "pieces of furniture")
_OF_THE_HOME = (CommandKind.COUNT, CommandKind.TELL)
"""Kinds of command that ask about the home itself, if they are about rooms or furniture."""


@dataclass(frozen=True, slots=True)
class Standing:
    """The state of the robot, to answer questions about it.

    Attributes:
        holds: the thing in the hand; None if it is empty.
        doing: what the robot is doing, as a sentence; empty if nothing.
        visits: the places where it went to look, with their sources, the last one at the end.
        been: all places where it was.
        reason: how the last mission ended, in words; empty if there was none.
        stands: the place where it stands; empty if it was stopped on its way.
        asked: the person's last command; empty if there was none.
    """

    holds: str | None = None
    doing: str = ""
    visits: Sequence[Candidate] = ()
    been: Collection[str] = ()
    reason: str = ""
    stands: str = ""
    asked: str = ""


def reply(said: Said, standing: Standing, knowledge: Knowledge, facts: Facts) -> str:
    """The answer to a question, or the thanks for a statement; empty if it is neither.

    A statement is remembered if it is about a known thing and a known place.
    """
    say = Wording(knowledge.called)
    match said:
        case Statement():
            return _told(said, knowledge, facts)
        case Question(about=About.HAND):
            held = standing.holds
            return f"I hold {say.the(held)}." if held else "My hand is empty."
        case Question(about=About.DOING):
            return standing.doing or IDLE
        case Question(about=About.WHERE):
            return standing.doing or f"{_where_i_am(standing.stands, say)} {AT_REST}"
        case Question(about=About.KNOWN, things=Things() as things):
            return _known(things, knowledge)
        case Request(tasks=[Task(verb=verb, things=Things(members=[thing]), source=source)]) if (
            verb in _OF_THE_HOME and thing.words in (*_ROOMS, *_FURNITURE)
        ):
            return _of_the_home(thing.words, source, knowledge)
        case Request(tasks=[Task(verb=CommandKind.FIND, things=Things(members=[thing]))]):
            return _where_it_stands(thing.words, knowledge)
        case Question(about=About.WHERE_PUT, things=Things() as things):
            return _where_is(things, standing, knowledge, facts)
        case Question(about=About.WHERE_FOUND, things=Things() as things):
            return _where_found(things, standing, knowledge, facts)
        case Question(about=About.DONE):
            return standing.doing or standing.reason or NOTHING_YET
        case Question(about=About.ASKED):
            return f"You said: '{standing.asked}'." if standing.asked else "Nothing yet."
        case Question(about=About.REMEMBERED):
            return _remembered(knowledge, facts)
        case Question(about=About.WHY):
            return _why(said.words, standing, knowledge)
    return ""


def about(said: Said, knowledge: Knowledge) -> tuple[str, ...]:
    """The one object that a question or statement is about; empty if that is unclear."""
    match said:
        case Statement(things=things) | Question(things=Things() as things):
            name, _ = _one(things, knowledge)
            return (name,) if name else ()
    return ()


def _where_i_am(place: str, say: Wording) -> str:
    if place == PERSON:
        return "I am with you."
    return f"I am at {say.in_full(place)}." if place else "I stopped on my way."


def _known(things: Things, knowledge: Knowledge) -> str:
    """What is known of things without looking: their names; of a single one, its properties."""
    say, words = Wording(knowledge.called), " or ".join(t.words for t in things.members)
    if words in (*_ROOMS, *_FURNITURE):
        return _of_the_home(words, None, knowledge)
    if any(thing.pronoun for thing in things.members):
        return f"I do not know what '{words}' is."
    names = knowledge.objects_named(words)
    if not names and (stands := _where_it_stands(words, knowledge)):
        return stands
    if len(names) != 1:
        known = listed([say.the(name) for name in names])
        return f"I know {known}." if names else f"I know no '{words}'."
    [name] = names
    usual = either(say.at_each(knowledge.usual_places(name)))
    there = f"{say.is_(name)} usually {usual}" if usual else "may be anywhere"
    looks = listed(
        [part for part in (listed(knowledge.colors(name)), *knowledge.uses(name)) if part]
    )
    is_ = say.agree(name, "It is", "They are")
    told = f"{beginning(say.the(name))} {there}." + f" {is_} {looks}." * bool(looks)
    return f"{told} More I cannot tell you of {say.it(name)}."


def _of_the_home(words: str, where: Where | None, knowledge: Knowledge) -> str:
    """The rooms of the home, or its furniture: that of a room, if one is named."""
    say, places = Wording(knowledge.called), knowledge.places()
    if words in _ROOMS:
        rooms = dict.fromkeys(place.room_label or spoken(place.room) for place in places)
        return f"I know {listed([f'the {room}' for room in rooms])}."
    if where and len(knowledge.places_named(where.words)) > 1:
        return _where_it_stands(where.words, knowledge)
    return f"I know {listed([say.in_full(place.name) for place in places])}."


def _where_it_stands(words: str, knowledge: Knowledge) -> str:
    """The room of a piece of furniture, or the furniture of a room; empty for other things."""
    if knowledge.objects_named(words) or not knowledge.is_place(words):
        return ""
    say, named = Wording(knowledge.called), knowledge.places_named(words)
    rooms = {place.name: place.room for place in knowledge.places()}
    there = [name for name in rooms if rooms[name] in {rooms.get(one) for one in named}]
    if len(there) > 1 and set(there) == set(named):
        return f"In the {words} there is {listed([say.the(name) for name in there])}."
    return f"{beginning(listed([say.stands(name) for name in named if name in rooms]))}."


def _told(said: Statement, knowledge: Knowledge, facts: Facts) -> str:
    """Remember a statement about each of its things; return the reply."""
    each = [replace(said, things=Things((thing,))) for thing in said.things.members]
    if said.things.one_of or len(each) == 1:
        each = [said]
    told = [_told_of_one(one, knowledge, facts) for one in each]
    told += [_told(said.more, knowledge, facts)] if said.more else []
    return " ".join(dict.fromkeys(told))


def _told_of_one(said: Statement, knowledge: Knowledge, facts: Facts) -> str:
    name, unknown = _one(said.things, knowledge)
    [thing, *_] = said.things.members
    each = knowledge.objects_named(thing.words) if said.denied else ()  # "no fruit": none of them
    if not (names := (name,) if name else each):
        return unknown
    where, words = said.where, in_words(said.where)
    if not where.relation.is_plain:
        return f"I can remember what is on furniture, or in it, but not '{words}'."
    places = knowledge.places_named(words) if knowledge.is_place(words) else ()
    if not places:
        return f"I know no place '{words}', so I cannot remember that."
    for name in names:
        (facts.heard_not if said.denied else facts.heard)(name, places)
    if not (facts.places_denied if said.denied else facts.places_of)(names[0]):
        return "Thank you; but I may learn nothing, and shall not remember it."
    say = Wording(knowledge.called)
    there = say.at(places[0]) if len(places) == 1 else _at(where, places, knowledge)
    are = say.are(name) if len(names) == 1 else f"{listed([say.the(one) for one in names])} are"
    return f"Thank you: I remember that {are}{' not' * said.denied} {there}."


def _where_is(things: Things, standing: Standing, knowledge: Knowledge, facts: Facts) -> str:
    say = Wording(knowledge.called)
    name, unknown = _one(things, knowledge)
    if not name:
        return unknown
    if name == standing.holds:
        return f"I hold {say.the(name)}."
    places = facts.places_of(name)
    if not places:
        return f"I do not know where {say.are(name)}."
    return f"As far as I know, {say.are(name)} {say.at(places[0])}."


def _where_found(things: Things, standing: Standing, knowledge: Knowledge, facts: Facts) -> str:
    """Where a thing was taken from; where it is, if it was not taken."""
    say = Wording(knowledge.called)
    name, _ = _one(things, knowledge)
    taken = [place for place in facts.origins().get(name, ()) if knowledge.has_place(place)]
    if taken:
        return f"I took {say.the(name)} from {say.in_full(taken[0])}."
    return _where_is(things, standing, knowledge, facts)


def _remembered(knowledge: Knowledge, facts: Facts) -> str:
    """Where all remembered things are."""
    say = Wording(knowledge.called)
    known = {name: facts.places_of(name) for name in facts.beliefs()}
    there = [f"{say.are(name)} {say.at(places[0])}" for name, places in known.items() if places]
    return f"As far as I know, {listed(there)}." if there else "I have seen nothing yet."


def _why(words: str, standing: Standing, knowledge: Knowledge) -> str:
    named = knowledge.places_named(words)
    visits = [visit for visit in standing.visits if not named or visit.place in named]
    if named or any(word in _WAYS for word in words.split()):
        if not visits and named and not {*named} & {*standing.been}:
            return standing.doing or "I was not there."
        if not visits and not named:
            return standing.doing or "I did not go anywhere."
        if not visits:
            return standing.reason or standing.doing
        visit = visits[-1]
        says = SAYS.get(visit.source, f"so says the {visit.source}")
        return f"I went to {Wording(knowledge.called).the(visit.place)} to look there: {says}."
    return standing.reason or standing.doing or NOTHING_YET


def _one(things: Things, knowledge: Knowledge) -> tuple[str, str]:
    """The one object that is meant; or else empty, and the reply that says why."""
    words = " or ".join(thing.said or thing.words for thing in things.members)
    if any(thing.pronoun for thing in things.members):
        return "", f"I do not know what '{words}' is."
    names = knowledge.objects_named(words)
    if len(names) == 1:
        return names[0], ""
    if not names:
        return "", f"I know no '{words}'."
    return "", f"'{words}' may be {Wording(knowledge.called).any_of(names)}: say which."


def _at(where: Where, named: Collection[str], knowledge: Knowledge) -> str:
    """A place in the person's words: "on the table"; "at" a room becomes "in"."""
    rooms = {place.room for place in knowledge.places() if place.name in named}
    in_it = where.relation == Relation.AT and len(rooms) == 1
    relation = Relation.IN if in_it else where.relation
    return f"{relation.replace('_', ' ')} the {in_words(where)}"
