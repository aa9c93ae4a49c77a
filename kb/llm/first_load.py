"""Loads an unknown model file for the first time in a child process.

llama.cpp aborts the whole process if a file violates its assumptions, and a chat template is a
program. So a child process, which may crash or be killed, first loads the file and fills in its
template. A success is recorded in the user's cache, by the content of the file; a file that failed
is never loaded here.
"""

import hashlib
import logging
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from importlib.metadata import version
from pathlib import Path

from executive.cache import cache_folder
from executive.errors import ModelError
from executive.servers.key import EARS_KEY, LLM_KEY
from executive.text import printable, writable
from kb.llm.gguf_header import RANKS, WRITES, check_file

PATIENCE_S = 60.0
"""The time limit for a small file, ..."""
SLOWEST_DISK = 20e6
"""... plus the time to read the file from a disk as slow as this (bytes/s), ..."""
MOST_PATIENCE_S = 900.0
"""... but at most this."""
SAMPLE = 1 << 20
"""Bytes from the start and from the end of a file that identify it."""
LONGEST_FAULT = 500

log = logging.getLogger(__name__)


def tried(path: Path, called_off: Callable[[], bool] = lambda: False) -> bool:
    """Check that a model file can be loaded; return whether it can also rank.

    Args:
        path: the model file.
        called_off: polled during the check; True stops it.

    Raises:
        ModelError: if it cannot be loaded, or does not chat.
        KeyboardInterrupt: if it was stopped.
    """
    check_file(path)
    mark = mark_of(path)
    known = _recall(mark)
    if not known:
        log.warning("model %s is new: it is tried in a process of its own first", printable(path))
        known = _told_by_child(path, called_off)
        _remember(mark, known)
    return RANKS in known


def _told_by_child(path: Path, called_off: Callable[[], bool]) -> list[str]:
    environment = {**os.environ, "GGML_NO_BACKTRACE": "1"}
    environment["PYTHONPATH"] = os.pathsep.join(part or os.getcwd() for part in sys.path)
    for secret in (LLM_KEY, EARS_KEY):
        environment.pop(secret, None)
    command = "from kb.llm.trial import main; main()"
    with subprocess.Popen(
        [sys.executable, "-P", "-c", command, path.absolute()],
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        env=environment,
        start_new_session=True,
    ) as child:
        try:
            patience_s = PATIENCE_S + path.stat().st_size / SLOWEST_DISK
            said = _until_ended(child, min(patience_s, MOST_PATIENCE_S), called_off)
        finally:
            child.kill()
            child.wait()  # on Ctrl-C, `with` alone waits for only 0.25 s
    lines = writable(said.decode(errors="replace")).splitlines()
    if WRITES in lines:
        return lines
    if lines:
        raise ModelError(printable(lines[0])[:LONGEST_FAULT])
    raise ModelError(f"model {printable(path)} cannot be loaded: {_cause_of_end(child.returncode)}")


def _until_ended(
    child: subprocess.Popen[bytes], patience_s: float, called_off: Callable[[], bool]
) -> bytes:
    """The child's output until it ends or times out; it is short, so no pipe fills up."""
    deadline = time.monotonic() + patience_s
    while True:
        try:
            return child.communicate(timeout=0.05)[0]
        except subprocess.TimeoutExpired:
            if called_off():
                raise KeyboardInterrupt from None
            if time.monotonic() > deadline:
                child.kill()
                return child.communicate()[0]


def _cause_of_end(code: int) -> str:
    if code == -signal.SIGALRM:
        return "its chat template has no end"
    if code == -signal.SIGKILL:
        return "it takes too long"
    if code < 0:
        return f"llama.cpp dies of it ({signal.Signals(-code).name})"
    return "llama.cpp does not say why"


# --- results of earlier checks ---


def mark_of(path: Path) -> str:
    """A hash that identifies the file and the llama.cpp version.

    It is made from samples of the file, because to read all of it takes long.

    Raises:
        ModelError: if the file cannot be read.
    """
    try:
        about = path.stat()
        with path.open("rb") as file:
            begins = file.read(SAMPLE)
            file.seek(max(0, about.st_size - SAMPLE))
            ends = file.read(SAMPLE)
    except OSError as error:
        raise ModelError(f"model {printable(path)} cannot be read: {error.strerror}") from None
    facts = (version("llama-cpp-python"), about.st_size, about.st_mtime_ns)
    return hashlib.sha256(repr(facts).encode() + begins + ends).hexdigest()


def _folder() -> Path:
    """The folder of the recorded results.

    Raises:
        OSError: if there is no cache folder.
    """
    if (folder := cache_folder("models")) is None:
        raise OSError("there is no cache folder of our own")
    return folder


def _recall(mark: str) -> list[str]:
    try:
        return [line for line in (_folder() / mark).read_text()[:100].split() if line]
    except (OSError, ValueError):
        return []


def _remember(mark: str, known: list[str]) -> None:
    """Record the result; if that fails, the file is checked again next time."""
    try:
        (_folder() / mark).write_text("\n".join(known))
    except OSError as error:
        log.info("it is not remembered that the model can be loaded: %s", error)
