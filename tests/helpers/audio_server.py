"""A server that hears, with whatever oddities a test gives it."""

import json
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer

Answer = Callable[[BaseHTTPRequestHandler, bytes], None]
"""What it does with a request, of which it is given the body."""


@dataclass
class Server:
    """One that runs: its address without `/v1`, and what it was asked."""

    url: str
    bodies: list[bytes] = field(default_factory=list)
    paths: list[str] = field(default_factory=list)
    keys: list[str | None] = field(default_factory=list)


def says(value: object, status: int = 200, **headers: str) -> Answer:
    """It answers with this: bytes as they are, anything else as JSON."""
    content = value if isinstance(value, bytes) else json.dumps(value).encode()

    def answer(request: BaseHTTPRequestHandler, body: bytes) -> None:
        request.send_response(status)
        for name, is_ in {"Content-Length": str(len(content)), **headers}.items():
            request.send_header(name.replace("_", "-"), is_)
        request.end_headers()
        request.wfile.write(content)

    return answer


@contextmanager
def hearing(*answers: Answer, under: str = "/v1") -> Iterator[Server]:
    """Serve until the block ends: one answer a request, the last one for all that follow."""
    todo = list(answers)

    class Handler(BaseHTTPRequestHandler):
        def do_POST(self) -> None:
            body = self.rfile.read(int(self.headers["Content-Length"]))
            server.bodies.append(body)
            server.paths.append(self.path)
            server.keys.append(self.headers.get("Authorization"))
            if self.path != f"{under}/audio/transcriptions":
                says({"detail": "Not Found"}, 404)(self, body)
                return
            answer = todo.pop(0) if len(todo) > 1 else todo[0]
            with suppress(OSError):  # whoever asked has gone
                answer(self, body)

        def log_message(self, *args: object) -> None:
            """Nothing."""

    listener = ThreadingHTTPServer(("127.0.0.1", 0), Handler)
    server = Server(f"http://127.0.0.1:{listener.server_port}")
    thread = threading.Thread(target=listener.serve_forever, args=[0.01], daemon=True)
    thread.start()
    try:
        yield server
    finally:
        listener.shutdown()
        listener.server_close()
        thread.join()
