"""A real server of the embedded model, as a person would start it: `python -m llama_cpp.server`."""

import os
import socket
import subprocess
import sys
import urllib.request
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from patience import PATIENCE_S, until

from kb.llm.llama import embedded_model

ALIAS = "smollm2"


@dataclass(frozen=True)
class LlamaServer:
    """A running server; `url` is `http://127.0.0.1:PORT/v1`."""

    url: str
    process: subprocess.Popen[bytes]


@contextmanager
def llama_server(log: Path) -> Iterator[LlamaServer]:
    """Run one on a free port until the block ends; what it prints goes to `log`."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    server = LlamaServer(f"http://127.0.0.1:{port}/v1", _start(port, log))
    try:
        _wait_for(server)
        yield server
    finally:
        server.process.terminate()
        server.process.wait(PATIENCE_S)


def _start(port: int, log: Path) -> subprocess.Popen[bytes]:
    options = {"model": embedded_model(), "model_alias": ALIAS, "host": "127.0.0.1", "port": port}
    arguments = [text for key, value in options.items() for text in (f"--{key}", str(value))]
    with log.open("wb") as out:
        return subprocess.Popen(
            [
                sys.executable,
                "-m",
                "llama_cpp.server",
                *arguments,
                "--n_ctx",
                "4096",
                "--interrupt_requests",
                "false",
            ],
            stdout=out,
            stderr=out,
            env={**os.environ, "OMP_WAIT_POLICY": "passive"},
        )


def _wait_for(server: LlamaServer) -> None:
    def answers() -> bool:
        assert server.process.poll() is None, "the server ended: is the test extra installed?"
        try:
            urllib.request.urlopen(f"{server.url}/models", timeout=10).close()
        except OSError:
            return False
        return True

    until(answers, "the server")
