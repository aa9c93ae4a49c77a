"""A server of language models with whatever oddities a test gives it."""

import json
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any

from patience import PATIENCE_S

from executive.events import Ended, Inbox
from executive.types.llm import ChatRequest, Message
from executive.types.results import Failed, Replied, Result
from kb.advice.verification import Reply
from kb.llm.server.server import Server

SCHEMA = Reply.model_json_schema()
HELLO = ChatRequest(
    "general_pos", (Message("system", "You know a home."), Message("user", "The mug?")), SCHEMA
)

Handler = BaseHTTPRequestHandler
Behaviour = Callable[[Handler, dict[str, Any]], None]
"""What a server does with a request, of which it is given the body."""


@dataclass
class Odd:
    """A running server: its address without `/v1`, and what it was asked."""

    url: str
    bodies: list[dict[str, Any]] = field(default_factory=list)
    headers: list[dict[str, str]] = field(default_factory=list)
    paths: list[str] = field(default_factory=list)


@contextmanager
def serving(
    *behaviours: Behaviour, models: object = ("tiny-model",), under: str = "/v1"
) -> Iterator[Odd]:
    """Serve until the block ends: one behaviour a request, the last one for all that follow.

    `models` are listed as they are, or as OpenAI does if they are a tuple; a behaviour serves the
    list itself. Nothing is anywhere but under `under`.
    """
    todo = list(behaviours)

    class Listener(Handler):
        def do_GET(self) -> None:
            odd.paths.append(self.path)
            odd.headers.append(dict(self.headers))
            if self.path != f"{under}/models":
                answer(self, 404, "not found")
            elif callable(models):
                models(self, {})
            elif isinstance(models, tuple):
                answer(self, 200, {"data": [{"id": name} for name in models]})
            else:
                answer(self, 200, models)

        def do_POST(self) -> None:
            odd.paths.append(self.path)
            odd.headers.append(dict(self.headers))
            body = json.loads(self.rfile.read(int(self.headers["Content-Length"])))
            if self.path != f"{under}/chat/completions":
                answer(self, 404, "not found")
                return
            odd.bodies.append(body)
            (todo.pop(0) if len(todo) > 1 else todo[0])(self, body)

        def log_message(self, *arguments: object) -> None:
            pass

    server = ThreadingHTTPServer(("127.0.0.1", 0), Listener)
    odd = Odd(f"http://127.0.0.1:{server.server_port}")
    thread = threading.Thread(target=server.serve_forever, kwargs={"poll_interval": 0.01})
    thread.start()
    try:
        yield odd
    finally:
        server.shutdown()
        thread.join()
        server.server_close()


@dataclass
class Talk:
    """A model that talks to an odd server."""

    model: Server
    inbox: Inbox
    server: Odd

    @property
    def bodies(self) -> list[dict[str, Any]]:
        return self.server.bodies

    def ask(self, request: ChatRequest = HELLO, patience_s: float = PATIENCE_S) -> Result:
        """Put it to the model, and wait for the end."""
        return end_of(self.inbox, self.model.chat(request), patience_s)

    def reply(self) -> Replied:
        result = self.ask()
        assert isinstance(result, Replied), result
        return result

    def reason(self) -> str:
        result = self.ask()
        assert isinstance(result, Failed), result
        return result.reason


@contextmanager
def talking(
    *behaviours: Behaviour, models: object = ("tiny-model",), under: str = "/v1", **settings: Any
) -> Iterator[Talk]:
    """A model and its server, until the block ends."""
    inbox = Inbox()
    with serving(*behaviours, models=models, under=under) as odd:
        model = Server(settings.pop("url", odd.url + under), inbox, **settings)
        try:
            yield Talk(model, inbox, odd)
        finally:
            model.close()


def end_of(inbox: Inbox, request: int, patience_s: float = PATIENCE_S) -> Result:
    """The end of a request."""
    assert inbox.wait(patience_s), "the request never ended"
    (event,) = inbox.take_all()
    assert isinstance(event, Ended)
    assert event.request == request
    return event.result


# --- behaviours ---


def answer(handler: Handler, status: int, value: object, **headers: str) -> None:
    """Answer with a JSON value, or with bytes or a text as they are."""
    raw = value if isinstance(value, bytes) else json.dumps(value).encode()
    raw = value.encode() if isinstance(value, str) else raw
    handler.send_response(status)
    for name, text in headers.items():
        handler.send_header(name.replace("_", "-"), text)
    handler.send_header("Content-Length", str(len(raw)))
    handler.end_headers()
    handler.wfile.write(raw)


def send(handler: Handler, *chunks: dict[str, Any] | str) -> None:
    """Stream these server-sent events."""
    handler.send_response(200)
    handler.end_headers()
    for chunk in chunks:
        data = chunk if isinstance(chunk, str) else json.dumps(chunk)
        handler.wfile.write(f"data: {data}\n\n".encode())
    handler.wfile.flush()


def word(text: object, finish_reason: str | None = None, **more: object) -> dict[str, Any]:
    return {"choices": [{"delta": {"content": text, **more}, "finish_reason": finish_reason}]}


def streams(*chunks: dict[str, Any] | str) -> Behaviour:
    return lambda handler, _: send(handler, *chunks)


def says(*words: object) -> Behaviour:
    usage = {"choices": [], "usage": {"prompt_tokens": 40, "completion_tokens": 7}}
    return streams(*map(word, words), word("", "stop"), {**usage, "timings": {}}, "[DONE]")


def sends(raw: bytes) -> Behaviour:
    """Every byte of a good reply."""
    return lambda handler, _: answer(handler, 200, raw)


def refuses(status: int, says: object = "I do not like this", **headers: str) -> Behaviour:
    return lambda handler, _: answer(handler, status, says, **headers)


def dislikes(key: str, status: int, says: object) -> Behaviour:
    """Refuses what has this key, with these words; else it says "desk"."""

    def behave(handler: Handler, body: dict[str, Any]) -> None:
        if key in body or (key == "system" and body["messages"][0]["role"] == "system"):
            answer(handler, status, says)
        else:
            THE_DESK(handler, body)

    return behave


THE_DESK = says("desk")
