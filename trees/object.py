"""Which thing is meant? The ontology may know, or the person's preferences; else the person does.

The language model is never asked: which fruit someone likes is personal, and no general knowledge
(paper, section "Integrated use of ontological knowledge base and LLM").
"""

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from executive.types.commands import HELD
from executive.types.knowledge import Source
from trees.clarification import AskDoYouMean, AskWhichObject
from trees.context import MissionContext
from trees.meant import meant, without_exceptions
from trees.nodes import Check, FirstOf, Step, fallback, sequence
from trees.survey import found_where, nothing_there, survey
from trees.telling import tell


def resolve_object(context: MissionContext) -> Behaviour:
    """Find the thing that the words mean; writes request.object."""
    return fallback(
        "which object",
        known_object(context),
        sequence(
            "a slip",
            GuessName("is like a known name", context),
            AskDoYouMean("ask do you mean", context),
            known_object(context),
        ),
        see_which_is_there(context),
        sequence(
            "ask",
            Check("person may help", context, lambda: not context.situation.dialogue.no_help),
            AskWhichObject("ask which object", context),
        ),
    )


def see_which_is_there(context: MissionContext) -> Behaviour:
    """Go and see which of several possible things is at the place in the words.

    So "a ball from the desk" means a ball that is there. Fails if the words name no place.
    """
    request = context.situation.request

    def there() -> list[str]:
        return [request.asked_for.source] if request.asked_for.source and request.options else []

    return FirstOf(
        "see which is there",
        there,
        sequence("look", survey(context), TakeOneThatIsThere("one of them", context)),
    )


def known_object(context: MissionContext) -> Behaviour:
    """Find the thing without a question to the person."""
    request = context.situation.request

    def held() -> list[str]:
        return [HELD] if request.command and request.command.target == HELD else []

    return fallback(
        "known object",
        FirstOf("what I hold", held, HeldIsMeant("it is in my hand", context)),
        OntologyKnowsObject("ontology knows it", context),
        PersonPrefersOne("the person prefers one", context),
    )


class TakeOneThatIsThere(Step):
    """Succeeds if one of the things is there; or several, if the person wants just any one.

    Reads survey.seen; writes request.object, or request.options. In search.looks, the place does
    not count as visited any more: the robot looks there again to take the thing.
    """

    source = "eyes"

    def update(self) -> Status:
        """Take the first one that was seen; if there is none, tell the person."""
        request, search = self.situation.request, self.situation.search
        found = self.situation.survey.found
        if not found:
            why = nothing_there(self.context)
            tell(self.context, f"{why}.")
            return self.fail(why)
        if len(found) > 1 and request.asked_for.number != 1:
            request.options = tuple(found)
            return self.fail(f"there are {found_where(found, self.context.say)}")
        request.object, place = next(iter(found.items()))
        search.looks.visited = [p for p in search.looks.visited if p != place]
        return self.succeed(request.object)


class HeldIsMeant(Step):
    """Succeeds if something is in the hand: "it" is that.

    Reads hand.in_hand; writes request.object.
    """

    def update(self) -> Status:
        """Take what is in the hand."""
        held = self.situation.hand.in_hand
        if held is None:
            return self.fail("my hand is empty")
        self.situation.request.object = held
        return self.succeed(held)


class OntologyKnowsObject(Step):
    """Succeeds if the words name exactly one known object.

    Reads request.command; writes request.object, or request.options.
    """

    source = Source.ONTOLOGY

    def update(self) -> Status:
        """Look the target up in the ontology."""
        command = self.situation.request.asked_for
        knowledge = self.context.knowledge
        named = without_exceptions(knowledge, command, meant(knowledge, command))
        if len(named) == 1:
            self.situation.request.object = named[0]
            return self.succeed(named[0])
        self.situation.request.options = named
        return self.fail(f"'{command.target}' names {len(named) or 'no'} known objects")


class PersonPrefersOne(Step):
    """Succeeds if the ontology knows that the person prefers exactly one of the options.

    Reads request.options; writes request.object.
    """

    source = Source.ONTOLOGY

    def update(self) -> Status:
        """Take the one favourite among the options."""
        favourites = self.context.knowledge.preferred(self.situation.request.options)
        if len(favourites) != 1:
            return self.fail(f"{len(favourites) or 'none'} of them is a favourite")
        self.situation.request.object = favourites[0]
        return self.succeed(favourites[0])


class GuessName(Step):
    """Succeeds if the words contain one known name, or are like one, as after a typing error.

    If they contain several, the person must choose: the robot does one thing at a time.
    Reads request.command; writes request.guess, or request.options and request.several.
    """

    def update(self) -> Status:
        """Look for known names."""
        target = self.situation.request.asked_for.target
        if self.situation.request.options:
            return self.fail(f"'{target}' is known")
        knowledge = self.context.knowledge
        if knowledge.objects_named(target):
            return self.fail(f"'{target}' is known, and all of it is said not to be meant")
        if knowledge.is_place(target):
            return self.fail(f"'{target}' is a place")
        if other := knowledge.other_color(target):
            names: tuple[str, ...] = tuple(name for name, _ in other.actual)
            if len(names) > 1:
                return self.fail(f"several things would be '{target}' but for their colours")
            [self.situation.request.guess] = names
            return self.succeed(names[0])
        names = knowledge.names_in(target)
        if len(names) > 1:
            self.situation.request.several = True
            self.situation.request.options = tuple(
                dict.fromkeys(one for name in names for one in knowledge.objects_named(name))
            )
            return self.fail(f"'{target}' names several things")
        self.situation.request.guess = names[0] if names else knowledge.near_name(target) or ""
        if not self.situation.request.guess:
            return self.fail(f"'{target}' is like no known name")
        return self.succeed(self.situation.request.guess)
