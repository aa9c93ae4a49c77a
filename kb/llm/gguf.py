"""A GGUF file in llama.cpp: its weights, its vocabulary, its chat template.

A thin layer over the C functions of llama-cpp-python. Its own `Llama` class supports only one
sequence of tokens, but scoring continues one prompt in many ways at once.
"""

import ctypes
import operator
import os
from collections import deque
from collections.abc import Callable, Sequence
from itertools import takewhile
from pathlib import Path
from typing import Any

import llama_cpp

from executive.errors import ModelError
from executive.text import printable
from executive.types.llm import Message
from kb.llm.gguf_header import LONGEST_TEMPLATE, TEMPLATE, check_file
from kb.llm.template import Template

Tokens = list[int]
Checkpoint = Callable[[], None]
"""Called between steps; raises to stop the work."""

_complaints: deque[str] = deque(maxlen=4)


@llama_cpp.llama_log_callback  # type: ignore[untyped-decorator]
def _keep_complaints(level: int, text: bytes, user_data: ctypes.c_void_p) -> None:
    """Keep llama.cpp from writing to stderr, but keep its last error messages (level 4)."""
    if level == 4 and text.strip():
        _complaints.append(text.decode(errors="replace").strip())


class Gguf:
    """Weights and vocabulary. Tokenizing is thread-safe."""

    def __init__(
        self, path: Path, gpu_layers: int = 0, checkpoint: Checkpoint = lambda: None
    ) -> None:
        """Load the file; blocks. `checkpoint` is called during loading.

        Raises:
            ModelError: if llama.cpp cannot load it, or it is not a chat model.
        """
        check_file(path)
        llama_cpp.llama_log_set(_keep_complaints, ctypes.c_void_p(0))
        llama_cpp.llama_backend_init()
        params = llama_cpp.llama_model_default_params()
        params.n_gpu_layers = gpu_layers
        params.progress_callback = llama_cpp.llama_progress_callback(_goes_on(checkpoint))
        self.pointer: Any = llama_cpp.llama_model_load_from_file(os.fsencode(path), params)
        if not self.pointer:
            checkpoint()
            raise ModelError(f"model {printable(path)} cannot be loaded: {last_complaint()}")
        self.vocabulary: Any = llama_cpp.llama_model_get_vocab(self.pointer)
        self.vocabulary_size = llama_cpp.llama_vocab_n_tokens(self.vocabulary)
        self.width: int = llama_cpp.llama_model_n_embd(self.pointer)
        """Length of a hidden state."""
        try:
            self._template = Template(*self._template_texts(path))
        except ModelError as error:
            self.close()
            raise ModelError(f"model {printable(path)}: {error}") from None

    def tokenize(self, text: str, *, special: bool = False) -> Tokens:
        """Tokens of a text; if `special`, markup such as `<|im_start|>` is parsed."""
        raw = text.encode()
        tokens = (llama_cpp.llama_token * (len(raw) + 1))()
        count = llama_cpp.llama_tokenize(
            self.vocabulary, raw, len(raw), tokens, len(tokens), False, special
        )
        return list(tokens[:count])

    def prompt(self, chat: Sequence[Message], other: Sequence[Message] = ()) -> tuple[Tokens, int]:
        """Tokens of a chat in the model's own format, up to where its next turn begins.

        Returns:
            The tokens, and how many of them `other` begins with, too (never all).

        Raises:
            ModelError: if the template rejects the chat (some allow no system turn).
        """
        tokens = self._tokens(chat)
        others = self._tokens(other) if other else []
        return tokens, sum(takewhile(bool, map(operator.eq, tokens[:-1], others)))

    def piece(self, token: int) -> bytes:
        """The bytes of a token; one character may be split over several tokens."""
        buffer = ctypes.create_string_buffer(256)
        length = llama_cpp.llama_token_to_piece(
            self.vocabulary, token, buffer, len(buffer), 0, False
        )
        return buffer.raw[: max(0, length)]

    def ends(self, token: int) -> bool:
        """Whether this token ends the reply."""
        return bool(llama_cpp.llama_vocab_is_eog(self.vocabulary, token))

    def close(self) -> None:
        """Free the weights; close all contexts first."""
        llama_cpp.llama_model_free(self.pointer)

    def _tokens(self, chat: Sequence[Message]) -> Tokens:
        return self.tokenize(self._template.fill(chat), special=True)

    def _template_texts(self, path: Path) -> tuple[str, str, str]:
        """The chat template, and the begin-of-text and end-of-text markup."""
        buffer = ctypes.create_string_buffer(LONGEST_TEMPLATE)
        length = llama_cpp.llama_model_meta_val_str(
            self.pointer, TEMPLATE.encode(), buffer, len(buffer)
        )
        if not 0 < length < len(buffer):
            fault = "no chat template" if length <= 0 else "a chat template that is too long"
            raise ModelError(f"it has {fault}: take an instruction-tuned model")
        ends = (llama_cpp.llama_vocab_bos, llama_cpp.llama_vocab_eos)
        begin, end = (self.piece_of_special(one(self.vocabulary)) for one in ends)
        return buffer.value.decode(errors="replace"), begin, end

    def piece_of_special(self, token: int) -> str:
        """The markup of a special token; empty if the model has no such token (-1)."""
        if token < 0:
            return ""
        return str(llama_cpp.llama_vocab_get_text(self.vocabulary, token).decode(errors="replace"))


def _goes_on(checkpoint: Checkpoint) -> Callable[[float, ctypes.c_void_p], bool]:
    """The progress callback of loading: returns False to stop, if the checkpoint raises."""

    def goes_on(progress: float, user_data: ctypes.c_void_p) -> bool:
        try:
            checkpoint()
        except Exception:  # no exception may pass through C code
            return False
        return True

    return goes_on


def last_complaint() -> str:
    """Take the first error message of llama.cpp; later ones only say that it gives up."""
    said = _complaints[0] if _complaints else "llama.cpp does not say why"
    _complaints.clear()
    return printable(said.removeprefix("llama_model_load: error loading model: "))
