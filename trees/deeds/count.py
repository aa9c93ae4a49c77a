"""Count things: go there, look at all of it, come back, and tell how many were seen."""

from executive.types.commands import CommandKind
from trees.context import MissionContext
from trees.deeds.answer import Answer
from trees.survey import found_where, not_seen, nothing_there


class Count(Answer):
    """As in "How many fruits are on the table?"."""

    kind = CommandKind.COUNT

    def answer(self, context: MissionContext) -> tuple[str, str]:
        """The number; it may be more if not all was seen."""
        found = context.situation.survey.found
        none = f"{nothing_there(context)}."
        counted = f"I count {len(found)}: {found_where(found, context.say)}." if found else none
        return counted, not_seen(context)
