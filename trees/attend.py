"""At each tick, before anything else: hears the person, and tells news from the body."""

from py_trees.behaviour import Behaviour
from py_trees.common import Status
from py_trees.decorators import SuccessIsFailure

from executive.records import Utterance
from trees.attention import attend_to
from trees.context import MissionContext
from trees.nodes import Action, Step
from trees.telling import in_one_sentence, tell


def hear_first(context: MissionContext) -> Behaviour:
    """Hear the person, then fail, so that the fallback (whose first child this is) goes on."""
    return SuccessIsFailure("and go on", Attend("hear", context))


class Attend(Step):
    """Answers what was said, and tells what the body has reported; always succeeds.

    Reads dialogue.heard and dialogue.news; writes agenda.
    """

    source = "person"

    def update(self) -> Status:
        """Tell the news, then answer each utterance."""
        heard, news = self.situation.dialogue.heard, self.situation.dialogue.news
        while news:
            tell(self.context, news.pop(0))
        while heard:
            words = heard.pop(0)
            self.context.recorder.record(Utterance("person", words))
            tell(self.context, attend_to(self.context, words, self._doing()))
        return Status.SUCCESS

    def _doing(self) -> str:
        """What the robot is doing, as a sentence."""
        command = self.situation.agenda.whole_of(self.situation.request.command)
        if command is None:
            return "I think about what you said."
        root: Behaviour = self
        while root.parent:
            root = root.parent
        nodes = (node for node in root.iterate() if isinstance(node, Action))
        now = " and ".join(filter(None, (node.doing() for node in nodes if node.is_under_way)))
        what = in_one_sentence(self.context, command)
        return f"I {now}, to {what}." if now else f"I am about to {what}."
