"""A GGUF file in llama.cpp: its vocabulary, its chat template, and contexts to evaluate tokens in.

A thin layer over the C functions of llama-cpp-python. Its own `Llama` class keeps one sequence of
tokens only, while scoring continues one prompt in many ways at once.
"""

import ctypes
import operator
import os
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from itertools import pairwise, takewhile
from pathlib import Path
from typing import Any

import llama_cpp
import numpy as np
from llama_cpp.llama_chat_format import Jinja2ChatFormatter
from numpy.typing import NDArray

from executive.errors import ModelError
from executive.types import Message

MAGIC = b"GGUF"
BATCH_TOKENS = 128
"""Tokens evaluated at a time: between two batches the caller may stop."""
TAIL_TOKENS = 32
"""The same for what is likely to differ from prompt to prompt."""
WHOLE = (-1, -1)
"""All positions of a sequence."""

Tokens = list[int]
Checkpoint = Callable[[], None]
"""Called between steps; raises to stop the work."""

_complaints: deque[str] = deque(maxlen=1)


@llama_cpp.llama_log_callback  # type: ignore[untyped-decorator]
def _keep_complaints(level: int, text: bytes, user_data: ctypes.c_void_p) -> None:
    """Keep llama.cpp from writing to stderr, but remember its last error (level 4)."""
    if level == 4 and text.strip():
        _complaints.append(text.decode(errors="replace").strip())


def check_file(path: Path) -> None:
    """See whether this can be a model file.

    Raises:
        ModelError: if it is missing or is no GGUF file.
    """
    try:
        with path.open("rb") as file:
            begins = file.read(len(MAGIC))
    except OSError as error:
        raise ModelError(f"model {path} cannot be read: {error.strerror}") from None
    if begins != MAGIC:
        raise ModelError(f"model {path} is no GGUF file: it does not begin with the letters GGUF")


class Gguf:
    """The weights and the vocabulary. Tokenizing is safe from any thread."""

    def __init__(self, path: Path, gpu_layers: int = 0) -> None:
        """Load the file; blocks.

        Raises:
            ModelError: if llama.cpp cannot load it, or the model is not made for chats.
        """
        check_file(path)
        llama_cpp.llama_log_set(_keep_complaints, ctypes.c_void_p(0))
        llama_cpp.llama_backend_init()
        params = llama_cpp.llama_model_default_params()
        params.n_gpu_layers = gpu_layers
        self.pointer: Any = llama_cpp.llama_model_load_from_file(str(path).encode(), params)
        if not self.pointer:
            raise ModelError(f"model {path} cannot be loaded: {_last_complaint()}")
        self.vocabulary: Any = llama_cpp.llama_model_get_vocab(self.pointer)
        self.vocabulary_size = llama_cpp.llama_vocab_n_tokens(self.vocabulary)
        self._template = self._chat_template(path)

    def tokenize(self, text: str, *, special: bool = False) -> Tokens:
        """The text's tokens; `special` if markup such as `<|im_start|>` stands for its token."""
        raw = text.encode()
        tokens = (llama_cpp.llama_token * (len(raw) + 1))()
        count = llama_cpp.llama_tokenize(
            self.vocabulary, raw, len(raw), tokens, len(tokens), False, special
        )
        return list(tokens[:count])

    def prompt(self, messages: Sequence[Message], constant: int = 0) -> tuple[Tokens, int]:
        """A chat as the model was taught to read it, up to where its next turn begins.

        Returns:
            The tokens, and how many of them every chat has that begins with the same `constant`
            messages.

        Raises:
            ModelError: if the model's template refuses it (some know no system turn).
        """
        tokens = self._chat(messages)
        if not constant:
            return tokens, 0
        other = self._chat((*messages[:constant], Message("user", "")))
        head = sum(takewhile(bool, map(operator.eq, tokens[:-1], other)))
        return tokens, head

    def piece(self, token: int) -> bytes:
        """The bytes that a token stands for; a character may be parted over several."""
        buffer = ctypes.create_string_buffer(256)
        length = llama_cpp.llama_token_to_piece(
            self.vocabulary, token, buffer, len(buffer), 0, False
        )
        return buffer.raw[: max(0, length)]

    def ends(self, token: int) -> bool:
        """Whether this token ends a turn."""
        return bool(llama_cpp.llama_vocab_is_eog(self.vocabulary, token))

    def close(self) -> None:
        """Free the weights; contexts have to be closed before."""
        llama_cpp.llama_model_free(self.pointer)

    def _chat(self, messages: Sequence[Message]) -> Tokens:
        turns: Any = [{"role": m.role, "content": m.content} for m in messages]
        try:
            return self.tokenize(self._template(messages=turns).prompt, special=True)
        except ValueError as error:
            raise ModelError(f"the model's chat template refuses the prompt: {error}") from None

    def _chat_template(self, path: Path) -> Jinja2ChatFormatter:
        buffer = ctypes.create_string_buffer(1 << 16)
        length = llama_cpp.llama_model_meta_val_str(
            self.pointer, b"tokenizer.chat_template", buffer, len(buffer)
        )
        if length < 0:
            raise ModelError(f"model {path} has no chat template: take an instruction-tuned model")
        bos, eos = (
            self.piece_of_special(end(self.vocabulary))
            for end in (llama_cpp.llama_vocab_bos, llama_cpp.llama_vocab_eos)
        )
        return Jinja2ChatFormatter(buffer.value.decode(), eos_token=eos, bos_token=bos)

    def piece_of_special(self, token: int) -> str:
        """The markup of a special token; empty if the model has no such token (-1)."""
        if token < 0:
            return ""
        return str(llama_cpp.llama_vocab_get_text(self.vocabulary, token).decode())


class Context:
    """What the model has read: sequence 0 and its KV cache, and room for others beside it.

    Belongs to one thread.
    """

    def __init__(
        self, model: Gguf, tokens: int, *, sequences: int = 1, threads: int | None = None
    ) -> None:
        """Room for so many tokens, and for so many sequences that share them.

        Without `threads` one token at a time is evaluated by half of the cores, whose other half
        would only wait for memory, and batches by all.

        Raises:
            ModelError: if there is not enough memory.
        """
        params = llama_cpp.llama_context_default_params()
        params.n_ctx = tokens
        params.n_batch = params.n_ubatch = BATCH_TOKENS
        params.n_seq_max = sequences
        params.kv_unified = True
        params.no_perf = True
        cores = os.cpu_count() or 1
        params.n_threads = threads or max(1, cores // 2)
        params.n_threads_batch = threads or cores
        self.pointer: Any = llama_cpp.llama_init_from_model(model.pointer, params)
        if not self.pointer:
            raise ModelError(f"no context of {tokens} tokens: {_last_complaint()}")
        self._memory: Any = llama_cpp.llama_get_memory(self.pointer)
        self._batch = llama_cpp.llama_batch_init(BATCH_TOKENS, 0, 1)
        self._vocabulary_size = model.vocabulary_size
        self._sequences = sequences
        self._batches: list[tuple[int, ...]] = []
        self._length = 0

    def read(self, tokens: Sequence[int], head: int, checkpoint: Checkpoint) -> int:
        """Make sequence 0 these tokens; the batches that it begins with already are kept.

        llama.cpp's numbers depend a little on how tokens are batched. The cuts made here depend on
        the tokens alone, not on what was read before: so a kept batch changes no result.

        Args:
            tokens: what to read, at least one token.
            head: how many of them later prompts will begin with, too: there is a cut.
            checkpoint: called before each batch.

        Returns:
            How many tokens were evaluated; the last batch always is.
        """
        cuts = (*range(0, head, BATCH_TOKENS), *range(head, len(tokens), TAIL_TOKENS), len(tokens))
        batches = [tuple(tokens[start:end]) for start, end in pairwise(cuts)]
        same = sum(takewhile(bool, map(operator.eq, self._batches, batches[:-1])))
        kept = sum(map(len, batches[:same]))
        if not llama_cpp.llama_memory_seq_rm(self._memory, 0, kept, -1):
            llama_cpp.llama_memory_clear(self._memory, True)
            same = kept = 0
        self._batches, self._length = batches[:same], kept
        for batch in batches[same:]:
            checkpoint()
            self.append(batch)
            self._batches.append(batch)
        return len(tokens) - kept

    def append(self, tokens: Sequence[int]) -> None:
        """Evaluate further tokens of sequence 0 (at most BATCH_TOKENS)."""
        rows = [(token, self._length + i, 0, False) for i, token in enumerate(tokens)]
        rows[-1] = (*rows[-1][:3], True)
        self._decode(rows)
        self._length += len(tokens)

    def continuations(
        self, options: Sequence[Sequence[int]], checkpoint: Checkpoint
    ) -> Iterator[float]:
        """Log P(option | sequence 0) of each option, many options to a batch.

        Has to follow `read`; sequence 0 stays as it is.

        Raises:
            ModelError: if an option is empty or longer than BATCH_TOKENS.
        """
        if not all(0 < len(option) <= BATCH_TOKENS for option in options):
            raise ModelError(f"an option has to be from 1 to {BATCH_TOKENS} tokens long")
        first = self.log_probabilities()
        for group in self._packed(options):
            checkpoint()
            rows = []
            for sequence, option in enumerate(group, start=1):
                llama_cpp.llama_memory_seq_cp(self._memory, 0, sequence, *WHOLE)
                rows += [
                    (token, self._length + i, sequence, True) for i, token in enumerate(option[:-1])
                ]
            if rows:
                self._decode(rows)
            row = 0
            for sequence, option in enumerate(group, start=1):
                score = first[option[0]]
                for token in option[1:]:
                    score += self.log_probabilities(row)[token]
                    row += 1
                llama_cpp.llama_memory_seq_rm(self._memory, sequence, *WHOLE)
                yield float(score)

    def log_probabilities(self, row: int = -1) -> NDArray[np.float64]:
        """(vocabulary,) log P(next token) after this row of the last batch; -1: after the last."""
        pointer = llama_cpp.llama_get_logits_ith(self.pointer, row)
        logits = np.ctypeslib.as_array(pointer, shape=(self._vocabulary_size,)).astype(np.float64)
        logits -= logits.max()
        log_probabilities: NDArray[np.float64] = logits - np.log(np.exp(logits).sum())
        return log_probabilities

    def close(self) -> None:
        """Free the memory."""
        llama_cpp.llama_batch_free(self._batch)
        llama_cpp.llama_free(self.pointer)

    def _packed(self, options: Sequence[Sequence[int]]) -> Iterator[list[Sequence[int]]]:
        """Options in their order, in groups that fit into one batch and into the sequences."""
        group: list[Sequence[int]] = []
        size = 0
        for option in options:
            if group and (size + len(option) > BATCH_TOKENS or len(group) == self._sequences - 1):
                yield group
                group, size = [], 0
            group.append(option)
            size += len(option)
        if group:
            yield group

    def _decode(self, rows: Sequence[tuple[int, int, int, bool]]) -> None:
        """Evaluate (token, position, sequence, whether its scores are wanted)."""
        batch = self._batch
        batch.n_tokens = len(rows)
        for i, (token, position, sequence, wanted) in enumerate(rows):
            batch.token[i] = token
            batch.pos[i] = position
            batch.n_seq_id[i] = 1
            batch.seq_id[i][0] = sequence
            batch.logits[i] = wanted
        if code := llama_cpp.llama_decode(self.pointer, batch):
            raise ModelError(f"llama.cpp could not evaluate (code {code}): {_last_complaint()}")


def _last_complaint() -> str:
    return _complaints.pop() if _complaints else "llama.cpp does not say why"
