"""Checks an unknown model file; runs in a child process that may crash (`first_load`)."""

import os
import resource
import signal
import sys
from pathlib import Path

from executive.errors import ModelError
from executive.text import printable
from executive.types.llm import Message
from kb.llm.context import Context
from kb.llm.gguf import Gguf
from kb.llm.gguf_header import RANKS, TEMPLATE, WRITES, read_header, refuse_what_does_not_chat
from kb.llm.template import Template

SPARE_MEMORY = 8 << 30
"""Memory limit (bytes) for loading, in addition to twice the file size."""
TEMPLATE_S = 10
"""Time limit for a chat template (s)."""
CHAT = (Message("system", "You know a home."), Message("user", "Where is the mug?"))


def main() -> None:
    """Load the file named on the command line; print what it can do, or why it cannot be used."""
    path = Path(sys.argv[1])
    memory = 2 * path.stat().st_size + SPARE_MEMORY
    resource.setrlimit(resource.RLIMIT_DATA, (memory, memory))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    try:
        header = read_header(path)
        refuse_what_does_not_chat(path, header)
        _try_template(path, str(header.values[TEMPLATE]))
        model = Gguf(path)
        _try_to_write(model)
        print(WRITES, flush=True)
        _try_to_rank(model)
        print(RANKS, flush=True)
    except (ModelError, MemoryError) as error:
        print(printable(error) or "there is not enough memory", flush=True)
    finally:
        os._exit(0)


def _try_template(path: Path, text: str) -> None:
    signal.alarm(TEMPLATE_S)
    try:
        Template(text, "<s>", "</s>")
    except ModelError as error:
        raise ModelError(f"model {printable(path)}: {error}") from None
    signal.alarm(0)


def _try_to_write(model: Gguf) -> None:
    tokens, head = model.prompt(CHAT)
    context = Context(model, max(512, 2 * len(tokens)))
    context.read(tokens, head, lambda: None)
    context.append([int(context.log_probabilities().argmax())])


def _try_to_rank(model: Gguf) -> None:
    tokens, head = model.prompt(CHAT)
    context = Context(model, max(512, 2 * len(tokens)), sequences=3)
    context.read(tokens, head, lambda: None)
    context.state()
    context.continuations(
        [model.tokenize("on the desk"), model.tokenize("here it is")], lambda: None
    )
