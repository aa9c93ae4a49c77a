"""Who puts questions to the language model, in all three ways: what a mission takes along."""

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
    """The three over the same ontology and the same texts; see each for what is given."""
    prompts = prompts or Prompts.load()
    return Advice(
        Lister(ontology, model, remembers=remembers, top=top, prompts=prompts),
        Ranker(ontology, prompts=prompts, facts=facts),
        Reader(ontology, prompts=prompts),
    )
