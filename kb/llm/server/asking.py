"""Sends a request to a server, with retries, until it answers or nothing is left to try."""

import asyncio
import json
import logging
import time
from contextlib import aclosing
from copy import deepcopy
from dataclasses import dataclass
from typing import Any

import httpx2

from executive.servers.address import bases_of, is_this_machine, without_secrets
from executive.servers.key import LLM_KEY, Key
from executive.servers.network import why
from executive.servers.refusal import MOST_BYTES, MOST_CHARACTERS, Refused, refusal
from executive.text import printable, writable
from executive.types.llm import ChatRequest
from executive.types.results import Failed
from kb.llm.server.dialect import Dialect
from kb.llm.server.listing import chat_models, is_about_the_model
from kb.llm.server.packed import NotUnpacked, unpacked
from kb.llm.server.wire import BrokenOff, NotJson, Written, objects

PAUSE_S = 0.5
"""Pause before the first retry (s), if the server gives none; doubled each time."""
MOST_WAITS = 4
"""Retries if a server is busy, ..."""
MOST_ERRORS = 1
"""... and if it fails."""
MOST_MODELS = 5
"""How many of a server's models are tried."""
LOOKING_S = 10.0
"""Time limit for a list of models (s), if a model is named or no request is waiting."""
MOST_OF_A_LISTING = 4 << 20
"""Maximum size of a list of models (bytes)."""
BUSY = (429, 503, 529)
NOT_HERE = (404, 405, 501)
DENIED = (401, 403, 407)

logging.getLogger("httpcore2").setLevel(logging.INFO)  # below, it writes headers down


@dataclass(frozen=True, slots=True)
class Asked:
    """The answer to a request."""

    got: Written
    text: str
    total_s: float


class _Tries:
    """The retries and the time left for one request."""

    def __init__(self, until: float) -> None:
        self._until = until
        self._waits, self._errors = 0, 0

    def pause_s(self, status: int = 500, wait_s: float | None = None) -> float | None:
        """The pause before the next try (s); None if there is none left.

        Args:
            status: HTTP status of the refusal; 500 for a failure without one.
            wait_s: the pause that the server asks for (s).
        """
        pause = PAUSE_S * 2**self._waits if wait_s is None else wait_s
        if status in BUSY:
            self._waits += 1
        elif status >= 500:
            self._errors += 1
        else:
            return None
        enough = self._waits > MOST_WAITS or self._errors > MOST_ERRORS
        return None if enough or time.monotonic() + pause >= self._until else pause


class Asking:
    """One server, and what is known about it: endpoints, models, accepted parameters."""

    def __init__(
        self, url: str, dialect: Dialect, model: str | None, key: Key, timeout_s: float
    ) -> None:
        """Nothing is sent yet; the arguments are those of `Server`."""
        self._shown = without_secrets(url)
        self._bases = list(bases_of(url))
        self._dialect = dialect
        self._named = model
        self._models = [model] if model else []
        self._key = key
        self._timeout_s = timeout_s
        self._client: httpx2.AsyncClient | None = None
        self._listed: tuple[str, ...] = ()
        self._looked = False
        self._looking = asyncio.Lock()
        self.name = model or self._shown

    async def look(self) -> str:
        """Ask for the models; return why the server cannot be used, or "" if nothing is known."""
        try:
            async with asyncio.timeout(min(LOOKING_S, self._timeout_s)):
                await self._look()
        except TimeoutError:
            return f"{self._shown} is silent"
        except Exception as error:  # only a check, which must not fail
            return self._sentence(error)
        return ""

    async def ask(self, request: ChatRequest) -> Asked | Failed:
        """Send a request; wait and adapt as the server demands. Never raises."""
        began = time.monotonic()
        got = Written()
        try:
            async with asyncio.timeout(self._timeout_s):
                got = await self._until_answered(request, began)
        except TimeoutError:
            return Failed(f"{self._shown} did not answer within {self._timeout_s:g} s")
        except (Refused, BrokenOff, NotJson, httpx2.HTTPError) as error:
            return Failed(self._sentence(error))
        except Exception as error:  # every request must get a result
            return Failed(f"{self._shown} failed: {self._shortly(repr(error))}")
        text = self._key.hidden_in(writable(got.text))
        got.finish_reason = self._shortly(got.finish_reason)
        return Asked(got, text, time.monotonic() - began)

    async def close(self) -> None:
        """Close all connections."""
        if self._client:
            await self._client.aclose()

    async def _until_answered(self, request: ChatRequest, began: float) -> Written:
        tries = _Tries(began + self._timeout_s)
        learned = deepcopy(self._dialect)
        while True:
            got, body = Written(), dict[str, Any]()
            try:
                await self._look()
                body = self._dialect.body(request, self._models[0])
                await self._stream(body, got, began)
                return got
            except Refused as refused:
                if got.chunks:
                    raise
                if self._adapts(refused, body):
                    continue
                if (pause := tries.pause_s(refused.status, refused.wait_s)) is None:
                    self._dialect = learned  # what was tried did not help
                    raise
            except httpx2.TimeoutException:
                raise TimeoutError from None
            except (httpx2.TransportError, BrokenOff) as error:
                if got.chunks:
                    raise BrokenOff("broke off in the middle of its reply") from error
                if (pause := tries.pause_s()) is None:
                    raise
            await asyncio.sleep(pause)

    async def _stream(self, body: dict[str, Any], got: Written, began: float) -> None:
        """Send the request, and add what arrives to `got`."""
        url = f"{self._bases[0]}/chat/completions"
        async with self._connected().stream("POST", url, json=body) as response:
            if response.status_code != 200:
                raise await _refused(response)
            try:
                async with aclosing(objects(response)) as chunks:
                    async for chunk in chunks:
                        got.add(chunk, time.monotonic() - began)
            except BrokenOff:
                if not got.finish_reason and got.written is None:  # usage comes last
                    raise

    def _adapts(self, refused: Refused, body: dict[str, Any]) -> bool:
        """Adapt the request to a refusal, for all later ones, too; whether that was possible.

        Each time, one alternative less is left, so this terminates.
        """
        if not body or refused.status in (*BUSY, *DENIED):
            return False
        if self._dialect.learns(refused, body):
            return True
        about_the_model = is_about_the_model(refused)
        if about_the_model and len(self._models) > 1:
            self._models.pop(0)
            self.name = self._models[0]
            return True
        if refused.status in NOT_HERE and not about_the_model and len(self._bases) > 1:
            self._bases.pop(0)
            return True
        return not about_the_model and self._dialect.guesses(refused, body)

    async def _look(self) -> None:
        """Find the endpoints and the models, once.

        If no model is named, the time limit for the list is that of an answer: a server that is
        busy with another request may not list its models meanwhile.
        """
        async with self._looking:
            if self._looked:
                return
            enough_s = min(LOOKING_S, self._timeout_s / 2) if self._models else None
            try:
                async with asyncio.timeout(enough_s):
                    await self._list()
            except (TimeoutError, Refused, httpx2.TimeoutException):
                if not self._models:
                    raise
            if not self._models:
                self._models = list(self._listed[:MOST_MODELS]) or ["default"]
                self.name = self._models[0] if self._listed else self._shown
            self._looked = True

    async def _list(self) -> None:
        for base in self._bases:
            async with self._connected().stream("GET", f"{base}/models") as response:
                if response.status_code == 200:
                    listing = await _json(response)
                    if listing is not None:
                        names = chat_models(listing)
                        self._listed = tuple(n for n in names if n == self._key.hidden_in(n))
                        self._bases = [base]
                        return
                elif not _lists_none(response.status_code):
                    raise await _refused(response)

    def _connected(self) -> httpx2.AsyncClient:
        if self._client is None:
            self._client = httpx2.AsyncClient(
                timeout=self._timeout_s,
                headers={**self._key.headers(), "Accept-Encoding": "identity"},
                trust_env=not is_this_machine(self._bases[0]),
            )
        return self._client

    def _sentence(self, error: Exception) -> str:
        """The error as a clause, without the key, whatever the server said."""
        match error:
            case Refused():
                told = Refused(error.status, self._key.hidden_in(error.says))
                return self._shortly(str(told)) + self._advice(error)
            case BrokenOff():
                return f"{self._shown} {error}"
            case NotJson():
                said = self._shortly(str(error))
                return f"the reply of {self._shown} is no JSON object in UTF-8: {said}"
            case _:
                return f"{self._shown} cannot be reached: {self._shortly(why(error))}"

    def _advice(self, refused: Refused) -> str:
        if refused.status in DENIED:
            return f"; check {LLM_KEY}" if self._key else f"; set {LLM_KEY}"
        if self._named and self._listed and is_about_the_model(refused):
            return f"; the server has {self._shortly(', '.join(self._listed))}"
        return ""

    def _shortly(self, text: str) -> str:
        text = self._key.hidden_in(printable(text))
        return text[:MOST_CHARACTERS] + "..." * (len(text) > MOST_CHARACTERS)


def _lists_none(status: int) -> bool:
    """Whether a server with this status may still be able to chat, without a list of models."""
    return 400 <= status < 500 and status not in (*BUSY, *DENIED)


async def _refused(response: httpx2.Response) -> Refused:
    """The refusal in a response."""
    if response.is_redirect and (there := response.headers.get("Location")):
        sends = f"it sends to {without_secrets(there)}; give that address"
        return Refused(response.status_code, sends)
    return refusal(response.status_code, response.headers, await _read(response, MOST_BYTES))


async def _json(response: httpx2.Response) -> object:
    """The JSON value in a response; None if there is none."""
    try:
        value: object = json.loads(await _read(response, MOST_OF_A_LISTING))
    except (ValueError, RecursionError):
        return None
    return value


async def _read(response: httpx2.Response, most: int) -> bytes:
    """The first bytes of a response, at most `most`."""
    read = bytearray()
    try:
        async with aclosing(unpacked(response)) as parts:
            async for part in parts:
                read += part
                if len(read) > most:
                    break
    except NotUnpacked as error:
        return str(error).encode()
    return bytes(read[:most])
