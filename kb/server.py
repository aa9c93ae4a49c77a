"""A language model behind HTTP: any server that speaks OpenAI's `/v1/chat/completions`."""

import asyncio
import json
import threading
import time
from collections.abc import AsyncIterator
from dataclasses import dataclass
from typing import Any

import httpx2

from executive.events import Inbox
from executive.text import writable
from executive.types import ChatRequest, Failed, RankRequest, Replied, Result, Usage

BYTES_PER_TOKEN = 3
"""A careful estimate for English: such servers do not offer their tokenizer."""
RETRY_AFTER_S = 0.2
DISLIKES_BODY = (400, 422, 500)
"""Statuses of a server that cannot read what it was sent."""
MOST_OF_A_REFUSAL = 200
"""Characters of a server's message that are passed on."""


@dataclass(slots=True)
class _Reply:
    """What has come of a reply so far."""

    text: str = ""
    finish_reason: str = ""
    first_token_s: float = 0.0
    chunks: int = 0
    read: int | None = None
    cached: int = 0
    written: int | None = None

    def add(self, chunk: dict[str, Any], after_s: float) -> None:
        """Take in one object of the stream, which came so long after the request."""
        for choice in chunk.get("choices") or ():
            if text := (choice.get("delta") or {}).get("content"):
                self.first_token_s = self.first_token_s or after_s
                self.text += text
                self.chunks += 1
            self.finish_reason = choice.get("finish_reason") or self.finish_reason
        if usage := chunk.get("usage"):
            self.read = usage.get("prompt_tokens")
            self.written = usage.get("completion_tokens")
            self.cached = (usage.get("prompt_tokens_details") or {}).get("cached_tokens") or 0


class _BrokenOff(Exception):
    """The server did not get to its end; trying again may help."""


class _Refused(Exception):
    """The server will not have this request, however often it is asked."""


class Server:
    """Implements `LanguageModel` with a server; it writes, but cannot score.

    Replies are streamed, so that a cancelled request is hung up on at once. A request that fails
    before its first word is tried once more.
    """

    can_rank = False

    def __init__(
        self,
        url: str,
        inbox: Inbox,
        *,
        model: str | None = None,
        api_key: str | None = None,
        n_ctx: int = 4096,
        temperature: float = 0.6,
        top_p: float = 0.9,
        max_tokens: int = 512,
        seed: int = 0,
        timeout_s: float = 60.0,
        grammar: bool = False,
    ) -> None:
        """Prepare to talk to the server; nothing is sent yet.

        Args:
            url: up to and with the version, such as `http://127.0.0.1:8000/v1`.
            inbox: where requests end.
            model: name of the model there; None: the first that the server lists.
            api_key: sent as a bearer token.
            n_ctx: size of the model's context window (tokens), as the server was started with.
            temperature: 0 always takes the likeliest token.
            top_p: share of the probability that is sampled from.
            max_tokens: longest reply (tokens).
            seed: for servers that heed it.
            timeout_s: longest silence of the server (seconds).
            grammar: ask the server to hold replies to the request's JSON schema; a server that
                refuses is asked once more in llama_cpp.server's way.
        """
        self.name = model or url
        self._url = url.rstrip("/")
        self._inbox = inbox
        self._model = model
        self._headers = {"Authorization": f"Bearer {api_key}"} if api_key else {}
        self._n_ctx = n_ctx
        self._sampling: dict[str, float | int] = {
            "temperature": temperature,
            "top_p": top_p,
            "max_tokens": max_tokens,
            "seed": seed,
        }
        self._timeout_s = timeout_s
        self._grammar = grammar
        self._openai_schema = True
        """How to write a schema: as OpenAI does, or as llama_cpp.server does."""
        self._tasks: dict[int, asyncio.Task[None]] = {}
        self._loop = asyncio.new_event_loop()
        self._thread = threading.Thread(target=self._loop.run_forever, name="language model server")
        self._thread.daemon = True
        self._thread.start()

    @property
    def context_tokens(self) -> int:
        """Size of the context window (tokens)."""
        return self._n_ctx

    def chat(self, request: ChatRequest) -> int:
        """Write a reply; ends Replied, or Failed."""
        number = self._inbox.open(real=True)
        self._loop.call_soon_threadsafe(self._begin, number, request)
        return number

    def rank(self, request: RankRequest) -> int:
        """Ends Failed: such servers do not tell the probabilities of a given text."""
        number = self._inbox.open(real=True)
        self._inbox.end(number, Failed("a server's language model cannot score places"))
        return number

    def prepare(self, request: ChatRequest | RankRequest) -> None:
        """Nothing: a server is not asked what nobody wants to know."""

    def cancel(self, request: int) -> None:
        """Hang up on the server; nothing is delivered."""
        self._loop.call_soon_threadsafe(self._hang_up, request)
        self._inbox.drop(request)

    def count_tokens(self, text: str) -> int:
        """An estimate, rather too high: a token for every three bytes."""
        return -(-len(text.encode()) // BYTES_PER_TOKEN)

    def close(self) -> None:
        """Hang up and end the thread."""
        if self._loop.is_closed():
            return
        asyncio.run_coroutine_threadsafe(self._hang_up_all(), self._loop).result()
        self._loop.call_soon_threadsafe(self._loop.stop)
        self._thread.join()
        self._loop.close()

    # --- from here on in the server's thread ---

    def _begin(self, number: int, request: ChatRequest) -> None:
        task = self._loop.create_task(self._serve(number, request))
        self._tasks[number] = task
        task.add_done_callback(lambda _: self._tasks.pop(number))

    def _hang_up(self, number: int) -> None:
        if task := self._tasks.get(number):
            task.cancel()

    async def _hang_up_all(self) -> None:
        tasks = list(self._tasks.values())
        for task in tasks:
            task.cancel()
        await asyncio.gather(*tasks, return_exceptions=True)

    async def _serve(self, number: int, request: ChatRequest) -> None:
        try:
            result = await self._reply(request)
        except Exception as error:  # noqa: BLE001 - a request must never be left without an end
            result = Failed(f"the language model's server at {self._url} failed: {error!r}")
        self._inbox.end(number, result)

    async def _reply(self, request: ChatRequest) -> Result:
        began = time.monotonic()
        async with httpx2.AsyncClient(timeout=self._timeout_s, headers=self._headers) as client:
            for last_try in (False, True):
                got = _Reply()
                try:
                    await self._stream(client, request, got, began)
                    return self._replied(request, got, began)
                except httpx2.TimeoutException:
                    return Failed(f"{self._url} was silent for {self._timeout_s:g} s")
                except (httpx2.TransportError, _BrokenOff) as error:
                    if got.text:
                        return Failed(f"{self._url} broke off in the middle of its reply")
                    if last_try:
                        return Failed(f"{self._url} cannot be reached: {error}")
                except _Refused as error:
                    if last_try or not self._grammar:
                        return Failed(f"{self._url} refused the request: {error}")
                await asyncio.sleep(RETRY_AFTER_S)
        raise AssertionError("the last try returns")

    async def _stream(
        self, client: httpx2.AsyncClient, request: ChatRequest, got: _Reply, began: float
    ) -> None:
        """Ask, and put into `got` what arrives."""
        body = self._body(request, self._model or await self._first_model(client))
        url = f"{self._url}/chat/completions"
        async with client.stream("POST", url, json=body) as response:
            if response.status_code in DISLIKES_BODY:
                self._openai_schema = not self._openai_schema
            if response.status_code >= 500:
                raise _BrokenOff(f"HTTP {response.status_code}")
            if response.status_code != 200:
                said = (await response.aread()).decode(errors="replace").strip()
                raise _Refused(f"HTTP {response.status_code} {said[:MOST_OF_A_REFUSAL]}")
            async for chunk in _chunks(response):
                got.add(chunk, time.monotonic() - began)
        if not got.finish_reason:
            raise _BrokenOff("it closed the connection without a reply")

    async def _first_model(self, client: httpx2.AsyncClient) -> str:
        """The first model that the server lists; servers of one model take any name."""
        response = await client.get(f"{self._url}/models")
        try:
            self._model = str(response.json()["data"][0]["id"])
        except (ValueError, LookupError, TypeError):
            self._model = "default"
        else:
            self.name = self._model
        return self._model

    def _body(self, request: ChatRequest, model: str) -> dict[str, Any]:
        body: dict[str, Any] = {
            "model": model,
            "messages": [{"role": m.role, "content": m.content} for m in request.messages],
            "stream": True,
            "stream_options": {"include_usage": True},
            **self._sampling,
        }
        if self._grammar and request.schema:
            held = {"name": request.label, "schema": request.schema}
            body["response_format"] = (
                {"type": "json_schema", "json_schema": held}
                if self._openai_schema
                else {"type": "json_object", "schema": request.schema}
            )
        return body

    def _replied(self, request: ChatRequest, got: _Reply, began: float) -> Replied:
        read = got.read
        if read is None:
            read = sum(self.count_tokens(message.content) for message in request.messages)
        usage = Usage(
            model=self.name,
            input_tokens=read,
            evaluated_tokens=read - got.cached,
            output_tokens=got.chunks if got.written is None else got.written,
            first_token_s=got.first_token_s,
            total_s=time.monotonic() - began,
            parameters={**self._sampling},
        )
        return Replied(request, writable(got.text), usage, got.finish_reason)


async def _chunks(response: httpx2.Response) -> AsyncIterator[dict[str, Any]]:
    """The JSON objects of a stream of server-sent events."""
    async for line in response.aiter_lines():
        if not line.startswith("data:"):
            continue
        data = line.removeprefix("data:").strip()
        if data == "[DONE]":
            return
        try:
            chunk = json.loads(data)
        except ValueError:
            raise _Refused(f"its reply is not JSON: {data[:MOST_OF_A_REFUSAL]}") from None
        if not isinstance(chunk, dict) or "error" in chunk:
            raise _Refused(data[:MOST_OF_A_REFUSAL])
        yield chunk
