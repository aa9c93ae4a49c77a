"""The language model's three tasks: to list places, to rank them, to read commands."""

from executive.interfaces.knowledge import Facts
from executive.interfaces.llm import Advice, LanguageModel
from kb.advice.lister import Lister
from kb.advice.prompts import Prompts
from kb.advice.ranker import Ranker
from kb.advice.reader import Reader
from kb.ontology.ontology import Ontology


def advise(
    ontology: Ontology,
    model: LanguageModel,
    *,
    remembers: bool,
    top: int = 5,
    prompts: Prompts | None = None,
    facts: Facts | None = None,
) -> Advice:
    """Build all three from the same ontology and prompts; the arguments are described there."""
    prompts = prompts or Prompts.load()
    return Advice(
        Lister(ontology, model, remembers=remembers, top=top, prompts=prompts),
        Ranker(ontology, prompts=prompts, facts=facts),
        Reader(ontology, prompts=prompts),
    )
