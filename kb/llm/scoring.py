"""How likely each of some options is as the next words of a chat, and what like chats suggest."""

from dataclasses import dataclass

import numpy as np

from executive.geometry import Floats
from executive.types import Message, RankRequest
from kb.llm.context import Context
from kb.llm.gguf import Checkpoint, Gguf
from kb.llm.precedents import likelihood_weight, log_expected, shares

SCORED_AT_ONCE = 63
"""Options that are scored side by side."""

Chat = tuple[Message, ...]


@dataclass(frozen=True, slots=True)
class _Read:
    """A chat that was read: its length, and the model's state where the next turn begins."""

    tokens: int
    state: Floats


class Scorer:
    """Scores options. Belongs to one thread.

    What all chats begin with stays in the KV cache. What was worked out once is remembered: the
    likelihoods of the neutral chat, above all, and the states about precedents.
    """

    def __init__(self, model: Gguf, n_ctx: int, threads: int | None = None) -> None:
        """Score with this model, in chats of at most `n_ctx` tokens.

        Raises:
            ModelError: if there is not enough memory.
        """
        self._model = model
        self._context = Context(model, n_ctx, sequences=1 + SCORED_AT_ONCE, threads=threads)
        self._chats: dict[Chat, _Read] = {}
        self._likelihoods: dict[tuple[Chat, tuple[str, ...]], Floats] = {}

    @property
    def evaluated(self) -> int:
        """Tokens that were evaluated so far."""
        return self._context.evaluated

    def score(self, request: RankRequest, checkpoint: Checkpoint) -> Floats:
        """(options,) the logarithm of how likely each option is, up to a constant.

        Raises:
            ModelError: if a chat is too long, or an option is empty or too long.
        """
        self.prepare(request, checkpoint)
        likelihoods = self._likelihood(request.messages, request.options, checkpoint)
        if request.neutral:
            likelihoods = likelihoods - self._likelihood(
                request.neutral, request.options, checkpoint
            )
        scores = likelihood_weight(len(request.precedents)) * likelihoods
        if known := request.precedents:
            chats = [request.messages, *(precedent.messages for precedent in known)]
            states = np.stack([self._read(chat, checkpoint).state for chat in chats])
            kinds = [request.kind, *(precedent.kind for precedent in known)]
            at = shares([precedent.places for precedent in known], request.places)
            scores += log_expected(states, kinds, at, request.place_kinds)
        return scores

    def prepare(self, request: RankRequest, checkpoint: Checkpoint) -> None:
        """Work out what other requests share with this one: all but what is about its own thing.

        Raises:
            ModelError: as `score` does.
        """
        if request.neutral:
            self._likelihood(request.neutral, request.options, checkpoint)
        for precedent in request.precedents:
            self._read(precedent.messages, checkpoint)

    def tokens(self, request: RankRequest) -> int:
        """How many there are in all chats and options of a request, which has been scored."""
        compared = [chat for chat in (request.messages, request.neutral) if chat]
        chats = (*compared, *(precedent.messages for precedent in request.precedents))
        options = sum(len(self._model.tokenize(option)) for option in request.options)
        return sum(self._chats[chat].tokens for chat in chats) + options * len(compared)

    def close(self) -> None:
        """Free the memory."""
        self._context.close()

    def _likelihood(self, chat: Chat, options: tuple[str, ...], checkpoint: Checkpoint) -> Floats:
        """(options,) log P(option | chat)."""
        if (chat, options) not in self._likelihoods:
            self._chats[chat] = self._evaluate(chat, checkpoint)
            answers = [self._model.tokenize(option) for option in options]
            self._likelihoods[chat, options] = self._context.continuations(answers, checkpoint)
        return self._likelihoods[chat, options]

    def _read(self, chat: Chat, checkpoint: Checkpoint) -> _Read:
        if chat not in self._chats:
            self._chats[chat] = self._evaluate(chat, checkpoint)
        return self._chats[chat]

    def _evaluate(self, chat: Chat, checkpoint: Checkpoint) -> _Read:
        """Make it what the context has read; all but its last turn is shared with others."""
        tokens, head = self._model.prompt(chat, (*chat[:-1], Message("user", "")))
        self._context.read(tokens, head, checkpoint)
        return _Read(len(tokens), self._context.state())
