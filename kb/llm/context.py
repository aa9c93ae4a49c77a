"""One llama.cpp context: tokens it has evaluated, and the probabilities of what may follow them."""

import ctypes
import operator
import os
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import chain, pairwise, takewhile
from typing import Any

import llama_cpp
import numpy as np
from numpy.typing import NDArray

from executive.errors import ModelError
from kb.llm.gguf import Checkpoint, Gguf, Tokens, last_complaint
from kb.llm.kept import Kept

BATCH_TOKENS = 128
"""Tokens in one batch; the work can be stopped between two batches."""
TAIL_TOKENS = 32
"""The same for the part of a prompt that usually differs from the one before."""
SMALLEST_WINDOW = 512
"""Tokens that memory is reserved for at first; it is doubled when more are needed."""
WHOLE = (-1, -1)
"""All positions of a sequence."""


class Context:
    """The KV cache: sequence 0 is the prompt and its reply; further ones are used for scoring.

    Belongs to one thread.
    """

    def __init__(
        self,
        model: Gguf,
        tokens: int,
        *,
        sequences: int = 1,
        threads: int | None = None,
        kept: Kept | None = None,
    ) -> None:
        """Create a context of at most `tokens` tokens, shared by `sequences` sequences.

        Memory grows as needed: the embedded model's cache takes 23 KiB for each token. The cache
        of a prompt's beginning is looked up in `kept`, and saved there. Without `threads`, single
        tokens are evaluated by half of the cores (more would only wait for memory), and batches by
        all cores.

        Raises:
            ModelError: if there is not enough memory.
        """
        self._model = model
        self._n_ctx = tokens
        self._sequences = sequences
        self._threads = threads
        self._kept = kept
        self._batch = llama_cpp.llama_batch_init(BATCH_TOKENS, 0, sequences)
        self.evaluated = 0
        """Tokens evaluated so far."""
        self._batches: list[tuple[int, ...]] = []
        self._length = 0
        self.pointer: Any = None
        self._open(min(tokens, SMALLEST_WINDOW))

    def _open(self, tokens: int) -> None:
        """Create the llama.cpp context, with memory for this many tokens."""
        params = llama_cpp.llama_context_default_params()
        params.n_ctx = tokens
        params.n_batch = params.n_ubatch = BATCH_TOKENS
        params.n_seq_max = self._sequences
        params.kv_unified = True
        params.no_perf = True
        params.pooling_type = llama_cpp.LLAMA_POOLING_TYPE_NONE
        cores = os.cpu_count() or 1
        params.n_threads = self._threads or max(1, cores // 2)
        params.n_threads_batch = self._threads or cores
        self.pointer = llama_cpp.llama_init_from_model(self._model.pointer, params)
        if not self.pointer:
            raise ModelError(f"no context of {tokens} tokens: {last_complaint()}")
        self._memory: Any = llama_cpp.llama_get_memory(self.pointer)
        self._window = tokens

    def read(self, tokens: Sequence[int], head: int, checkpoint: Checkpoint, more: int = 1) -> None:
        """Make these tokens sequence 0; equal batches at its beginning are not evaluated again.

        The last batch is always evaluated.

        llama.cpp's results depend slightly on the batches. These depend on the tokens alone, not on
        what was read before, so that a reused batch changes no result.

        Args:
            tokens: the tokens to read, at least one.
            head: how many of them later prompts begin with, too; a batch ends there.
            checkpoint: called before each batch.
            more: how many tokens may be appended later.

        Raises:
            ModelError: if the context window is too small for all of this.
        """
        reserve = BATCH_TOKENS if self._sequences > 1 else max(1, more)
        if len(tokens) + reserve > self._n_ctx:
            raise ModelError(
                f"the prompt takes {len(tokens)} tokens and needs room for {reserve} more, "
                f"but the context window has {self._n_ctx}"
            )
        self._make_room(len(tokens) + reserve)
        cuts = (*range(0, head, BATCH_TOKENS), *range(head, len(tokens), TAIL_TOKENS), len(tokens))
        batches = [tuple(tokens[start:end]) for start, end in pairwise(cuts)]
        begins = len(range(0, head, BATCH_TOKENS))
        if self._in_common(batches[:-1]) < begins < len(batches):
            self._recall(batches[:begins])
        same = self._in_common(batches[:-1])
        self._batches, self._length = batches[:same], sum(map(len, batches[:same]))
        if not llama_cpp.llama_memory_seq_rm(self._memory, 0, self._length, -1):
            self._forget()
        for batch in batches[len(self._batches) :]:
            checkpoint()
            last = len(self._batches) == len(batches) - 1
            self._append(batch, state=last and self._sequences > 1)
            self._batches.append(batch)
            if len(self._batches) == begins < len(batches):
                self._remember()

    def begin(self, head: Tokens, checkpoint: Checkpoint) -> None:
        """Evaluate the beginning of later prompts, unless sequence 0 begins with it already."""
        if [*chain(*self._batches)][: len(head)] == head:
            return
        cuts = (*range(0, len(head), BATCH_TOKENS), len(head))
        if not self._recall([tuple(head[start:end]) for start, end in pairwise(cuts)]):
            self.read(head, len(head), checkpoint)
            self._remember()

    def append(self, tokens: Sequence[int]) -> None:
        """Evaluate further tokens of sequence 0 (at most BATCH_TOKENS)."""
        self._append(tokens, state=False)

    def _append(self, tokens: Sequence[int], *, state: bool) -> None:
        """Append tokens; with `state`, their hidden states are computed, too: a fifth more work."""
        rows = [_Row(token, self._length + i) for i, token in enumerate(tokens)]
        rows[-1] = replace(rows[-1], wanted=True)
        llama_cpp.llama_set_embeddings(self.pointer, state)
        self._decode(rows)
        self._length += len(tokens)

    def continuations(
        self, options: Sequence[Tokens], checkpoint: Checkpoint
    ) -> NDArray[np.float64]:
        """(options,) log P(option | sequence 0), in batches; a common prefix is evaluated once.

        Call `read` first; sequence 0 is not changed.

        Raises:
            ModelError: if an option is empty or longer than BATCH_TOKENS.
        """
        if not all(0 < len(option) <= BATCH_TOKENS for option in options):
            raise ModelError(f"an option has to be from 1 to {BATCH_TOKENS} tokens long")
        first = self.log_probabilities()
        scores = np.array([first[option[0]] for option in options])
        for tree in _trees(options, self._sequences - 1):
            checkpoint()
            sequences = {n: i for i, n in enumerate(sorted(set().union(*tree.values())), start=1)}
            for sequence in sequences.values():
                llama_cpp.llama_memory_seq_cp(self._memory, 0, sequence, *WHOLE)
            self._decode(
                [
                    _Row(begin[-1], self._length + len(begin) - 1, [sequences[n] for n in on], True)
                    for begin, on in tree.items()
                ]
            )
            for row, (begin, on) in enumerate(tree.items()):
                next_token = self.log_probabilities(row)
                for n in on:
                    scores[n] += next_token[options[n][len(begin)]]
            for sequence in sequences.values():
                llama_cpp.llama_memory_seq_rm(self._memory, sequence, *WHOLE)
        return scores

    def state(self) -> NDArray[np.float64]:
        """(width,) hidden state of the last layer after the last token of sequence 0.

        Call `read` first; only a context with several sequences keeps states.
        """
        pointer = llama_cpp.llama_get_embeddings_ith(self.pointer, -1)
        return np.ctypeslib.as_array(pointer, shape=(self._model.width,)).astype(np.float64)

    def log_probabilities(self, row: int = -1) -> NDArray[np.float64]:
        """(vocabulary,) log P(next token) after this row of the last batch; -1: the last row."""
        pointer = llama_cpp.llama_get_logits_ith(self.pointer, row)
        shape = (self._model.vocabulary_size,)
        logits = np.ctypeslib.as_array(pointer, shape=shape).astype(np.float64)
        logits -= logits.max()
        log_probabilities: NDArray[np.float64] = logits - np.log(np.exp(logits).sum())
        return log_probabilities

    def close(self) -> None:
        """Free the memory."""
        llama_cpp.llama_batch_free(self._batch)
        llama_cpp.llama_free(self.pointer)

    def _in_common(self, batches: list[tuple[int, ...]]) -> int:
        """How many of these batches sequence 0 begins with."""
        return sum(takewhile(bool, map(operator.eq, self._batches, batches)))

    def _make_room(self, tokens: int) -> None:
        """Grow to at least this many tokens, and copy sequence 0 into the new context."""
        window = self._window
        while window < tokens:
            window = min(2 * window, self._n_ctx)
        if window > self._window:
            read = self._cache()
            llama_cpp.llama_free(self.pointer)
            self._open(window)
            if not self._restore(read, self._length):
                self._batches, self._length = [], 0

    def _forget(self) -> None:
        llama_cpp.llama_memory_clear(self._memory, True)
        self._batches, self._length = [], 0

    def _recall(self, batches: list[tuple[int, ...]]) -> bool:
        """Load these batches into sequence 0 from the kept cache; False if they are not there."""
        content = self._kept.get("cache", batches) if self._kept else None
        if content is None:
            return False
        self._forget()
        length = sum(map(len, batches))
        if not self._restore(content, length):
            return False
        self._batches, self._length = batches, length
        return True

    def _remember(self) -> None:
        """Save the cache of sequence 0."""
        if self._kept is not None:
            self._kept.put(self._cache(), "cache", self._batches)

    def _cache(self) -> bytes:
        """The KV cache of sequence 0, serialized."""
        size = llama_cpp.llama_state_seq_get_size(self.pointer, 0)
        buffer = (ctypes.c_uint8 * size)()
        written = llama_cpp.llama_state_seq_get_data(self.pointer, buffer, size, 0)
        return bytes(buffer[:written])

    def _restore(self, state: bytes, length: int) -> bool:
        """Load a serialized cache into the empty sequence 0; False if llama.cpp rejects it."""
        buffer = (ctypes.c_uint8 * len(state)).from_buffer_copy(state)
        read = llama_cpp.llama_state_seq_set_data(self.pointer, buffer, len(state), 0)
        reaches = llama_cpp.llama_memory_seq_pos_max(self._memory, 0) + 1
        if read == len(state) and reaches == length:
            return True
        llama_cpp.llama_memory_clear(self._memory, True)
        return False

    def _decode(self, rows: Sequence["_Row"]) -> None:
        batch = self._batch
        batch.n_tokens = len(rows)
        for i, row in enumerate(rows):
            batch.token[i] = row.token
            batch.pos[i] = row.position
            batch.n_seq_id[i] = len(row.sequences)
            for j, sequence in enumerate(row.sequences):
                batch.seq_id[i][j] = sequence
            batch.logits[i] = row.wanted
        if code := llama_cpp.llama_decode(self.pointer, batch):
            raise ModelError(f"llama.cpp could not evaluate (code {code}): {last_complaint()}")
        self.evaluated += len(rows)


@dataclass(frozen=True, slots=True)
class _Row:
    """One token to evaluate: its position, its sequences, and whether logits are wanted."""

    token: int
    position: int
    sequences: Sequence[int] = (0,)
    wanted: bool = False


def _trees(options: Sequence[Tokens], most: int) -> Iterator[dict[tuple[int, ...], list[int]]]:
    """Map each proper prefix of an option to the indices of the options that begin with it.

    Yields parts with at most BATCH_TOKENS prefixes and `most` options each.
    """
    tree: dict[tuple[int, ...], list[int]] = {}
    count = 0
    for number, option in enumerate(options):
        begins = [tuple(option[:end]) for end in range(1, len(option))]
        if count == most or len(tree.keys() | begins) > BATCH_TOKENS:
            yield tree
            tree, count = {}, 0
        for begin in begins:
            tree.setdefault(begin, []).append(number)
        count += bool(begins)
    if tree:
        yield tree
