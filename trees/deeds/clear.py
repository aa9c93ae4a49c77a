"""Clear furniture: see what is on it, and put each thing where it belongs, or where it was said."""

from collections.abc import Iterable, Sequence
from dataclasses import replace

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from executive.language.phrases import is_plural
from executive.language.wording import listed
from executive.types.commands import CommandKind
from executive.types.dialogue import Question, QuestionKind
from executive.types.outcome import Outcome, TaskOutcome
from trees.asking import Ask
from trees.context import MissionContext
from trees.deeds.deed import Conclude, Deed, asked_to
from trees.nodes import Check, Step, fallback, sequence
from trees.place_words import chosen_of, may_be, may_be_several, places_in
from trees.places import destination_of_all
from trees.survey import not_seen, nothing_there, survey
from trees.telling import tell


class Clear(Deed):
    """As in "Clear the coffee table"."""

    kind = CommandKind.CLEAR
    did = "cleared away"

    def ways(self, context: MissionContext) -> Iterable[Behaviour]:
        """See what is there, and make a task of each thing."""
        yield sequence(
            "clear",
            asked_to(context, self.kind),
            fallback(
                "which place",
                Check("it is clear which", context, lambda: not which_to_clear(context)),
                AskWhichToClear("ask which", context),
            ),
            destination_of_all(context),
            survey(context),
            fallback(
                "clear it",
                PutEachAway("each thing away", context),
                sequence(
                    "clear already", NothingThere("is clear", context), Conclude("done", context)
                ),
            ),
        )

    def is_true(self, outcome: Outcome | TaskOutcome, whereabouts: str) -> bool:
        """Always: whether each thing was put away is checked for the parts."""
        return True


def which_to_clear(context: MissionContext) -> tuple[str, ...]:
    """The places that the words may mean, if they mean one and it is not clear which; else none."""
    command = context.situation.request.asked_for
    one = not is_plural(command.source) and may_be_several(context, command.source)
    return places_in(context, command.source) if one else ()


class AskWhichToClear(Ask):
    """Asks which of several places of that name is meant.

    Reads and writes request.command.
    """

    def question(self) -> Question:
        """Offer the places."""
        options = which_to_clear(self.context)
        said = self.context.as_said(self._words())
        text = f"Which {said} do you mean: {self.context.say.any_of(options)}?"
        return Question(QuestionKind.WHERE_TO_GO, "", text, options)

    def understood(self, answer: str) -> bool:
        """Take any of the places that were offered."""
        request = self.situation.request
        chosen = chosen_of(self.context, answer, which_to_clear(self.context))
        if chosen:
            request.command = replace(request.asked_for, source=" or ".join(chosen))
        return bool(chosen)

    def unresolved(self) -> str:
        """It may be any of the places."""
        return may_be(self.context, self._words(), which_to_clear(self.context))

    def _words(self) -> str:
        return self.situation.request.asked_for.source


class PutEachAway(Step):
    """Succeeds if there are things; makes a task to put each where it was said, or usually is.

    Reads request.command and survey.seen; writes agenda.wholes and agenda.tasks.
    """

    def update(self) -> Status:
        """Make the tasks; things without another usual place all go to one spare place."""
        command, found = self.situation.request.asked_for, self.situation.survey.found
        if not found:
            return self.fail(nothing_there(self.context))
        parts = []
        goals = {name: command.goal or " or ".join(self._usual(name)) for name in found}
        spare = "" if all(goals.values()) else self._spare([n for n in found if not goals[n]])
        for name, here in found.items():
            goal = goals[name] or spare
            part = replace(command, kind=CommandKind.PUT, target=name, source=here, goal=goal)
            parts.append(replace(part, exceptions=(), purpose="", number=0))
        wanted = command.number if command.number > 0 else len(parts)
        unseen = "" if wanted < len(parts) else not_seen(self.context)
        self.situation.agenda.split(command, parts, min(wanted, len(parts)), unseen)
        return self.succeed(", ".join(found))

    def _usual(self, name: str) -> list[str]:
        """The usual places of a thing, without the furniture that is being cleared."""
        seen = self.situation.survey.seen
        return [p for p in self.context.knowledge.usual_places(name) if p not in seen]

    def _spare(self, names: Sequence[str]) -> str:
        """Choose a place for things that belong nowhere, and tell it; empty if there is none.

        It is in the same room if possible.
        """
        say, seen = self.context.say, self.situation.survey.seen
        rooms = {place.name: place.room for place in self.context.knowledge.places()}
        here = {rooms.get(place) for place in seen}
        others = [place for place in self.context.handiest if place not in seen]
        spare = min(others, key=lambda place: rooms.get(place) not in here, default="")
        if spare:
            things = listed([say.the(name) for name in names])
            they = "them" if len(names) > 1 else say.it(names[0])
            verb = say.agree(names[0], "belongs", "belong") if len(names) == 1 else "belong"
            why = f"I know no other place where {things} {verb}"
            tell(self.context, f"{why}; I put {they} {say.at(spare)}.")
        return spare


class NothingThere(Step):
    """Succeeds if the furniture is clear already, and all of it was seen.

    Reads survey.seen and search.looks; writes ending.reason.
    """

    def update(self) -> Status:
        """Tell that it is clear."""
        if why := not_seen(self.context):
            return self.fail(f"{nothing_there(self.context)}; {why}")
        said = f"{nothing_there(self.context)}; it is clear."
        self.situation.ending.tell(said)
        tell(self.context, said)
        return self.succeed(said)
