"""The language model as one who reads commands that the grammar cannot."""

from executive.types import ChatRequest, CommandKind, RankRequest, Scored
from kb.advice import commands
from kb.advice.prompts import Prompts
from kb.ontology.ontology import Ontology


class Reader:
    """Implements `CommandReader`."""

    def __init__(self, ontology: Ontology, *, prompts: Prompts | None = None) -> None:
        """Let through only the objects of the ontology; `prompts` None: those of prompts.toml."""
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
        return commands.chat_request(words, self._ontology.objects(), self._texts)

    def read(self, reply: str) -> tuple[CommandKind, str] | None:
        """Kind and object of the reply, if it has the format and the object exists."""
        asked = commands.read(reply)
        named = self._ontology.objects_named(asked.object) if asked else ()
        return (asked.kind, named[0]) if asked and len(named) == 1 else None
