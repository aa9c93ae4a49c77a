"""What the questions that are answered by looking have in common: look, come back, answer.

If there is more to do, the robot tells the answer on the way.
"""

from abc import abstractmethod
from collections.abc import Callable, Iterable

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from executive.situation import Situation
from executive.types.outcome import Outcome, TaskOutcome
from trees.context import MissionContext
from trees.deeds.deed import Conclude, Deed, asked_to
from trees.driving import back_to_the_person
from trees.nodes import Check, Step, fallback, sequence
from trees.survey import survey
from trees.telling import tell


class Answer(Deed):
    """A question about what is somewhere. Tells only what was seen, and what could not be seen."""

    def ways(self, context: MissionContext) -> Iterable[Behaviour]:
        """One way: look at the places, come back, tell. Nothing is touched."""
        yield sequence(
            str(self.kind),
            asked_to(context, self.kind),
            survey(context, lambda: self.is_enough(context.situation)),
            fallback(
                "to the person",
                Check("there is more to do", context, lambda: context.situation.agenda.goes_on),
                back_to_the_person(context),
                NotBack("not back", context, self.answer),
            ),
            Tell("answer", context, self.answer),
            Conclude("done", context),
        )

    def is_enough(self, situation: Situation) -> bool:
        """Whether the answer is certain before all places were looked at."""
        return False

    def is_true(self, outcome: Outcome | TaskOutcome, whereabouts: str) -> bool:
        """Never: the place of one thing cannot decide it; see `is_true_of`."""
        return False

    def is_true_of(self, outcome: Outcome | TaskOutcome, where: Callable[[str], str]) -> bool:
        """True if each named thing is where the robot looked, and the answer fits what is there."""
        if isinstance(outcome, Outcome):
            [outcome] = outcome.tasks
        there = {name for name in outcome.among if where(name) in outcome.visited}
        named = set(outcome.things)
        return self.agrees(named, there) and all(where(name) in outcome.visited for name in named)

    def agrees(self, named: set[str], there: set[str]) -> bool:
        """Whether the things that the robot named are the right answer for those that are there."""
        return not there - named

    @abstractmethod
    def answer(self, context: MissionContext) -> tuple[str, str]:
        """What was seen as a sentence, and why this is no sure answer; empty if it is one."""


class Tell(Step):
    """Tells the answer; fails if there is none, or if it may be wrong because not all was seen.

    Reads survey.seen and search.looks; writes ending.reason.
    """

    def __init__(
        self,
        name: str,
        context: MissionContext,
        answer: Callable[[MissionContext], tuple[str, str]],
    ) -> None:
        """`answer` makes the sentence from what was seen, as `Answer.answer` does."""
        super().__init__(name, context)
        self._answer = answer

    def update(self) -> Status:
        """Tell the answer; if it is incomplete, fail with what was seen as the reason."""
        said, why_not = self._answer(self.context)
        if why_not:
            return self.fail(f"{said.rstrip('.')}; {why_not}")
        self.situation.ending.tell(said)
        tell(self.context, said)
        return self.succeed(said)


class NotBack(Tell):
    """Tells what was seen although the robot could not come back; always fails."""

    def update(self) -> Status:
        """Give the answer as the reason: the person wants to know it, wherever the robot is."""
        said, why_not = self._answer(self.context)
        seen = "; ".join(filter(None, (said.rstrip("."), why_not)))
        return self.fail(f"{seen}, but {self.why_before()}")
