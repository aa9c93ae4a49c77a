"""Count things: go there, look at all of it, come back, and tell how many were seen."""

from executive.situation import Situation
from executive.types import CommandKind
from trees.deeds.answer import Answer
from trees.survey import found_where, not_seen, nothing_there


class Count(Answer):
    """As in "How many fruits are on the table?"."""

    kind = CommandKind.COUNT

    def answer(self, situation: Situation) -> tuple[str, str]:
        """With what was not seen, it may be more."""
        found = situation.survey.found
        none = f"{nothing_there(situation)}."
        counted = f"I count {len(found)}: {found_where(found)}." if found else none
        return counted, not_seen(situation)
