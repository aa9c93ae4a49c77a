"""Ablations of the executive: variants without a part around the model, or with a spoilt one."""

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
"""The system prompt for a model that is told nothing about the home."""
MOST_NAMES = 5
"""The largest number of names, as in the prompt."""
TOO_SURE = 8.0
"""Factor for the scores before they become probabilities."""


class Reworded:
    """Implements `LanguageModel` around another one, and rewords the requests to it."""

    def __init__(self, model: LanguageModel, reword: Callable[[ChatRequest], ChatRequest]) -> None:
        """Reword the chat requests to `model`."""
        self._model = model
        self._reword = reword
        self.name = model.name
        self.context_tokens = model.context_tokens
        self.can_rank = model.can_rank

    def chat(self, request: ChatRequest) -> int:
        """Pass the request on, reworded if it is about places."""
        about_places = request.label != "command"
        return self._model.chat(self._reword(request) if about_places else request)

    def rank(self, request: RankRequest) -> int:
        """Pass the request on."""
        return self._model.rank(request)

    def prepare(self, request: ChatRequest | RankRequest) -> None:
        """Prepare for rankings only: chats about places are reworded."""
        if isinstance(request, RankRequest):
            self._model.prepare(request)

    def cancel(self, request: int) -> None:
        """Cancel the request."""
        self._model.cancel(request)

    def count_tokens(self, text: str) -> int:
        """Length of a text in tokens, by the model's tokenizer."""
        return self._model.count_tokens(text)

    def close(self) -> None:
        """Free the model."""
        self._model.close()


def any_names(request: ChatRequest) -> ChatRequest:
    """Restrict the reply to its form, but not to existing names."""
    schema = Reply.model_json_schema()
    schema["properties"]["places"] |= {"minItems": 1, "maxItems": MOST_NAMES}
    return replace(request, schema=schema)


def no_home(request: ChatRequest) -> ChatRequest:
    """Leave out what the prompt says about the home, and accept any names in the reply."""
    told = [message for message in request.messages if message.role != "system"]
    return replace(any_names(request), messages=(Message("system", WITHOUT_A_HOME), *told))


class Unverified(Lister):
    """A lister that accepts every name as a place."""

    def verify(self, names: tuple[str, ...], among: tuple[str, ...]) -> Verdict:
        """Accept all names."""
        return Verdict(unique(names))


def reworded(reword: Callable[[ChatRequest], ChatRequest]) -> Change:
    """A change that rewords the requests to the model."""

    def change(parts: Parts) -> Parts:
        model = Reworded(parts.model, reword) if parts.model else None
        return advised(replace(parts, model=model))

    return change


def unverified(parts: Parts) -> Parts:
    """Replace the advice by one without the existence check, if there is a model."""
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
    """A ranker with the usual order and far too high confidence."""

    def ranked(self, scored: Scored) -> tuple[Candidate, ...]:
        """The same order, with nearly all of the probability on the first place."""
        scores = tuple(TOO_SURE * score for score in scored.scores)
        return super().ranked(replace(scored, scores=scores))


def too_sure(parts: Parts) -> Parts:
    """Inject a fault: a ranker that is far too sure, if there is advice."""
    if parts.advice is None:
        return parts
    ranker = TooSure(parts.knowledge, prompts=parts.prompts, facts=parts.facts)
    return replace(parts, advice=replace(parts.advice, ranker=ranker))


def exactly(parts: Parts) -> Parts:
    """Plan among only so many places, the likeliest, that the plan is optimal."""
    return replace(parts, parameters=replace(parts.parameters, planned=EXACT))
