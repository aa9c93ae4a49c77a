"""What is to be done, as the rules of a grammar have it."""

from collections.abc import Iterator
from dataclasses import replace

from lark import Token

from executive.language.folding import is_it
from executive.language.meaning import ME, SO, THERE, Relation, Request, Task, Thing, Things, Where
from executive.language.nouns import Nouns
from executive.language.parts import (
    Absent,
    From,
    Further,
    Left,
    Otherwise,
    Part,
    To,
    Unfit,
    either_of,
    exceptions_of,
    is_a,
    purpose_of,
)
from executive.types.commands import ALL, CommandKind

_ELSEWHERE = (
    CommandKind.GO,
    CommandKind.TELL,
    CommandKind.COUNT,
    CommandKind.CHECK,
    CommandKind.CLEAR,
)
"""Deeds that can be done at one place after the other."""
_LOOKING = (CommandKind.FIND, CommandKind.COUNT, CommandKind.CHECK, CommandKind.TELL)
"""Deeds that leave everything where it is."""
ALL_THINGS = Thing("things", definite=True, said="things")
"""What one who is to look around looks for."""
MOST_INNER = 4
"""Places that say where another place is; nobody says more in one breath."""


class Deeds(Nouns):
    """Makes tasks of the rules about them."""

    def task(self, parts: list[Part]) -> Task:
        """As in "find the mug on the desk": the verb has the name of its terminal."""
        return _task(CommandKind(parts[0].type.lower()), parts)

    def find(self, parts: list[Part]) -> Task:
        """As in "tell me where the mug is"."""
        return _task(CommandKind.FIND, parts)

    def take(self, parts: list[Part]) -> Task:
        """As in "take the mug"; with a goal it is brought there."""
        task = _task(CommandKind.TAKE, parts)
        return replace(task, verb=CommandKind.PUT) if task.goal else task

    def bring(self, parts: list[Part]) -> Task:
        """As in "bring me the mug", "give the mug to Anna"."""
        task = _task(CommandKind.BRING, parts)
        return replace(task, verb=CommandKind.BRING if task.goal in (None, ME) else CommandKind.PUT)

    def bring_to(self, parts: list[Part]) -> Task:
        """As in "bring Anna the mug"."""
        verb, person, *rest = parts
        return _task(CommandKind.PUT, [verb, To(person), *rest])

    def wish_for(self, parts: list[Part]) -> Task:
        """As in "I want to drink something": whatever serves for that."""
        thing = Thing(number=1, purpose=purpose_of(parts, "PURPOSE"), said=str(parts[-1]))
        return Task(CommandKind.BRING, Things((thing,)), said=parts[0])

    def search_for(self, parts: list[Part]) -> Task:
        """As in "search the kitchen for the mug"."""
        place, things = (p for p in parts if isinstance(p, Things))
        return Task(CommandKind.FIND, things, source=Where(place.members[0].words), said=parts[0])

    def leave(self, parts: list[Part]) -> Task | Left:
        """As in "leave the hammer alone", "leave the hammer on the desk"; "leave it there" puts."""
        _, things, *there = parts
        is_to_go = there and not is_a(there[0], "ALONE")
        if is_to_go and all(thing.pronoun for thing in things.members):
            return _task(CommandKind.PUT, parts, goes=True)
        return Left(self.left_alone([*things.members]))

    def wish(self, parts: list[Part]) -> Task:
        """As in "I need the mug"; where it is to be, or is, "I want it on the desk" leaves open."""
        there = next((p.words for p in parts if isinstance(p, Where)), None)
        if there is not None and parts[0].startswith(self._wishes):
            raise Unfit(there)
        return _task(CommandKind.BRING, parts)

    def further(self, parts: list[Part]) -> Further:
        """As in "... and the pear on the desk", "..., then to the sofa"."""
        said = tuple(p for p in parts if not isinstance(p, Token))
        return Further(said, by_and=is_a(parts[0], "AND"))

    def once_more(self, task: Task, further: Further, *, alone: bool) -> tuple[Task, ...]:
        """The same deed with other things, or at other places.

        Other things `alone` are no more of those in the task: "the mug first, then the pear".

        Raises:
            Unfit: if the words do not say what is meant of the task before.
        """
        things = next((p for p in further.parts if isinstance(p, Things)), None)
        places = [p for p in further.parts if not isinstance(p, Things)]
        if alone and task.things and things and not places:
            return (replace(task, things=things),)
        if further.by_and and task.goal and task.things and things and not places:
            return (replace(task, things=things, source=None),)  # "... and the pear, too"
        if task.conditional or (not (things and places) and task.verb not in _ELSEWHERE):
            raise Unfit(task.said)
        if things and places and task.things is None:  # "go to the desk and dance there"
            raise Unfit(things.members[0].said)
        if things and not places:
            return tuple(_again(task, task.things, [p]) for p in _same_way(task, things))
        return (_again(task, things or task.things, places),)

    def put(self, parts: list[Part]) -> Task:
        """As in "put the mug on the desk"; where to may be left for the robot to ask."""
        task = _task(CommandKind.PUT, parts, goes=True)
        return replace(task, verb=CommandKind.BRING) if task.goal == ME else task

    def put_down(self, parts: list[Part]) -> Task:
        """As in "put it down", "put the mug down on the desk"."""
        task = _task(CommandKind.PUT_DOWN, parts, goes=True)
        return replace(task, verb=CommandKind.PUT) if task.goal else task

    def put_it(self, parts: list[Part]) -> Task:
        """As in "place on the desk", in few words: what was spoken of."""
        it = Things((Thing("it", pronoun=True, definite=True, said="it"),))
        return self.put([parts[0], it, *parts[1:]])

    def carried(self, parts: list[Part]) -> Task:
        """As in "mug to the desk", in few words."""
        thing, _, place = parts
        return Task(CommandKind.PUT, Things((thing,)), goal=place, said="put")

    def put_back(self, parts: list[Part]) -> Task:
        """As in "put it back", "take the mug back to the kitchen"."""
        task = _task(CommandKind.PUT_BACK, parts, goes=True)
        return replace(task, verb=CommandKind.PUT) if task.goal else task

    def go(self, parts: list[Part]) -> Task:
        """As in "go to the kitchen"; "go back" is to the person."""
        task = _task(CommandKind.GO, parts, goes=True)
        back = any(is_a(p, "BACK") for p in parts)
        return replace(task, goal=ME) if back and not task.goal else task

    def come(self, parts: list[Part]) -> Task:
        """As in "come here"."""
        return Task(CommandKind.GO, goal=ME, said=parts[0])

    def clear(self, parts: list[Part]) -> Task:
        """As in "clear the table", "clear the mugs from the table"."""
        task = _task(CommandKind.CLEAR, parts)
        if task.source is None and task.things and any(t.words for t in task.things.members):
            if task.things.one_of:
                raise Unfit(task.things.members[-1].words)
            places = either_of([Where(thing.words) for thing in task.things.members])
            cleared = replace(task, things=None, source=places)
            return cleared.without(task.things.exceptions)
        return task

    def excepting(self, parts: list[Part]) -> Task:
        """As in "bring all the fruit from the table, except the pear"."""
        task = _deed(next(p for p in parts if isinstance(p, Task | Left)))
        left_out = tuple(p for p in parts if isinstance(p, Thing)) or exceptions_of(parts)
        return task.without(left_out)

    def count(self, parts: list[Part]) -> Task:
        """As in "how many fruits are on the table"."""
        return _task(CommandKind.COUNT, parts)

    def tell(self, parts: list[Part]) -> Task:
        """As in "what is on the table"."""
        return _task(CommandKind.TELL, parts)

    def look_around(self, parts: list[Part]) -> Task:
        """As in "look around", "have a look around in the kitchen": where there is what."""
        task = _task(CommandKind.TELL, parts)
        return task if task.source else replace(task, things=Things((ALL_THINGS,)))

    def tell_most(self, parts: list[Part]) -> Task:
        """As in "which fruit is the smallest on the desk"."""
        *_, word = (p for p in parts if type(p) is str)
        task = _task(CommandKind.TELL, parts)
        assert task.things
        if not (most := self.most(word)) or len(task.things.members) > 1:
            raise Unfit(word)
        [thing] = task.things.members
        return replace(task, things=Things((replace(thing, superlative=most),)))

    def check(self, parts: list[Part]) -> Task:
        """As in "is the mug on the sofa", "is there any milk"."""
        return _task(CommandKind.CHECK, parts)

    def if_there(self, parts: list[Part]) -> Task:
        """As in "if there is one", "if the apple is on the table"."""
        return _task(CommandKind.CHECK, parts)

    def if_absent(self, parts: list[Part]) -> Absent:
        """As in "if the mug is not on the desk", "unless there is one"."""
        return Absent(_task(CommandKind.CHECK, parts))

    def unless(self, parts: list[Part]) -> Task:
        """As in "if there is no apple, bring a pear", "bring the mug unless it is on the desk"."""
        sought = next(p.task for p in parts if isinstance(p, Absent))
        deed = _deed(next(p for p in parts if isinstance(p, Task | Left)))
        says_first = isinstance(parts[0], Absent)  # "if it is not there, ...": what was spoken of
        if sought.things is None or (is_it(sought.things) and not says_first):
            sought = replace(sought, things=deed.things)
        if not says_first:
            sought = _with_place_of(deed, sought)
        if (instead := _instead(deed, parts)) is None:
            return replace(sought, conditional=True, unless=deed)
        return replace(instead, conditional=True, sought=sought, unless=deed)

    def otherwise(self, parts: list[Part]) -> Otherwise:
        """As in "otherwise a pear", "otherwise come back"."""
        instead = parts[-1]
        return Otherwise(instead if isinstance(instead, Things) else _deed(instead))

    def conditional(self, parts: list[Part]) -> Task:
        """As in "bring an apple if there is one, otherwise a pear"."""
        part, *rest = parts
        deed = _deed(part)
        sought = next((p for p in rest if isinstance(p, Task)), None)
        if sought is not None and sought.things is None and sought.source is None:
            sought = None
        elif sought is not None and is_it(sought.things) and deed.things:
            sought = replace(sought, things=deed.things)
        if sought is not None:
            sought = _with_place_of(deed, sought)
        return replace(deed, conditional=True, sought=sought, unless=_instead(deed, rest))

    def if_so(self, parts: list[Part]) -> Request:
        """As in "if so, bring it", after a question."""
        _, part, *rest = parts
        deed = _deed(part)
        task = replace(deed, conditional=True, sought=SO, unless=_instead(deed, rest))
        return Request((task,))

    def if_not(self, parts: list[Part]) -> Request:
        """As in "if not, bring the pear", after a question."""
        deed = _deed(parts[-1])
        return Request((replace(SO, conditional=True, sought=SO, unless=deed),))

    def if_then(self, parts: list[Part]) -> Task:
        """As in "if there is an apple, bring it", "is there an apple? If so, bring it"."""
        sought, part, *rest = (p for p in parts if not isinstance(p, Token))
        deed = _deed(part)
        sought = _deed(sought)
        if sought.verb != CommandKind.CHECK:
            raise Unfit(sought.said)
        return replace(deed, conditional=True, sought=sought, unless=_instead(deed, rest))


def first_of_all(things: Things) -> Things:
    """As in "the mug and the pear, but the pear first": it is no exception, but an order.

    Raises:
        Unfit: if what is to be first is none of the things.
    """
    members = tuple(replace(thing, exceptions=()) for thing in things.members)
    first = {thing.words for thing in things.exceptions}
    named = tuple(one for one in members if one.words in first)
    if len(named) != len(first):
        raise Unfit(things.exceptions[0].said)
    others = tuple(one for one in members if one not in named)
    return replace(things, members=(*named, *others), in_order=True)


def _again(task: Task, things: Things | None, places: list[Part]) -> Task:
    """The deed of a task with these things, at these places."""
    brings = task.verb == CommandKind.BRING
    parts = [Token("DEED", task.said), things, *places]
    again = _task(task.verb, parts, goes=task.goal is not None and not brings)
    if brings and again.goal not in (None, ME):
        return replace(again, verb=CommandKind.PUT)
    if bool(again.goal) != bool(task.goal) and not brings:
        raise Unfit(task.said)
    return again


def _with_place_of(deed: Task, sought: Task) -> Task:
    """Where "there" is in a condition: "put it on the desk unless the pear is there"."""
    place = deed.source if deed.goal in (None, ME) else deed.goal
    is_there = sought.source is not None and sought.source.words in THERE
    return replace(sought, source=place) if is_there and place else sought


def _same_way(task: Task, things: Things) -> Iterator[Where]:
    """Places that were said like things: "go to the desk and the sofa"."""
    before = task.goal or task.source
    if before is None or things.one_of or things.exceptions:
        raise Unfit(task.said)
    for thing in things.members:
        if thing.pronoun or thing.number:
            raise Unfit(thing.said)
        yield Where(thing.words, before.relation)


def _deed(part: Part) -> Task:
    """A task; what is not to be done ("leave it alone") depends on nothing, and nothing on it."""
    if not isinstance(part, Task):
        raise Unfit(part.things[-1].said)
    return part


def _instead(deed: Task, rest: list[Part]) -> Task | None:
    """What to do if the condition does not hold: with things only, the same deed with them."""
    instead = next((p.deed for p in rest if isinstance(p, Otherwise)), None)
    if isinstance(instead, Things):
        return replace(deed, things=instead)
    return instead


def _task(verb: CommandKind, parts: list[Part], *, goes: bool = False) -> Task:
    """A task of a verb, its things and its places.

    Args:
        verb: what to do.
        parts: of the rule.
        goes: whether a place without "from" and "to" is where the thing is to go, and not where
            it is.

    Raises:
        Unfit: if there are more places than the task has use for.
    """
    things = next((p for p in parts if isinstance(p, Things)), None)
    places: dict[str, Where] = {}
    last, inner = "", 0
    for part in parts:
        if isinstance(part, From) and not (part.told and last):
            role, place = "source", part.place
        elif isinstance(part, To):
            role, place = "goal", part.place
            if goes and last == "goal":  # "what is on the desk into the fridge"
                places["source"] = places.pop("goal")
        elif isinstance(part, Where | From):
            role = "goal" if goes and (places or not _says_where(things)) else "source"
            place = part if isinstance(part, Where) else part.place
            if goes and [*places] == ["goal"] and _is_on_another(place, things):
                places["source"] = places.pop("goal")
            elif last and (role in places or last == "goal"):
                places[last] = replace(places[last], within=_inner(places[last].within, place))
                inner += 1
                if inner > MOST_INNER:
                    raise Unfit(place.words)
                continue
        else:
            continue
        if role in places:
            raise Unfit(place.words)
        places[role], last = place, role
    if verb in _LOOKING and places.get("goal", ME) != ME:  # "find the mug to the kitchen"
        raise Unfit(places["goal"].words)
    said = next((str(p) for p in parts if isinstance(p, Token)), "")
    return Task(verb, things, places.get("source"), places.get("goal"), said=said)


def _says_where(things: Things | None) -> bool:
    """Whether it ends so that where they are has to follow: "everything that is"."""
    return things is not None and things.members[-1].said.endswith(" is")


def _is_on_another(place: Where, things: Things | None) -> bool:
    """Whether the place before it is where things are: "put all on the desk on the sofa"."""
    return place.relation == Relation.ON and things is not None and things.members[0].number == ALL


def _inner(within: Where | None, place: Where) -> Where:
    return place if within is None else replace(within, within=_inner(within.within, place))
