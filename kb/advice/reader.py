"""Lets the language model read commands that the grammar cannot."""

from executive.types.commands import CommandKind
from executive.types.llm import ChatRequest, RankRequest
from executive.types.results import Scored
from kb.advice import commands
from kb.advice.commands import ME, Asked
from kb.advice.prompts import Prompts
from kb.ontology.names import unique
from kb.ontology.ontology import Ontology


class Reader:
    """Implements `CommandReader`."""

    def __init__(self, ontology: Ontology, *, prompts: Prompts | None = None) -> None:
        """Accept only names in the ontology; without `prompts`, use those in prompts.toml."""
        self._ontology = ontology
        self._texts = (prompts or Prompts.load()).understanding

    def ranking(self, words: str) -> RankRequest:
        """A request to score the kinds of command that the words may mean."""
        return commands.rank_request(words, self._texts)

    def ranked(self, scored: Scored) -> CommandKind:
        """The likeliest kind of command."""
        return commands.likeliest(scored)

    def inquiry(self, words: str) -> ChatRequest:
        """Prompt `command`: what do the words ask for?"""
        return commands.chat_request(words, self._things(), self._places(), self._texts)

    def read(self, reply: str) -> str:
        """The tasks of the reply as a plain sentence.

        Empty if there is none, or if one names something unknown.
        """
        known = [self._known(task) for task in commands.read(reply)]
        if None in known:
            return ""
        return ", then ".join(task.sentence for task in known if task)

    def _known(self, task: Asked) -> Asked | None:
        """The task with the ontology's names; None if one of its names is unknown."""
        thing = self._thing(task.object) if task.object else ""
        places = [self._place(name) if name else "" for name in (task.source, task.goal)]
        if thing is None or None in places:
            return None
        source, goal = places
        return task.model_copy(update={"object": thing, "source": source, "goal": goal})

    def _thing(self, words: str) -> str | None:
        named = self._ontology.objects_named(words)
        if len(named) == 1:
            return named[0]
        kinds = [kind for kind in self._ontology.names_in(words) if named]
        return kinds[0] if len(kinds) == 1 else None

    def _place(self, words: str) -> str | None:
        """The one piece of furniture or room that all these words name, or ME; None if none."""
        if words == ME:
            return ME
        reading = self._ontology.place_names.exactly(words)
        return next(iter((*reading.furniture, *reading.rooms)), None)

    def _things(self) -> tuple[str, ...]:
        """Objects, and the classes above them ("a fruit")."""
        objects = self._ontology.objects()
        return unique((*objects, *(c for name in objects for c in self._ontology.classes_of(name))))

    def _places(self) -> tuple[str, ...]:
        places = self._ontology.places()
        return unique((*(place.name for place in places), *(place.room for place in places)))
