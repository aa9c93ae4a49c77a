"""From the rules of a grammar to `meaning.py`: one method a rule, the same for every language."""

from dataclasses import dataclass, replace
from typing import Any

from lark import Token, Transformer

from executive.language.meaning import (
    ALL,
    ME,
    About,
    Again,
    Answer,
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
    Verb,
    Where,
)

Part = Any
"""What a rule has made of its words: a value of `meaning.py`, or a token."""

MOST_INNER = 4
"""Places that say where another place is; nobody says more in one breath."""


class Builder(Transformer[Token, Said]):
    """Makes the parts of `meaning.py`, from the words of a thing up to the whole.

    Args:
        numbers: what words for numbers and ordinals stand for.
        relations: which relation a preposition says.
        superlatives: which measure a word like "biggest" is about.
    """

    def __init__(
        self,
        numbers: dict[str, int],
        relations: dict[str, Relation],
        superlatives: dict[str, str],
    ) -> None:
        """Take the words that have a value."""
        super().__init__()
        self._numbers = numbers
        self._relations = relations
        self._superlatives = superlatives

    # --- things ---

    def words(self, parts: list[Part]) -> str:
        """The words of a name."""
        return " ".join(parts)

    def determiner(self, parts: list[Part]) -> Token:
        """An article, or a number."""
        (token,) = parts
        assert isinstance(token, Token)
        return token

    def noun(self, parts: list[Part]) -> Thing:
        """As in "box of sugar", "tool for nails"."""
        name = " ".join(p for p in parts if type(p) is str or _is(p, "OF", "POSE"))
        first, _, rest = name.partition(" ")
        most = self._superlatives.get(first, "")
        words = rest if most else name
        return Thing(words, purpose=_purpose(parts, "USE"), superlative=most, said=_said(parts))

    def thing(self, parts: list[Part]) -> Thing:
        """As in "the two mugs but not the red one"."""
        noun = next(p for p in parts if isinstance(p, Thing))
        numbers = [self._number(p) for p in parts if _is(p, "NUMBER")]
        definite = any(_is(p, "THE") for p in parts)
        number = numbers[0] if numbers else 1 if any(_is(p, "A") for p in parts) else None
        return replace(
            noun,
            number=number,
            definite=definite,
            exceptions=_exceptions(parts),
            said=_said(parts),
        )

    def something(self, parts: list[Part]) -> Thing:
        """As in "something yellow to drink from"."""
        words = " ".join(p for p in parts if type(p) is str)
        purpose = _purpose(parts, "PURPOSE")
        return Thing(
            words, number=1, purpose=purpose, exceptions=_exceptions(parts), said=_said(parts)
        )

    def pronoun(self, parts: list[Part]) -> Thing:
        """As in "it", "them"."""
        return Thing(str(parts[0]), pronoun=True, definite=True, said=_said(parts))

    def every_pronoun(self, parts: list[Part]) -> Thing:
        """As in "all of them"."""
        return Thing(str(parts[-1]), number=ALL, pronoun=True, definite=True, said=_said(parts))

    def another(self, parts: list[Part]) -> Thing:
        """As in "another apple", "the other one"."""
        noun = next((p for p in parts if isinstance(p, Thing)), Thing())
        return replace(noun, number=1, pronoun=not noun.words, other=True, said=_said(parts))

    def every(self, parts: list[Part]) -> Thing:
        """As in "all the fruit", "everything but the mug"."""
        noun = next((p for p in parts if isinstance(p, Thing)), Thing())
        return replace(
            noun, number=ALL, definite=True, exceptions=_exceptions(parts), said=_said(parts)
        )

    def except_(self, parts: list[Part]) -> tuple[Thing, ...]:
        """As in "but a banana"."""
        return tuple(p for p in parts if isinstance(p, Thing))

    def left_alone(self, parts: list[Part]) -> tuple[Thing, ...]:
        """As in "and do not touch the banana", "but leave the apple and the pear alone"."""
        return tuple(replace(p, alone=True) for p in parts if isinstance(p, Thing))

    def rather(self, parts: list[Part]) -> Things:
        """As in "not the hammer but the drill"."""
        wrong = parts[-1]
        if len(wrong.exceptions) != 1:
            raise Unfit(str(parts[0]))
        [meant] = wrong.exceptions
        return Things((replace(meant, exceptions=(replace(wrong, exceptions=()),)),))

    def all_of(self, parts: list[Part]) -> Things:
        """As in "an apple and a banana"."""
        return Things(tuple(p for p in parts if isinstance(p, Thing)))

    def one_of(self, parts: list[Part]) -> Things:
        """As in "either the hammer or the drill"."""
        return Things(tuple(p for p in parts if isinstance(p, Thing)), one_of=True)

    # --- places ---

    def place(self, parts: list[Part]) -> Where:
        """As in "the kitchen table"."""
        noun = next(p for p in parts if isinstance(p, Thing))
        return Where(noun.words)

    def pronoun_place(self, parts: list[Part]) -> Where:
        """As in "it", as in "next to it"."""
        return Where(parts[0], pronoun=True)

    def where(self, parts: list[Part]) -> Where:
        """As in "on the desk": where it is or where it is to go, as the verb says."""
        places, relation = [], Relation.AT
        for part in parts:
            if _is(part, "RELATION"):
                relation = self._relations[part]
            elif isinstance(part, Where):
                places.append(replace(part, relation=relation))
        return _either(places)

    def source(self, parts: list[Part]) -> "From":
        """As in "from the desk"."""
        return From(_either(parts))

    def goal(self, parts: list[Part]) -> "To":
        """As in "to the desk"."""
        return To(_either(parts))

    def to_person(self, parts: list[Part]) -> "To":
        """As in "to her"."""
        return To(Where(parts[-1], pronoun=True))

    def dative(self, parts: list[Part]) -> Where:
        """As in "bring Anna the mug"."""
        return Where(parts[0])

    def dative_pronoun(self, parts: list[Part]) -> Where:
        """As in "bring her the mug"."""
        return Where(parts[0], pronoun=True)

    def to_me(self, parts: list[Part]) -> "To":
        """As in "to me", "here"."""
        return To(ME)

    def there(self, parts: list[Part]) -> Where:
        """As in "there": where it was spoken of."""
        return Where(parts[0], pronoun=True)

    # --- tasks ---

    def task(self, parts: list[Part]) -> Task:
        """As in "find the mug on the desk": the verb has the name of its terminal."""
        return _task(Verb(parts[0].type.lower()), parts)

    def find(self, parts: list[Part]) -> Task:
        """As in "tell me where the mug is"."""
        return _task(Verb.FIND, parts)

    def take(self, parts: list[Part]) -> Task:
        """As in "take the mug"; with a goal it is brought there."""
        task = _task(Verb.TAKE, parts)
        return replace(task, verb=Verb.PUT) if task.goal else task

    def bring(self, parts: list[Part]) -> Task:
        """As in "bring me the mug", "give the mug to Anna"."""
        task = _task(Verb.BRING, parts)
        return replace(task, verb=Verb.BRING if task.goal in (None, ME) else Verb.PUT)

    def bring_to(self, parts: list[Part]) -> Task:
        """As in "bring Anna the mug"."""
        verb, person, *rest = parts
        return _task(Verb.PUT, [verb, To(person), *rest])

    def wish_for(self, parts: list[Part]) -> Task:
        """As in "I want to drink something": whatever serves for that."""
        thing = Thing(number=1, purpose=_purpose(parts, "PURPOSE"), said=str(parts[-1]))
        return Task(Verb.BRING, Things((thing,)), said=parts[0])

    def search_for(self, parts: list[Part]) -> Task:
        """As in "search the kitchen for the mug"."""
        place, things = (p for p in parts if isinstance(p, Things))
        return Task(Verb.FIND, things, source=Where(place.members[0].words), said=parts[0])

    def leave(self, parts: list[Part]) -> "Task | Left":
        """As in "leave the hammer alone", "leave the hammer on the desk"; "leave it there" puts."""
        things = parts[1]
        if all(thing.pronoun for thing in things.members) and not _is(parts[2], "ALONE"):
            return _task(Verb.PUT, parts, goes=True)
        return Left(self.left_alone([*things.members]))

    def wish(self, parts: list[Part]) -> Task:
        """As in "I need the mug"."""
        return _task(Verb.BRING, parts)

    def put(self, parts: list[Part]) -> Task:
        """As in "put the mug on the desk"; where to may be left for the robot to ask."""
        task = _task(Verb.PUT, parts, goes=True)
        return replace(task, verb=Verb.BRING) if task.goal == ME else task

    def put_down(self, parts: list[Part]) -> Task:
        """As in "put it down", "put the mug down on the desk"."""
        task = _task(Verb.PUT_DOWN, parts, goes=True)
        return replace(task, verb=Verb.PUT) if task.goal else task

    def put_back(self, parts: list[Part]) -> Task:
        """As in "put it back", "take the mug back to the kitchen"."""
        task = _task(Verb.PUT_BACK, parts, goes=True)
        return replace(task, verb=Verb.PUT) if task.goal else task

    def go(self, parts: list[Part]) -> Task:
        """As in "go to the kitchen"; "go back" is to the person."""
        task = _task(Verb.GO, parts, goes=True)
        back = any(_is(p, "BACK") for p in parts)
        return replace(task, goal=ME) if back and not task.goal else task

    def come(self, parts: list[Part]) -> Task:
        """As in "come here"."""
        return Task(Verb.GO, goal=ME, said=parts[0])

    def clear(self, parts: list[Part]) -> Task:
        """As in "clear the table", "clear the mugs from the table"."""
        task = _task(Verb.CLEAR, parts)
        if task.source is None and task.things:
            if task.things.one_of:
                raise Unfit(task.things.members[-1].words)
            places = [Where(thing.words) for thing in task.things.members]
            left_out = (but for thing in task.things.members for but in thing.exceptions)
            return without(replace(task, things=None, source=_either(places)), tuple(left_out))
        return task

    def excepting(self, parts: list[Part]) -> Task:
        """As in "bring all the fruit from the table, except the pear"."""
        task = _deed(next(p for p in parts if isinstance(p, Task | Left)))
        left_out = tuple(p for p in parts if isinstance(p, Thing)) or _exceptions(parts)
        return without(task, left_out)

    def count(self, parts: list[Part]) -> Task:
        """As in "how many fruits are on the table"."""
        return _task(Verb.COUNT, parts)

    def tell(self, parts: list[Part]) -> Task:
        """As in "what is on the table"."""
        return _task(Verb.TELL, parts)

    def check(self, parts: list[Part]) -> Task:
        """As in "is the mug on the sofa", "is there any milk"."""
        return _task(Verb.CHECK, parts)

    def if_there(self, parts: list[Part]) -> Task:
        """As in "if there is one", "if the apple is on the table"."""
        return _task(Verb.CHECK, parts)

    def otherwise(self, parts: list[Part]) -> "Otherwise":
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
        return replace(deed, conditional=True, sought=sought, unless=_instead(deed, rest))

    def if_then(self, parts: list[Part]) -> Task:
        """As in "if there is an apple, bring it, otherwise bring a pear"."""
        sought, part, *rest = (p for p in parts if not isinstance(p, Token))
        deed = _deed(part)
        return replace(deed, conditional=True, sought=sought, unless=_instead(deed, rest))

    # --- what is said ---

    def request(self, parts: list[Part]) -> Request | Refusal:
        """Tasks, one after the other; what is to be left alone is no part of any of them."""
        left = tuple(thing for p in parts if isinstance(p, Left) for thing in p.things)
        tasks = tuple(without(p, left) for p in parts if isinstance(p, Task))
        if not tasks:
            return Refusal(" ".join(thing.said for thing in left))
        in_order = any(_is(p, "FIRST", "THEN") for p in parts)
        return Request(
            tasks,
            in_order,
            too=any(_is(p, "TOO", "LATER") for p in parts),
            agrees=any(_is(p, "YES") for p in parts),
        )

    def more(self, parts: list[Part]) -> Correction:
        """As in "and the pear", "the pear, too": the same as before, with more things."""
        return Correction(next(p for p in parts if isinstance(p, Things)), adds=True)

    def refusal(self, parts: list[Part]) -> Refusal:
        """As in "do not touch the hammer"."""
        return Refusal(_rest(parts))

    def not_this(self, parts: list[Part]) -> Refusal | Correction:
        """As in "not the hammer", "not the hammer but the drill"."""
        wrong = parts[-1]
        if wrong.exceptions:
            meant = Things(wrong.exceptions)
            return Correction(meant, Things((replace(wrong, exceptions=()),)), denies=True)
        return Refusal(wrong.said)

    def unable(self, parts: list[Part]) -> Unable:
        """As in "throw the ball"."""
        verb = next(p for p in parts if _is(p, "UNABLE"))
        return Unable(str(verb), _rest(parts))

    def again(self, parts: list[Part]) -> Again:
        """As in "do that again"."""
        return Again()

    def correction(self, parts: list[Part]) -> Correction:
        """As in "no, the banana", "no, to the kitchen", "no, the mug from the desk"."""
        said = [p for p in parts if not isinstance(p, Token)]
        found: dict[str, Any] = {"denies": any(_is(p, "NO", "NO_BUT") for p in parts)}
        new: dict[str, Any]
        for part in said:
            match part:
                case From(place):
                    new = {"source": place}
                case To(place):
                    new = {"goal": place}
                case Where():
                    new = {"place": part}
                case Request() | Things():
                    new = {"meant": part}
                case _:
                    raise Unfit(str(parts[0]))
            if new.keys() & found.keys():
                raise Unfit(str(parts[0]))
            found |= new
        return Correction(**found)

    def not_that(self, parts: list[Part]) -> Correction:
        """As in "not the apple, the banana"."""
        wrong = next(p for p in parts if isinstance(p, Thing))
        return Correction(parts[-1], Things((wrong,)), denies=True)

    def question(self, parts: list[Part]) -> Question:
        """As in "what can you do"."""
        (token,) = parts
        return Question(About(token.type.lower()))

    def where_put(self, parts: list[Part]) -> Question:
        """As in "where did you put the mug"."""
        return Question(About.WHERE_PUT, things=parts[-1])

    def why(self, parts: list[Part]) -> Question:
        """As in "why did you go to the kitchen"."""
        return Question(About.WHY, str(parts[1]) if len(parts) > 1 else "")

    def statement(self, parts: list[Part]) -> Statement:
        """As in "the mug is on the sofa"."""
        things = next(p for p in parts if isinstance(p, Things))
        place = next(p for p in parts if isinstance(p, Where | To | From))
        if not isinstance(place, Where):
            raise Unfit(place.place.words)
        return Statement(things, place)

    def named(self, parts: list[Part]) -> Answer:
        """As in "I think the apple"."""
        return Answer(things=parts[-1])

    def placed(self, parts: list[Part]) -> Answer:
        """As in "on the desk"."""
        places = [p for p in parts if not isinstance(p, Token)]
        return Answer(where=tuple(p if isinstance(p, Where) else p.place for p in places))

    def ordinal(self, parts: list[Part]) -> Answer:
        """As in "the second one"."""
        return Answer(place_in_list=self._number(parts[-1]))

    def yes(self, parts: list[Part]) -> Answer:
        """As in "yes", "yes, the apple"."""
        return Answer(Choice.YES, things=next((p for p in parts if isinstance(p, Things)), None))

    def no(self, parts: list[Part]) -> Answer:
        """As in "no"."""
        return Answer(Choice.NO)

    def unknown(self, parts: list[Part]) -> Answer:
        """As in "I do not know"."""
        return Answer(Choice.UNKNOWN)

    def any_one(self, parts: list[Part]) -> Answer:
        """As in "whichever"."""
        return Answer(Choice.ANY)

    def both(self, parts: list[Part]) -> Answer:
        """As in "both", "all of them"."""
        return Answer(Choice.ALL)

    def courtesy(self, parts: list[Part]) -> Courtesy:
        """As in "thank you"."""
        return Courtesy(parts[0].type.lower())

    def _number(self, token: Token) -> int:
        digits = token.removeprefix("number ").removesuffix(" one")
        if digits.isdecimal():
            return int(digits)
        return self._numbers.get(token) or self._numbers[token.removesuffix(" one")]


class Unfit(Exception):
    """The words have the form of a sentence, and make no sense as one; says which word does not."""


@dataclass(frozen=True, slots=True)
class From:
    """Where a thing is to be taken from."""

    place: Where


@dataclass(frozen=True, slots=True)
class To:
    """Where, or to whom, a thing is to go."""

    place: Where


@dataclass(frozen=True, slots=True)
class Left:
    """What is to stay where it is."""

    things: tuple[Thing, ...]


@dataclass(frozen=True, slots=True)
class Otherwise:
    """What is to be done instead."""

    deed: Task | Things


def _deed(part: Part) -> Task:
    """A task; what is not to be done ("leave it alone") depends on nothing, and nothing on it."""
    if not isinstance(part, Task):
        raise Unfit(part.things[-1].said)
    return part


def without(task: Task, left_out: tuple[Thing, ...]) -> Task:
    """The same less some things; what has to do with none is done with all but these."""
    if not left_out:
        return task
    things = task.things or Things((Thing(number=ALL, definite=True, said="everything"),))
    members = (replace(t, exceptions=(*t.exceptions, *left_out)) for t in things.members)
    return replace(task, things=replace(things, members=tuple(members)))


def _said(parts: list[Part]) -> str:
    """The words of a thing as they were said, without articles and exceptions."""
    said = (p.said if isinstance(p, Thing) else p for p in parts if not _is(p, "A", "THE", "SOME"))
    return " ".join(str(p) for p in said if isinstance(p, str))


def _rest(parts: list[Part]) -> str:
    """What the grammar takes as it is; empty if nothing was there."""
    return next((str(p) for p in parts if _is(p, "ANYTHING")), "")


def _is(part: Part, *types: str) -> bool:
    return isinstance(part, Token) and part.type in types


def _either(parts: list[Part]) -> Where:
    """The first of the places, with the others beside it."""
    first, *others = (p for p in parts if isinstance(p, Where))
    return replace(first, others=tuple(others))


def _purpose(parts: list[Part], kind: str) -> str:
    token = next((p for p in parts if _is(p, kind)), "")
    return token.partition(" ")[2]


def _exceptions(parts: list[Part]) -> tuple[Thing, ...]:
    return next((p for p in parts if isinstance(p, tuple) and not isinstance(p, str)), ())


def _instead(deed: Task, rest: list[Part]) -> Task | None:
    """What to do if the condition does not hold: with things only, the same deed with them."""
    instead = next((p.deed for p in rest if isinstance(p, Otherwise)), None)
    if isinstance(instead, Things):
        return replace(deed, things=instead)
    return instead


def _task(verb: Verb, parts: list[Part], *, goes: bool = False) -> Task:
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
        if isinstance(part, From):
            role, place = "source", part.place
        elif isinstance(part, To):
            role, place = "goal", part.place
        elif isinstance(part, Where):
            role, place = ("goal" if goes else "source"), part
            if last and (role in places or last == "goal"):
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
    said = next((str(p) for p in parts if isinstance(p, Token)), "")
    return Task(verb, things, places.get("source"), places.get("goal"), said=said)


def _inner(within: Where | None, place: Where) -> Where:
    return place if within is None else replace(within, within=_inner(within.within, place))
