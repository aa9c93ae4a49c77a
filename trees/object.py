"""Which thing is meant? The ontology says, or whose home it is, else the person is asked.

The language model never is: which fruit someone likes is a matter of that person, not of general
knowledge (paper, section "Integrated use of ontological knowledge base and LLM").
"""

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from trees.nodes import Step, fallback
from trees.person import AskWhichObject
from trees.team import Team


def resolve_object(team: Team) -> Behaviour:
    """Words for a thing -> `situation.object`."""
    return fallback(
        "which object",
        OntologyKnowsObject("ontology knows it", team),
        PersonPrefersOne("the person prefers one", team),
        AskWhichObject("ask which object", team),
    )


class OntologyKnowsObject(Step):
    """Succeeds if the words name exactly one known object."""

    def update(self) -> Status:
        """Look the words up."""
        assert self.situation.command
        target = self.situation.command.target
        named = self.team.knowledge.objects_named(target)
        if len(named) == 1:
            self.situation.object = named[0]
            return self.succeed(named[0])
        self.situation.options = named
        return self.fail(f"'{target}' names {len(named) or 'no'} known objects")


class PersonPrefersOne(Step):
    """Succeeds if the ontology knows that this person prefers one of the things that fit."""

    def update(self) -> Status:
        """Look for a favourite."""
        favourites = self.team.knowledge.preferred(self.situation.options)
        if len(favourites) != 1:
            return self.fail(f"{len(favourites) or 'none'} of them is a favourite")
        self.situation.object = favourites[0]
        return self.succeed(favourites[0])
