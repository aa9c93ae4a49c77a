"""Which thing is meant? The ontology says, or whose home it is, else the person is asked.

The language model never is: which fruit someone likes is a matter of that person, not of general
knowledge (paper, section "Integrated use of ontological knowledge base and LLM").
"""

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from executive.interfaces import Knowledge
from executive.types import HELD, Command, Source
from trees.context import MissionContext
from trees.nodes import Check, FirstOf, Step, fallback, sequence
from trees.person import AskDoYouMean, AskWhichObject, without_exceptions


def resolve_object(context: MissionContext) -> Behaviour:
    """Words for a thing -> `situation.request.object`."""
    return fallback(
        "which object",
        known_object(context),
        sequence(
            "a slip",
            GuessName("is like a known name", context),
            AskDoYouMean("ask do you mean", context),
            known_object(context),
        ),
        sequence(
            "ask",
            Check("person may help", context, lambda: not context.situation.dialogue.no_help),
            AskWhichObject("ask which object", context),
        ),
    )


def known_object(context: MissionContext) -> Behaviour:
    """What can be told without a question."""
    request = context.situation.request

    def held() -> list[str]:
        return [HELD] if request.command and request.command.target == HELD else []

    return fallback(
        "known object",
        FirstOf("what I hold", held, lambda _: None, HeldIsMeant("it is in my hand", context)),
        OntologyKnowsObject("ontology knows it", context),
        PersonPrefersOne("the person prefers one", context),
    )


def meant(knowledge: Knowledge, command: Command) -> tuple[str, ...]:
    """The objects that a command may be about: what they are called, look like, or are for."""
    if command.purpose:
        return knowledge.objects_for(command.purpose)
    return knowledge.objects_named(command.target)


class HeldIsMeant(Step):
    """Succeeds if something is in the hand, of which nobody has to say the name.

    Reads hand.in_hand; writes request.object.
    """

    def update(self) -> Status:
        """It is that."""
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
        """Look the words up."""
        command = self.situation.request.command
        assert command
        named = without_exceptions(self.context, meant(self.context.knowledge, command))
        if len(named) == 1:
            self.situation.request.object = named[0]
            return self.succeed(named[0])
        self.situation.request.options = named
        return self.fail(f"'{command.target}' names {len(named) or 'no'} known objects")


class PersonPrefersOne(Step):
    """Succeeds if the ontology knows that this person prefers one of the things that fit.

    Reads request.options; writes request.object.
    """

    source = Source.ONTOLOGY

    def update(self) -> Status:
        """Look for a favourite."""
        favourites = self.context.knowledge.preferred(self.situation.request.options)
        if len(favourites) != 1:
            return self.fail(f"{len(favourites) or 'none'} of them is a favourite")
        self.situation.request.object = favourites[0]
        return self.succeed(favourites[0])


class GuessName(Step):
    """Succeeds if one known name is in the words, or is so near that they may be a slip of it.

    If several are, the person has to choose: the robot does one thing at a time.
    Reads request.command; writes request.guess, or request.options and request.several.
    """

    def update(self) -> Status:
        """Look for known names."""
        assert self.situation.request.command
        target = self.situation.request.command.target
        if self.situation.request.options:
            return self.fail(f"'{target}' is known")
        knowledge = self.context.knowledge
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
