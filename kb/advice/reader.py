"""The language model as one who reads commands that the grammar cannot."""

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
        """Let through only what the ontology has; `prompts` None: those of prompts.toml."""
        self._ontology = ontology
        self._texts = (prompts or Prompts.load()).understanding

    def ranking(self, words: str) -> RankRequest:
        """Score what the words may ask the robot to do."""
        return commands.rank_request(words, self._texts)

    def ranked(self, scored: Scored) -> CommandKind:
        """The likeliest of these kinds of command."""
        return commands.likeliest(scored)

    def inquiry(self, words: str) -> ChatRequest:
        """`command`: what do the words ask for?"""
        return commands.chat_request(words, self._things(), self._places(), self._texts)

    def read(self, reply: str) -> str:
        """The tasks of the reply as a plain sentence; empty if one names what does not exist."""
        known = [self._known(task) for task in commands.read(reply)]
        if None in known:
            return ""
        return ", then ".join(task.sentence for task in known if task)

    def _known(self, task: Asked) -> Asked | None:
        """The task with the names that the ontology has; None if it has not all of them."""
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
        """Furniture or a room by the words, if they are all of its name."""
        if words == ME:
            return ME
        reading = self._ontology.place_names.exactly(words)
        return next(iter((*reading.furniture, *reading.rooms)), None)

    def _things(self) -> tuple[str, ...]:
        """Objects, and the classes above them: "a fruit"."""
        objects = self._ontology.objects()
        return unique((*objects, *(c for name in objects for c in self._ontology.classes_of(name))))

    def _places(self) -> tuple[str, ...]:
        places = self._ontology.places()
        return unique((*(place.name for place in places), *(place.room for place in places)))
