"""Ablations of the executive: less a part of what is built around the model, or with one spoilt."""

from collections.abc import Callable
from dataclasses import replace

from executive.app.parts import Change, Parts, advised, guarded_model
from executive.interfaces.llm import Advice, LanguageModel
from executive.plan import EXACT
from executive.types.knowledge import Candidate, Verdict
from executive.types.llm import ChatRequest, Message, RankRequest
from executive.types.results import Scored
from kb.advice.lister import Lister
from kb.advice.ranker import Ranker
from kb.advice.reader import Reader
from kb.advice.verification import Reply
from kb.ontology.names import unique

WITHOUT_A_HOME = f"""\
You help a robot that fetches things in a home. It tells you what it is after, and you tell it \
where that thing is kept, using everyday common sense. Answer with one JSON object and nothing \
else. It has to follow this JSON schema: {Reply.model_json_schema()}"""
"""What a model is told that knows nothing of the home."""
MOST_NAMES = 5
"""As many as the prompt asks for."""
TOO_SURE = 8.0
"""So many times as large are the scores, before they become probabilities."""


class Reworded:
    """A language model that is asked in other words: implements `LanguageModel` around one."""

    def __init__(self, model: LanguageModel, reword: Callable[[ChatRequest], ChatRequest]) -> None:
        """Reword what it is asked to write."""
        self._model = model
        self._reword = reword
        self.name = model.name
        self.context_tokens = model.context_tokens
        self.can_rank = model.can_rank

    def chat(self, request: ChatRequest) -> int:
        """Ask in other words, if it is about places."""
        about_places = request.label != "command"
        return self._model.chat(self._reword(request) if about_places else request)

    def rank(self, request: RankRequest) -> int:
        """Ask as it is."""
        return self._model.rank(request)

    def prepare(self, request: ChatRequest | RankRequest) -> None:
        """Prepare what will be asked as it is."""
        if isinstance(request, RankRequest):
            self._model.prepare(request)

    def cancel(self, request: int) -> None:
        """Call it off."""
        self._model.cancel(request)

    def count_tokens(self, text: str) -> int:
        """By the model's tokenizer."""
        return self._model.count_tokens(text)

    def close(self) -> None:
        """Free the model."""
        self._model.close()


def any_names(request: ChatRequest) -> ChatRequest:
    """Hold the reply to its form, but not to the names that exist."""
    schema = Reply.model_json_schema()
    schema["properties"]["places"] |= {"minItems": 1, "maxItems": MOST_NAMES}
    return replace(request, schema=schema)


def no_home(request: ChatRequest) -> ChatRequest:
    """Tell the model nothing of the home."""
    told = [message for message in request.messages if message.role != "system"]
    return replace(any_names(request), messages=(Message("system", WITHOUT_A_HOME), *told))


class Unverified(Lister):
    """Takes every name for a place."""

    def verify(self, names: tuple[str, ...], among: tuple[str, ...]) -> Verdict:
        """Let all pass."""
        return Verdict(unique(names))


def reworded(reword: Callable[[ChatRequest], ChatRequest]) -> Change:
    """Asks the model in other words."""

    def change(parts: Parts) -> Parts:
        model = Reworded(parts.model, reword) if parts.model else None
        return advised(replace(parts, model=model))

    return change


def unverified(parts: Parts) -> Parts:
    """With advice that makes no existence check."""
    if parts.model is None:
        return parts
    settings = parts.settings
    lister = Unverified(
        parts.knowledge,
        guarded_model(parts, parts.model),
        remembers=settings.remembers,
        top=settings.top,
        prompts=parts.prompts,
    )
    reader = Reader(parts.knowledge, prompts=parts.prompts)
    advice = Advice(lister, Ranker(parts.knowledge, prompts=parts.prompts), reader)
    return replace(parts, advice=advice)


class TooSure(Ranker):
    """Ranks as ever, but believes its own word far too much."""

    def ranked(self, scored: Scored) -> tuple[Candidate, ...]:
        """The same order, and nearly all of the probability to the first."""
        scores = tuple(TOO_SURE * score for score in scored.scores)
        return super().ranked(replace(scored, scores=scores))


def too_sure(parts: Parts) -> Parts:
    """A fault put in by hand."""
    if parts.advice is None:
        return parts
    ranker = TooSure(parts.knowledge, prompts=parts.prompts, facts=parts.facts)
    return replace(parts, advice=replace(parts.advice, ranker=ranker))


def exactly(parts: Parts) -> Parts:
    """Planned among so many places, the likeliest, that the best of all plans is found."""
    return replace(parts, parameters=replace(parts.parameters, planned=EXACT))
