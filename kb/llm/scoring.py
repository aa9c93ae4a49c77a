"""How likely each of some options is as the next words of a chat, and what like chats suggest."""

from functools import partial

import numpy as np

from executive.geometry import Floats
from executive.types import Message, RankRequest
from kb.llm.context import Context
from kb.llm.gguf import Checkpoint, Gguf
from kb.llm.kept import Kept
from kb.llm.precedents import likelihood_weight, log_expected, shares

SCORED_AT_ONCE = 63
"""Options that are scored side by side."""

Chat = tuple[Message, ...]


class Scorer:
    """Scores options. Belongs to one thread.

    What all chats begin with stays in the KV cache. What was worked out once is remembered, and
    kept for other processes: likelihoods, those of the neutral chat above all, and states, which
    each thing has that is asked for or is a precedent.
    """

    def __init__(
        self, model: Gguf, n_ctx: int, threads: int | None = None, kept: Kept | None = None
    ) -> None:
        """Score with this model, in chats of at most `n_ctx` tokens.

        What others worked out is looked for in what was `kept`; the context is made for what is
        not there.
        """
        self._model = model
        self._opened: Context | None = None
        self._open = partial(
            Context, model, n_ctx, sequences=1 + SCORED_AT_ONCE, threads=threads, kept=kept
        )
        self._kept = kept
        self._lengths: dict[Chat, int] = {}
        """How many tokens each chat is that was read."""
        self._states: dict[Chat, Floats] = {}
        """The model's state where the next turn of each begins."""
        self._likelihoods: dict[tuple[Chat, tuple[str, ...]], Floats] = {}

    @property
    def evaluated(self) -> int:
        """Tokens that were evaluated so far."""
        return self._opened.evaluated if self._opened else 0

    def score(self, request: RankRequest, checkpoint: Checkpoint) -> Floats:
        """(options,) the logarithm of how likely each option is, up to a constant.

        Raises:
            ModelError: if a chat is too long, or an option is empty or too long, or if there is not
                enough memory.
        """
        self.prepare(request, checkpoint)
        likelihoods = self._likelihood(request.messages, request.options, checkpoint)
        if request.neutral:
            neutral = self._likelihood(request.neutral, request.options, checkpoint)
            likelihoods = likelihoods - neutral
        scores = likelihood_weight(len(request.precedents)) * likelihoods
        if known := request.precedents:
            chats = [request.messages, *(precedent.messages for precedent in known)]
            states = np.stack([self._state(chat, checkpoint) for chat in chats])
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
            self._state(precedent.messages, checkpoint)

    def tokens(self, request: RankRequest) -> int:
        """How many there are in all chats and options of a request, which has been scored."""
        compared = [chat for chat in (request.messages, request.neutral) if chat]
        chats = (*compared, *(precedent.messages for precedent in request.precedents))
        options = sum(len(self._model.tokenize(option)) for option in request.options)
        return sum(self._lengths[chat] for chat in chats) + options * len(compared)

    def close(self) -> None:
        """Free the memory."""
        if self._opened:
            self._opened.close()

    @property
    def _context(self) -> Context:
        self._opened = self._opened or self._open()
        return self._opened

    def _likelihood(self, chat: Chat, options: tuple[str, ...], checkpoint: Checkpoint) -> Floats:
        """(options,) log P(option | chat), which is kept."""
        if (chat, options) not in self._likelihoods:
            known = self._recall(len(options), "likelihoods", chat, options)
            if known is None:
                self._evaluate(chat, checkpoint)
                answers = [self._model.tokenize(option) for option in options]
                known = self._context.continuations(answers, checkpoint)
                self._remember(known, "likelihoods", chat, options)
            self._likelihoods[chat, options] = known
        return self._likelihoods[chat, options]

    def _state(self, chat: Chat, checkpoint: Checkpoint) -> Floats:
        """What the model makes of a chat, which is kept."""
        if chat not in self._states:
            known = self._recall(self._model.width, "state", chat)
            if known is None:
                self._evaluate(chat, checkpoint)
            else:
                self._states[chat] = known
        return self._states[chat]

    def _recall(self, count: int, what: str, chat: Chat, *about: object) -> Floats | None:
        """So many numbers about a chat, if they are kept: with them is how long it is."""
        known = self._kept.numbers(1 + count, what, chat, *about) if self._kept else None
        if known is None:
            return None
        self._lengths[chat] = int(known[0])
        return known[1:]

    def _remember(self, numbers: Floats, what: str, chat: Chat, *about: object) -> None:
        if self._kept:
            self._kept.put_numbers((self._lengths[chat], *numbers), what, chat, *about)

    def _evaluate(self, chat: Chat, checkpoint: Checkpoint) -> None:
        """Make it what the context has read; all but its last turn is shared with others."""
        tokens, head = self._model.prompt(chat, (*chat[:-1], Message("user", "")))
        self._context.read(tokens, head, checkpoint)
        self._lengths[chat], self._states[chat] = len(tokens), self._context.state()
        self._remember(self._states[chat], "state", chat)
