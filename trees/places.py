"""The places in the words: where the thing is, and where it, or the robot, is to go."""

from collections.abc import Sequence
from dataclasses import replace

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from executive.language.commands import in_words
from executive.language.meaning import Answer, Correction, Request, Said
from executive.language.wording import either
from executive.types.commands import Command, CommandKind
from executive.types.dialogue import Question, QuestionKind
from executive.types.home import PERSON, SOMETHING
from executive.types.knowledge import Source
from trees.at_hand import is_about_the_same
from trees.context import MissionContext
from trees.corrections import correct
from trees.nodes import EachOf, FirstOf, Step, fallback, sequence
from trees.person import AskForPlace, AskWhere
from trees.place_words import (
    best_first,
    chosen_of,
    goal_words,
    goals_in,
    is_place,
    known_at,
    may_be,
    neighbours,
    options_in,
    places_in,
    unknown_goal,
    unknown_place,
)
from trees.telling import TO_THE_PERSON, tell


def named_places(context: MissionContext) -> Behaviour:
    """Find the places that the words name; writes request.from_places and request.goals."""
    request = context.situation.request

    def source() -> Sequence[str]:
        return [request.asked_for.source] if request.asked_for.source else []

    def goes() -> Sequence[str]:
        return [request.asked_for.kind] if request.asked_for.kind.means.at_goal else []

    return sequence(
        "named places",
        EachOf("if it is somewhere", source, starting_place(context)),
        EachOf("if it goes somewhere", goes, destination(context)),
    )


def starting_place(context: MissionContext) -> Behaviour:
    """Where the words say that the thing is; if nobody knows that place, the search goes on."""
    return fallback(
        "from where",
        SourceIsKnown("the place is known", context),
        AskFromWhere("ask where", context),
        SearchAnyway("search as ever", context),
    )


def destination(context: MissionContext) -> Behaviour:
    """Where the thing, or the robot, is to go; asks if it is not known. Writes request.goals."""
    request = context.situation.request

    def back() -> list[str]:
        return [request.thing] if goes_back(request.command) else []

    return fallback(
        "to where",
        GoalIsKnown("the goal is known", context),
        FirstOf(
            "back",
            back,
            fallback(
                "where it was",
                TakenFrom("it was taken from there", context),
                UsualPlace("its usual place", context),
            ),
        ),
        AskWhereTo("ask where to", context),
    )


def destination_of_all(context: MissionContext) -> Behaviour:
    """The same for several things that go to one place: the robot asks once for all of them."""
    request = context.situation.request

    def goal() -> list[str]:
        command = request.command
        goes = command and (command.goal or command.kind == CommandKind.PUT)
        return [command.goal] if command and goes else []

    return EachOf(
        "if they go somewhere",
        goal,
        fallback(
            "to where",
            GoalIsKnown("the goal is known", context),
            sequence(
                "ask once",
                AskWhereTo("ask where to", context),
                EachGoesThere("each of them", context),
            ),
        ),
    )


class SourceIsKnown(Step):
    """Succeeds if the words name a place of the home.

    Reads request.command; writes request.from_places.
    """

    source = "person"

    def update(self) -> Status:
        """Keep the places, in a room first those where the thing was seen or belongs."""
        request = self.situation.request
        assert request.object
        named = places_in(self.context, request.asked_for.source)
        if not named or not is_place(self.context, request.asked_for.source):
            return self.fail(unknown_place(self.context, request.asked_for.source))
        likely = (
            *self.context.facts.places_of(request.object),
            *usual_places(self.context),
        )
        request.from_places = tuple(sorted(named, key=lambda place: place not in likely))
        return self.succeed(", ".join(request.from_places))


class AskFromWhere(AskWhere):
    """Asks where the thing is if the place that the words name is not known.

    Reads request.command; writes request.from_places.
    """

    def question(self) -> Question:
        """Say first which place is not known."""
        asked = super().question()
        text = f"{self.unresolved()}. {asked.text}" if self._tries == 0 else asked.text
        return Question(asked.kind, asked.about, text)

    def understood(self, answer: str) -> bool:
        """Take the places of the answer instead of those in the words."""
        if not super().understood(answer):
            return False
        self.situation.request.from_places = places_in(self.context, answer)
        return True

    def unresolved(self) -> str:
        """The place in the words is not known."""
        return unknown_place(self.context, self.situation.request.asked_for.source)


class SearchAnyway(Step):
    """Tells that a place is not known, and that the robot searches nevertheless; succeeds."""

    def update(self) -> Status:
        """Tell it: the robot ignores no part of a command in silence."""
        request = self.situation.request
        said = unknown_place(self.context, request.asked_for.source)
        say, name = self.context.say, request.thing
        where = f"where {say.agree(name, 'it', 'they')} may be"
        tell(self.context, f"{said}; I look for {say.the(name)} {where}.")
        return self.succeed(said)


class GoalIsKnown(Step):
    """Succeeds if the words name one place; or one room, where any furniture will do.

    Reads request.command; writes request.goals.
    """

    source = "person"

    def update(self) -> Status:
        """Find the goal that the words name."""
        goal = goal_words(self.context)
        if not goal:
            return self.fail("you named no place")
        if goal.lower() in TO_THE_PERSON:
            self.situation.request.goals = (PERSON,)
            return self.succeed(PERSON)
        if things := neighbours(self.context):
            return self._beside(things)
        named = goals_in(self.context)
        if not named:
            return self.fail(unknown_goal(self.context))
        if options_in(self.context):
            return self.fail(may_be(self.context, goal, named))
        goes = self.situation.request.asks_to(CommandKind.GO)
        self.situation.request.goals = named if goes else best_first(self.context, named)
        return self.succeed(", ".join(self.situation.request.goals))

    def _beside(self, things: Sequence[str]) -> Status:
        """Take the furniture where one of these things was last, and tell which that is."""
        say = self.context.say
        for thing in things:
            for place in known_at(self.context, thing):
                tell(self.context, f"As far as I know, {say.are(thing)} {say.at(place)}.")
                self.situation.request.goals = (place,)
                return self.succeed(place)
        return self.fail(unknown_goal(self.context))


class TakenFrom(Step):
    """Succeeds if the robot remembers where it took the thing from.

    Reads request.object; writes request.goals.
    """

    source = Source.MEMORY

    def update(self) -> Status:
        """Take the place where it was last taken from."""
        request = self.situation.request
        known = taken_from(self.context, request.object)
        if not known:
            what = self.context.say.the(request.thing)
            return self.fail(f"I do not know where I took {what}")
        request.goals = (known[0],)
        return self.succeed(known[0])


class UsualPlace(Step):
    """Succeeds if the ontology knows where the thing belongs.

    Reads request.object; writes request.goals.
    """

    source = Source.ONTOLOGY

    def update(self) -> Status:
        """Take the usual places, and tell it: the thing may have come from elsewhere."""
        request = self.situation.request
        usual, say, name = usual_places(self.context), self.context.say, request.thing
        if not usual:
            belongs = say.agree(name, "belongs", "belong")
            return self.fail(f"I do not know where {say.the(name)} {belongs}")
        request.goals = usual
        was = say.agree(name, "was; it belongs", "were; they belong")
        there = either(say.at_each(usual))
        tell(self.context, f"I do not know where {say.the(name)} {was} {there}.")
        return self.succeed(", ".join(usual))


class AskWhereTo(AskForPlace):
    """Asks where the thing, or the robot, is to go.

    Reads request.command and request.object; writes request.goals.
    """

    def question(self) -> Question:
        """Offer the places that the words may mean; else say what is not known."""
        goes = self.situation.request.asks_to(CommandKind.GO)
        kind = QuestionKind.WHERE_TO_GO if goes else QuestionKind.WHERE_TO_PUT
        about = self.situation.request.thing
        goal, options = goal_words(self.context), options_in(self.context)
        say = self.context.say
        if options:
            text = f"Which {goal} do you mean: {say.any_of(options)}?"
            return Question(kind, about, text, options)
        what = say.the(about) if about else "them"
        text = "Where shall I go?" if goes else f"Where shall I put {what}?"
        if self._tries:
            text = self.once_more(text)
        elif goal:
            text = f"{self.unresolved()}. {text}"
        return Question(kind, about, text)

    def understood(self, answer: str) -> bool:
        """Take one place or one room; if some were offered, one of those or another place."""
        if self._not_to_be_put(answer):
            return False
        if options := options_in(self.context):
            named = chosen_of(self.context, answer, options) or self._another(answer)
            if len(named) != 1:
                return False
        else:
            named = places_in(self.context, answer)
        self.situation.request.goals = best_first(self.context, named)
        return bool(named)

    def _another(self, answer: str) -> tuple[str, ...]:
        """A place that was not offered, if the answer names one: "on the sofa, please"."""
        match self.context.interpreter.read(answer):
            case Answer(where=[place]):
                answer = in_words(place)
        named = places_in(self.context, answer) if is_place(self.context, answer) else ()
        return named if len(named) == 1 else ()

    def _attend_to(self, said: Said, words: str) -> bool:
        """Take another request about the same thing as a correction: "give it to me"."""
        if not isinstance(said, Request) or not is_about_the_same(self.context, said, words):
            return super()._attend_to(said, words)
        now = f"I {self.doing()}."
        tell(self.context, correct(self.context, Correction(said), words, now))
        return True

    def unresolved(self) -> str:
        """The goal is not known, or may be one of several."""
        if options := options_in(self.context):
            return may_be(self.context, goal_words(self.context), options)
        return unknown_goal(self.context)


class EachGoesThere(Step):
    """Puts the answer into the command, as the goal of each of the things.

    Reads request.goals; writes request.command.
    """

    def update(self) -> Status:
        """Replace the words for the goal, so that nobody is asked again for each thing."""
        request = self.situation.request
        request.command = replace(request.asked_for, goal=" or ".join(request.goals))
        return self.succeed(request.asked_for.goal)


def taken_from(context: MissionContext, name: str | None) -> tuple[str, ...]:
    """The furniture that the robot took a thing from, the latest first."""
    taken = context.facts.origins().get(name or "", ())
    return tuple(place for place in taken if context.knowledge.has_place(place))


def usual_places(context: MissionContext) -> tuple[str, ...]:
    """Where the thing belongs; no places if the ontology does not know the thing."""
    name = context.situation.request.object
    return () if name in (None, SOMETHING) else context.knowledge.usual_places(name)


def goes_back(command: Command | None) -> bool:
    """Whether a command says to put the thing back, and not where."""
    return command is not None and command.kind == CommandKind.PUT_BACK and not command.goal
