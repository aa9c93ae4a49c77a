"""Which thing is meant? The ontology says, else the person: the language model is never asked.

Which fruit someone likes is a matter of that person, not of general knowledge (paper, section
"Integrated use of ontological knowledge base and LLM").
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
