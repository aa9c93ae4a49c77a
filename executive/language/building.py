"""From the rules of a grammar to `meaning.py`: one method a rule, the same for every language."""

from dataclasses import replace
from typing import Any

from lark import Token

from executive.language.deeds import Deeds, first_of_all
from executive.language.meaning import (
    About,
    Again,
    Answer,
    Choice,
    Correction,
    Courtesy,
    Question,
    Refusal,
    Request,
    Statement,
    Task,
    Thing,
    Things,
    Unable,
    Where,
)
from executive.language.parts import From, Further, Left, Part, To, Unfit, is_a, rest_of


class Builder(Deeds):
    """Makes of the rules all that may be said.

    The rules about things and places are in `Nouns`, those about what is to be done in `Deeds`.
    """

    def request(self, parts: list[Part]) -> Request | Refusal | Unable:
        """Tasks, one after the other; what is to be left alone is no part of any of them.

        If one of them cannot be done, it is said which.
        """
        if unable := next((p for p in parts if isinstance(p, Unable)), None):
            return replace(unable, more=True)
        left = tuple(thing for p in parts if isinstance(p, Left) for thing in p.things)
        tasks = tuple(task.without(left) for task in self._tasks(parts))
        if not tasks:
            return Refusal(" ".join(thing.said for thing in left))
        first = is_a(parts[-1], "AT_FIRST") or any(is_a(p, "FIRST") for p in parts)
        if first and (things := tasks[0].things) and things.exceptions:
            tasks, first = (replace(tasks[0], things=first_of_all(things)), *tasks[1:]), False
        return Request(
            tasks,
            first=first,
            agrees=any(is_a(p, "YES") for p in parts),
            later=any(is_a(p, "TOO") and p.endswith("later") for p in parts),
        )

    def _tasks(self, parts: list[Part]) -> list[Task]:
        """Each task, with those that say no verb of their own.

        Raises:
            Unfit: if it is not clear what "them" are.
        """
        tasks: list[Task] = []
        further = in_order = False
        for part in parts:
            in_order |= is_a(part, "AT_FIRST")
            if isinstance(part, Further):
                if not tasks:
                    raise Unfit("and")
                tasks += self.once_more(tasks[-1], part, alone=in_order)
                further = True
            elif isinstance(part, Task):
                if further and part.things and part.things.members[0].pronoun:
                    raise Unfit(part.things.members[0].words)
                tasks.append(part)
        return tasks

    def more(self, parts: list[Part]) -> Correction:
        """As in "and the pear", "the pear, too": the same as before, with more things."""
        return Correction(next(p for p in parts if isinstance(p, Things)), adds=True)

    def more_there(self, parts: list[Part]) -> Correction:
        """As in "and the pear on the sofa", "and on the sofa": the same as before, there."""
        said = [p for p in parts if not isinstance(p, Token)]
        return replace(self._corrects(said), adds=True)

    def refusal(self, parts: list[Part]) -> Refusal:
        """As in "do not touch the hammer"."""
        return Refusal(rest_of(parts))

    def not_this(self, parts: list[Part]) -> Refusal | Correction:
        """As in "not the hammer", "not the hammer but the drill"."""
        wrong = parts[-1]
        if wrong.exceptions:
            meant = Things(wrong.exceptions)
            return Correction(meant, Things((replace(wrong, exceptions=()),)), denies=True)
        return Refusal(wrong.said)

    def unable(self, parts: list[Part]) -> Unable:
        """As in "throw the ball", "get rid of the mug", "bring the mug and wash it"."""
        verb = next(p for p in parts if is_a(p, "UNABLE"))
        return Unable(str(verb), rest_of(parts))

    def again(self, parts: list[Part]) -> Again:
        """As in "do that again"."""
        return Again()

    def correction(self, parts: list[Part]) -> Correction | Refusal:
        """As in "no, the banana", "no, to the kitchen", "no, the mug from the desk"."""
        said = [p for p in parts if not isinstance(p, Token)]
        if len(said) == 1 and isinstance(said[0], Refusal):
            return said[0]
        return self._corrects(said, denies=any(is_a(p, "NO", "NO_BUT") for p in parts))

    def _corrects(self, said: list[Part], *, denies: bool = False) -> Correction:
        """These things, or places, in place of those of before.

        Raises:
            Unfit: if there are more places than there is use for.
        """
        found: dict[str, Any] = {"denies": denies}
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
                case (Thing(), *_):
                    new = {"left_out": part}
                case _:
                    raise Unfit("")
            if new.keys() & found.keys():
                raise Unfit("")
            found |= new
        return Correction(**found)

    def not_that(self, parts: list[Part]) -> Correction:
        """As in "not the apple, the banana"."""
        wrong = next(p for p in parts if isinstance(p, Thing))
        return Correction(parts[-1], Things((wrong,)), denies=True)

    def not_there(self, parts: list[Part]) -> Correction:
        """As in "not there, on the desk", "not to me, to the desk"."""
        return self._corrects([parts[-1]], denies=True)

    def there_not(self, parts: list[Part]) -> Correction:
        """As in "to the sofa, not on the desk"."""
        return self._corrects([parts[0]])

    def another_number(self, parts: list[Part]) -> Correction:
        """As in "no, five", of things of the same kind."""
        number = next(p for p in parts if is_a(p, "ONLY_NUMBER"))
        word = number.partition(" ")[0]
        thing = Thing(number=self.count_of(Token("NUMBER", word)), said=word)
        return Correction(Things((thing,)), denies=any(is_a(p, "NO", "NO_BUT") for p in parts))

    def question(self, parts: list[Part]) -> Question:
        """As in "what can you do"."""
        (token,) = parts
        return Question(About(token.type.lower()))

    def where_put(self, parts: list[Part]) -> Question:
        """As in "where did you put the mug"."""
        return Question(About.WHERE_PUT, things=parts[-1])

    def where_found(self, parts: list[Part]) -> Question:
        """As in "where did you get the mug from", "where was it"."""
        return Question(About.WHERE_FOUND, things=next(p for p in parts if isinstance(p, Things)))

    def known(self, parts: list[Part]) -> Question:
        """As in "what do you know about the mug", "where do you keep the cups"."""
        return Question(About.KNOWN, things=parts[-1])

    def why(self, parts: list[Part]) -> Question:
        """As in "why did you go to the kitchen"."""
        return Question(About.WHY, str(parts[1]) if len(parts) > 1 else "")

    def statement(self, parts: list[Part]) -> Statement:
        """As in "the mug is on the sofa and the pear is on the desk"."""
        more: Statement | None = None
        for told in reversed([one for p in parts if isinstance(p, list) for one in p]):
            more = replace(told, more=more)
        assert more
        return more

    def told(self, parts: list[Part]) -> list[Statement]:
        """As in "the mug is on the sofa", "it is not on the sofa but on the desk".

        As in "I took the mug to the kitchen", too.
        """
        it = "them" if any(is_a(p, "THEY_ARE_NOT") for p in parts) else "it"
        spoken_of = Things((Thing(it, pronoun=True, definite=True, said=it),))
        things = next((p for p in parts if isinstance(p, Things)), spoken_of)
        told: list[Statement] = []
        denied = False
        for part in parts:
            match part:
                case Token(type="NOT" | "IT_IS_NOT" | "THEY_ARE_NOT" | "NONE_THERE"):
                    denied = True
                case Token(type="BUT"):
                    denied = False
                case Where() as place:
                    told.append(Statement(things, place, denied))
                case To(place) if any(is_a(p, "I_PUT") for p in parts):
                    told.append(Statement(things, place))
                case From() | To():
                    raise Unfit(part.place.words)
        return told

    def named(self, parts: list[Part]) -> Answer:
        """As in "I think the apple", "the second one"."""
        things = parts[-1]
        which = things.members[0].place_in_list if len(things.members) == 1 else None
        return Answer(things=things) if which is None else Answer(place_in_list=which)

    def named_there(self, parts: list[Part]) -> Answer:
        """As in "the pear from the sofa"."""
        things, place = (p for p in parts if not isinstance(p, Token))
        if isinstance(place, To):
            raise Unfit(place.place.words)
        return Answer(things=things, where=(place if isinstance(place, Where) else place.place,))

    def named_first(self, parts: list[Part]) -> Answer:
        """As in "the mug first", "the mug first, then the pear"."""
        members = (one for p in parts if isinstance(p, Things) for one in p.members)
        return Answer(things=Things(tuple(members), in_order=True), first=True)

    def placed(self, parts: list[Part]) -> Answer | Correction:
        """As in "on the desk"; "to the desk" is not where it is."""
        if isinstance(parts[-1], To) and len(parts) == 1:
            return Correction(goal=parts[-1].place)
        places = [p for p in parts if not isinstance(p, Token)]
        where = tuple(p if isinstance(p, Where) else p.place for p in places)
        return Answer(where=where, told=is_a(parts[0], "HEDGE"))

    def the_one(self, parts: list[Part]) -> Correction:
        """As in "the one on the desk": of the kind that was asked for, the one that is there."""
        one = Things((Thing("one", definite=True, said="one"),))
        return self._corrects([one, *(p for p in parts if not isinstance(p, Token))])

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

    def nearest(self, parts: list[Part]) -> Answer:
        """As in "whichever is closest"."""
        return Answer(Choice.NEAREST)

    def all(self, parts: list[Part]) -> Answer:
        """As in "all of them"."""
        return Answer(Choice.ALL)

    def both(self, parts: list[Part]) -> Answer:
        """As in "both of them"."""
        return Answer(Choice.BOTH)

    def courtesy(self, parts: list[Part]) -> Courtesy:
        """As in "thank you"."""
        return Courtesy(parts[0].type.lower())
