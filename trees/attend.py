"""Hears what the person says unasked, at each tick before anything else."""

from py_trees.common import Status

from executive.records import Utterance
from trees.attention import attend_to
from trees.nodes import Action, Step
from trees.telling import in_one_sentence, tell


class Attend(Step):
    """Answers what was said; always fails, so that what is to be done is tried next.

    Reads dialogue.heard; writes agenda.
    """

    source = "person"

    def update(self) -> Status:
        """One after the other."""
        heard = self.situation.dialogue.heard
        while heard:
            words = heard.pop(0)
            self.context.recorder.record(Utterance("person", words))
            tell(self.context, attend_to(self.context, words, self._doing()))
        return Status.FAILURE

    def _doing(self) -> str:
        """What the robot is doing, as a sentence."""
        command = self.situation.agenda.whole_of(self.situation.request.command)
        if command is None:
            return "I think about what you said."
        assert self.parent
        nodes = (node for node in self.parent.iterate() if isinstance(node, Action))
        now = " and ".join(filter(None, (node.doing() for node in nodes if node.is_under_way)))
        what = in_one_sentence(self.context, command)
        return f"I {now}, to {what}." if now else f"I am about to {what}."
