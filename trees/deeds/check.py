"""Check whether a thing is there: go there, look, come back, and tell."""

from executive.situation import Situation
from executive.types.commands import CommandKind
from trees.context import MissionContext
from trees.deeds.answer import Answer
from trees.survey import found_where, not_seen, nothing_there


class CheckWhether(Answer):
    """As in "Is there any fruit in the kitchen?", "Is the mug on the sofa?"."""

    kind = CommandKind.CHECK

    def is_enough(self, situation: Situation) -> bool:
        """True as soon as one such thing was seen."""
        return bool(situation.survey.found)

    def agrees(self, named: set[str], there: set[str]) -> bool:
        """One thing is enough for a yes."""
        return bool(named) == bool(there)

    def answer(self, context: MissionContext) -> tuple[str, str]:
        """Yes with what was seen; a "no" only if all was seen."""
        if found := context.situation.survey.found:
            return f"Yes: {found_where(found, context.say)}.", ""
        none, unseen = nothing_there(context), not_seen(context)
        return (f"{none}." if unseen else f"No, {none}."), unseen
