"""Scores options as the next words of a chat: by likelihood, and by precedents."""

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from executive.geometry import Floats
from executive.types.llm import Message, RankRequest
from kb.llm.kept import Kept
from kb.llm.precedents import likelihood_weight, log_expected, shares

if TYPE_CHECKING:  # llama.cpp is loaded with them
    from kb.llm.gguf import Checkpoint
    from kb.llm.loaded import Loaded

Chat = tuple[Message, ...]


class Scorer:
    """Scores options. Belongs to one thread.

    The common beginning of all chats stays in the KV cache. Likelihoods (above all those of the
    neutral chat) and hidden states (one for each thing asked about or given as a precedent) are
    remembered, and kept for other processes.
    """

    def __init__(self, load: "Callable[[], Loaded]", kept: Kept | None = None) -> None:
        """Score with the model's context for scoring.

        Results in `kept` are reused; the model is loaded only for what is missing there.
        """
        self._load = load
        self._kept = kept
        self._lengths: dict[Chat, int] = {}
        """Number of tokens of each chat that was read."""
        self._options: dict[tuple[str, ...], int] = {}
        """Total number of tokens of these options."""
        self._states: dict[Chat, Floats] = {}
        """The hidden state at the end of each chat, where the next turn begins."""
        self._likelihoods: dict[tuple[Chat, tuple[str, ...]], Floats] = {}

    def score(self, request: RankRequest, checkpoint: "Checkpoint") -> Floats:
        """(options,) log-probability of each option, up to a constant.

        Raises:
            ModelError: if a chat is too long, an option is empty or too long, or memory is
                insufficient.
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

    def prepare(self, request: RankRequest, checkpoint: "Checkpoint") -> None:
        """Compute what other requests share with this one: all but the chat about its own thing.

        Raises:
            ModelError: as `score` does.
        """
        if request.neutral:
            self._likelihood(request.neutral, request.options, checkpoint)
        for precedent in request.precedents:
            self._state(precedent.messages, checkpoint)

    def tokens(self, request: RankRequest) -> int:
        """Total number of tokens of the chats and options of a request that was scored."""
        compared = [chat for chat in (request.messages, request.neutral) if chat]
        chats = (*compared, *(precedent.messages for precedent in request.precedents))
        options = self._options[request.options] * len(compared)
        return sum(self._lengths[chat] for chat in chats) + options

    def _likelihood(self, chat: Chat, options: tuple[str, ...], checkpoint: "Checkpoint") -> Floats:
        """(options,) log P(option | chat); cached."""
        if (chat, options) not in self._likelihoods:
            known = self._recall(2 + len(options), "likelihoods", chat, options)
            if known is None:
                self._evaluate(chat, checkpoint)
                loaded = self._load()
                answers = [loaded.model.tokenize(option) for option in options]
                scores = loaded.scoring.continuations(answers, checkpoint)
                known = np.array([self._lengths[chat], sum(map(len, answers)), *scores])
                self._remember(known, "likelihoods", chat, options)
            self._lengths[chat], self._options[options] = int(known[0]), int(known[1])
            self._likelihoods[chat, options] = known[2:]
        return self._likelihoods[chat, options]

    def _state(self, chat: Chat, checkpoint: "Checkpoint") -> Floats:
        """(width,) hidden state at the end of a chat; cached."""
        if chat not in self._states:
            known = self._recall(None, "state", chat)
            if known is None:
                self._evaluate(chat, checkpoint)
            else:
                self._lengths[chat], self._states[chat] = int(known[0]), known[1:]
        return self._states[chat]

    def _recall(self, count: int | None, *about: object) -> Floats | None:
        """Kept numbers (`count`; None: any number): the length of the chat, then the result."""
        return self._kept.numbers(count, *about) if self._kept else None

    def _remember(self, numbers: Floats, *about: object) -> None:
        if self._kept:
            self._kept.put_numbers(numbers, *about)

    def _evaluate(self, chat: Chat, checkpoint: "Checkpoint") -> None:
        """Read the chat into the context; all but its last turn is shared with other chats."""
        loaded = self._load()
        tokens, head = loaded.model.prompt(chat, (*chat[:-1], Message("user", "")))
        loaded.scoring.read(tokens, head, checkpoint)
        self._lengths[chat], self._states[chat] = len(tokens), loaded.scoring.state()
        told = np.array([self._lengths[chat], *self._states[chat]])
        self._remember(told, "state", chat)
