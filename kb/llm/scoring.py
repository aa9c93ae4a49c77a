"""How likely each of some options is as the next words of a chat, and what like chats suggest."""

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

    What all chats begin with stays in the KV cache. What was worked out once is remembered, and
    kept for other processes: likelihoods, those of the neutral chat above all, and states, which
    each thing has that is asked for or is a precedent.
    """

    def __init__(self, load: "Callable[[], Loaded]", kept: Kept | None = None) -> None:
        """Score with the model that is loaded, in its context for that.

        What others worked out is looked for in what was `kept`; the model is loaded for what is
        not there.
        """
        self._load = load
        self._kept = kept
        self._lengths: dict[Chat, int] = {}
        """How many tokens each chat is that was read."""
        self._options: dict[tuple[str, ...], int] = {}
        """How many tokens options are, all together."""
        self._states: dict[Chat, Floats] = {}
        """The model's state where the next turn of each begins."""
        self._likelihoods: dict[tuple[Chat, tuple[str, ...]], Floats] = {}

    def score(self, request: RankRequest, checkpoint: "Checkpoint") -> Floats:
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

    def prepare(self, request: RankRequest, checkpoint: "Checkpoint") -> None:
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
        options = self._options[request.options] * len(compared)
        return sum(self._lengths[chat] for chat in chats) + options

    def _likelihood(self, chat: Chat, options: tuple[str, ...], checkpoint: "Checkpoint") -> Floats:
        """(options,) log P(option | chat), which is kept."""
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
        """What the model makes of a chat, which is kept."""
        if chat not in self._states:
            known = self._recall(None, "state", chat)
            if known is None:
                self._evaluate(chat, checkpoint)
            else:
                self._lengths[chat], self._states[chat] = int(known[0]), known[1:]
        return self._states[chat]

    def _recall(self, count: int | None, *about: object) -> Floats | None:
        """Numbers that are kept, so many or however many: how long a chat is, and what of it."""
        return self._kept.numbers(count, *about) if self._kept else None

    def _remember(self, numbers: Floats, *about: object) -> None:
        if self._kept:
            self._kept.put_numbers(numbers, *about)

    def _evaluate(self, chat: Chat, checkpoint: "Checkpoint") -> None:
        """Make it what the context has read; all but its last turn is shared with others."""
        loaded = self._load()
        tokens, head = loaded.model.prompt(chat, (*chat[:-1], Message("user", "")))
        loaded.scoring.read(tokens, head, checkpoint)
        self._lengths[chat], self._states[chat] = len(tokens), loaded.scoring.state()
        told = np.array([self._lengths[chat], *self._states[chat]])
        self._remember(told, "state", chat)
