"""Leaves that tell the person what happens, and ask them for places."""

from py_trees.common import Status

from executive.language.meaning import Said
from executive.language.wording import as_said, beginning
from executive.replies import SAYS, SAYS_OF_SEVERAL
from executive.situation import candidates_from
from executive.text import printable
from executive.types.dialogue import Question, QuestionKind
from executive.types.knowledge import Source
from trees.asking import Ask
from trees.context import MissionContext
from trees.nodes import Step
from trees.place_words import not_to_be_put, only_on_furniture, places_in
from trees.telling import sentence, tell


class AskForPlace(Ask):
    """Asks for a place of the home."""

    def once_more(self, text: str) -> str:
        """The question again, with all furniture of the home."""
        places = (self.context.say.the(place.name) for place in self.context.knowledge.places())
        no_place = "" if self._attended else "I know no such place. "
        return f"{no_place}{text} I know: {', '.join(places)}."

    def _attend_to(self, said: Said, words: str) -> bool:
        """Tell it if nothing can be put where the answer says."""
        if not (goal := self._not_to_be_put(words)):
            return super()._attend_to(said, words)
        tell(self.context, f"{only_on_furniture(as_said(words, goal))}.")
        return True

    def _not_to_be_put(self, answer: str) -> str:
        """The words for the goal, if nothing can be put there; empty if it can."""
        puts = self.question().kind == QuestionKind.WHERE_TO_PUT
        return not_to_be_put(self.context, answer) if puts else ""


class AskWhere(AskForPlace):
    """Asks where the thing is.

    Reads request.object and search.looks; writes search.candidates.
    """

    def question(self) -> Question:
        """Say first where the robot has looked for it."""
        name, say = self.situation.request.thing, self.context.say
        text = f"Where {say.is_(name)} {say.the(name)}?"
        if so_far := self.situation.search.so_far(name, say):
            text = f"{so_far}. {text}"
        if self._tries:
            text = self.once_more(text)
        return Question(QuestionKind.WHERE_IS, name, text)

    def understood(self, answer: str) -> bool:
        """Take the places that exist as candidates, and remember them."""
        places = places_in(self.context, answer)
        if places:
            assert self.situation.request.object
            self.context.facts.heard(self.situation.request.object, places)
            self.situation.search.candidates = candidates_from(places, Source.USER)
        return bool(places)

    def unresolved(self) -> str:
        """The robot has looked in vain, or does not know where to look."""
        name, say = self.situation.request.thing, self.context.say
        return self.situation.search.so_far(name, say) or f"I do not know where {say.are(name)}"


class AskWhereToPut(AskForPlace):
    """Asks where to put down what is in the hand, because the robot has found no room.

    Reads hand.unplaced; writes hand.surfaces.
    """

    def question(self) -> Question:
        """Say first where there was no room."""
        held = self.situation.hand.in_hand or ""
        text = f"Where shall I put {self.context.say.the(held)}?"
        first = f"{beginning(self.unresolved())}. {text}"
        text = self.once_more(text) if self._tries else first
        return Question(QuestionKind.WHERE_TO_PUT, held, text)

    def understood(self, answer: str) -> bool:
        """Take any furniture that exists."""
        unfit = self._not_to_be_put(answer)
        self.situation.hand.surfaces = () if unfit else places_in(self.context, answer)
        return bool(self.situation.hand.surfaces)

    def unresolved(self) -> str:
        """The thing was not put down where the robot has tried."""
        return self.situation.hand.not_put_down(self.context.say)


class Announce(Step):
    """Tells where the robot is going to look, and which source says so.

    Reads search.candidates.
    """

    def update(self) -> Status:
        """Tell it."""
        candidates = self.situation.search.candidates
        name, say = self.situation.request.thing, self.context.say
        places = ", then ".join(say.at_each(candidate.place for candidate in candidates))
        why = who_says(self.context, candidates[0].source)
        tell(self.context, f"I look for {say.the(name)} {places}: {why}.")
        return self.succeed(", then ".join(candidate.place for candidate in candidates))


class Report(Step):
    """Tells what was done.

    Reads search.found and hand.put_at; writes ending.reason.
    """

    def __init__(self, name: str, context: MissionContext, text: str) -> None:
        """`text` may use {the_object}, {The_object}, {is_}, {it}, {at}, {place}, {put} and {goal}.

        "{The_object} {is_} {at}" becomes "The mug is on the desk in the bedroom". {place} is the
        place without a preposition, {put} where the thing was put down, {goal} where it is to go.
        """
        super().__init__(name, context)
        self._text = text

    def update(self) -> Status:
        """Tell it, and keep it as the outcome's reason."""
        found, hand, say = self.situation.search.found, self.situation.hand, self.context.say
        name = self.situation.request.thing
        the = say.the(name) if name else ""
        said = printable(
            self._text.format(
                the_object=the,
                The_object=beginning(the),
                is_=say.is_(name),
                it=say.it(name),
                at=say.at_in_full(found.place) if found else "nowhere",
                place=say.the(found.place) if found else "nowhere",
                put=say.at(hand.put_at),
                goal=say.the(self.situation.request.goal),
            )
        )
        self.situation.ending.tell(said)
        tell(self.context, said)
        return self.succeed(said)


class Apologise(Step):
    """Tells why the task was not done.

    Writes ending.reason.
    """

    def update(self) -> Status:
        """Tell why the last alternative failed, or what was wrong with the words."""
        self.situation.ending.tell(self.why_before())
        why = self.situation.request.remark or f"Sorry: {self.situation.ending.why}"
        tell(self.context, sentence(why))
        return self.succeed(self.situation.ending.why)


def who_says(context: MissionContext, source: str, **others: tuple[str, str]) -> str:
    """Who says where the thing is, as a clause.

    `others` are clauses for further sources: one for a single thing, one for several.
    """
    name, say = context.situation.request.thing, context.say
    says = {
        **(SAYS_OF_SEVERAL if say.agree(name, "", "are") else SAYS),
        **{who: say.agree(name, *clauses) for who, clauses in others.items()},
        **{own.name: own.says for own in context.sources},
    }
    return printable(says.get(source, f"so says the {source}"))
