"""What the page's server answers: the page itself, what is new, and what the person sends."""

import asyncio
import json
from collections.abc import AsyncIterator, Awaitable, Callable, Mapping, Sequence
from importlib.resources import files
from importlib.resources.abc import Traversable
from pathlib import Path
from typing import Any, Protocol, TypeVar

from starlette.applications import Starlette
from starlette.concurrency import run_in_threadpool
from starlette.requests import Request
from starlette.responses import JSONResponse, PlainTextResponse, Response, StreamingResponse
from starlette.routing import Route

from executive.errors import ExecutiveError
from executive.page.board import Board
from executive.page.hearing import Alternative, alternatives_in

T = TypeVar("T")

MOST_BYTES = 8192
"""Of what a page sends: a thousand characters, however they are written."""
MOST_PAGES = 50
HEARTBEAT_S = 15.0
"""A connection that broke without a word is found out so soon; pages wait longer for one."""
RETRY_MS = 1000
"""When a browser that lost the connection tries again."""
PNG, JPEG = "image/png", "image/jpeg"
KINDS = {
    ".html": "text/html",
    ".css": "text/css",
    ".js": "text/javascript",
    ".json": "application/json",
    ".svg": "image/svg+xml",
}


def assets_of(package: str, root: str = "") -> dict[str, Traversable]:
    """The files in a package that browsers get, by their paths on the server."""
    entries = files(package).joinpath("assets").iterdir()
    return {f"{root}/{e.name}": e for e in entries if Path(e.name).suffix in KINDS}


ASSETS = assets_of("executive.page")
PUBLIC = frozenset(ASSETS)
"""What needs no token: it is the same for everyone."""


class Behind(Protocol):
    """What the page is about."""

    board: Board

    def own_routes(self) -> Sequence[Route]:
        """What is answered besides the page, or in its place."""
        ...

    def says(self, words: str) -> None:
        """The person sent words."""
        ...

    def answers(self, words: str, question: int) -> bool:
        """The person chose an answer of this question; False if that is over."""
        ...

    def hears(self, heard: Sequence[Alternative], utterance: str, *, final: bool) -> str:
        """The person's browser heard this: what became of it; empty if it should not listen."""
        ...

    def settles(self, number: int, *, agrees: bool) -> bool:
        """The person said yes or no to what was asked back; False if that is over."""
        ...

    def stops(self) -> None:
        """The person pressed the stop button."""
        ...

    def picture(self, number: int) -> bytes | None:
        """One of the latest pictures of the camera, as JPEG."""
        ...

    def portrait(self, name: str) -> bytes | None:
        """A picture of a thing, as PNG."""
        ...

    def why(self, run: str, time_s: float) -> list[dict[str, object]]:
        """The decisions behind a sentence."""
        ...


def site(behind: Behind) -> Starlette:
    """The application, still open to all: `Guard` comes around it."""
    answers = _Answers(behind)
    return Starlette(
        routes=[
            *behind.own_routes(),
            Route("/", answers.page),
            *(Route(path, answers.asset) for path in sorted(PUBLIC)),
            Route("/events", answers.events),
            Route("/say", answers.say, methods=["POST"]),
            Route("/heard", answers.heard, methods=["POST"]),
            Route("/settle", answers.settle, methods=["POST"]),
            Route("/stop", answers.stop, methods=["POST"]),
            Route("/why", answers.why),
            Route("/camera/{number:int}.jpg", answers.camera),
            Route("/thing/{name}.png", answers.thing),
        ]
    )


Answer = Callable[[Request], Awaitable[Response]]


class _Answers:
    """An answer a path."""

    def __init__(self, behind: Behind) -> None:
        self._behind = behind
        self._press: object = None
        """Tells the last press of the stop button from others."""
        self._files = Files(ASSETS)

    async def page(self, request: Request) -> Response:
        return self._files.at("/index.html")

    async def asset(self, request: Request) -> Response:
        return self._files.at(request.url.path)

    async def events(self, request: Request) -> Response:
        return board_events(self._behind.board, request)

    async def say(self, request: Request) -> Response:
        sent = await sent_json(request)
        words, question = sent.get("words"), sent.get("question")
        if not isinstance(words, str) or not isinstance(question, int | None):
            return PlainTextResponse("This is too long, or no text.", 413)
        if question is None:
            self._behind.says(words)
        elif not self._behind.answers(words, question):
            return PlainTextResponse("This question is over.", 409)
        return JSONResponse({})

    async def heard(self, request: Request) -> Response:
        sent = await sent_json(request)
        heard, utterance = alternatives_in(sent), sent.get("utterance")
        if not heard or not isinstance(utterance, str):
            return PlainTextResponse("This is too long, or nothing that was heard.", 413)
        final, hears = sent.get("final") is True, self._behind.hears
        became = await run_in_threadpool(hears, heard, utterance, final=final)
        if not became:
            return PlainTextResponse("This page does not listen.", 409)
        return JSONResponse({"became": became})

    async def settle(self, request: Request) -> Response:
        sent = await sent_json(request)
        match sent:
            case {"asked": int(number), "agrees": bool(agrees)}:
                done = self._behind.settles(number, agrees=agrees)
            case _:
                return PlainTextResponse("This is no answer.", 413)
        return JSONResponse({}) if done else PlainTextResponse("This question is over.", 409)

    async def stop(self, request: Request) -> Response:
        """Once for each time that it was pressed: a page sends it again until it is answered."""
        press = (await sent_json(request)).get("press")
        if press is None or press != self._press:
            self._behind.stops()
        self._press = press
        return JSONResponse({})

    async def why(self, request: Request) -> Response:
        return await answered(self._why, request)

    def _why(self, request: Request) -> list[dict[str, object]]:
        asked = request.query_params
        return self._behind.why(asked.get("run", ""), float(asked.get("time_s", "")))

    async def camera(self, request: Request) -> Response:
        picture = self._behind.picture
        return _picture(await run_in_threadpool(picture, request.path_params["number"]), JPEG)

    async def thing(self, request: Request) -> Response:
        portrait = self._behind.portrait
        return _picture(await run_in_threadpool(portrait, request.path_params["name"]), PNG)


class Files:
    """Files that are kept at hand."""

    def __init__(self, entries: Mapping[str, Traversable]) -> None:
        """Read them, by their paths on the server."""
        self._contents = {path: entry.read_bytes() for path, entry in entries.items()}

    def at(self, path: str) -> Response:
        """The one at this path."""
        return Response(self._contents[path], media_type=KINDS[Path(path).suffix])


async def answered(ask: Callable[[T], Any], given: T) -> Response:
    """What a function says, which is asked in another thread, as JSON; or why it cannot."""
    try:
        return JSONResponse(await run_in_threadpool(ask, given))
    except (ExecutiveError, ValueError, OSError) as error:
        return JSONResponse({"error": str(error)}, 404)


def board_events(board: Board, request: Request) -> Response:
    """All that is newer on a board than a page knows, and then what comes."""
    if board.readers >= MOST_PAGES:
        return PlainTextResponse("Too many pages are open.", 503)
    last = request.query_params.get("known", "")
    known = _known(board, request.headers.get("last-event-id", last))
    return StreamingResponse(news(board, known), media_type="text/event-stream")


def _picture(content: bytes | None, kind: str) -> Response:
    if content is None:
        return PlainTextResponse("There is no such picture.", 404)
    return Response(content, media_type=kind)


async def sent_json(request: Request) -> dict[str, Any]:
    """What a page sent, as a JSON object; an empty one if it is too long, or something else."""
    content = b""
    async for part in request.stream():
        content += part
        if len(content) > MOST_BYTES:
            return {}
    try:
        sent = json.loads(content)
    except (ValueError, RecursionError):
        return {}
    return sent if isinstance(sent, dict) else {}


def _known(board: Board, last: str) -> int:
    """The number of the last change that a page knows, of this board and no earlier one."""
    name, _, number = last.partition("-")
    return int(number) if name == board.name and number.isdecimal() else 0


async def news(board: Board, known: int) -> AsyncIterator[str]:
    """Server-sent events: all that is newer than a page knows, and then what comes, until it ends.

    A page that knows nothing of this board is told first to forget what it shows. Each is told when
    it has caught up: what comes then is news.
    """
    loop, changed = asyncio.get_running_loop(), asyncio.Event()

    def wake(after_s: float) -> None:
        if not loop.is_closed():
            loop.call_soon_threadsafe(loop.call_later, after_s, changed.set)

    board.wait_with(wake)
    try:
        yield f"retry: {RETRY_MS}\n\n"
        if not known:
            yield "event: fresh\ndata: {}\n\n"
        caught_up = False
        while True:
            changed.clear()
            over, told = board.over, ""
            for number, name, text in board.since(known):
                known, caught_up = number, caught_up and name != "fresh"
                told += f"id: {board.name}-{number}\nevent: {name}\ndata: {text}\n\n"
            if not caught_up and not over:
                caught_up = True
                told += "event: caught_up\ndata: {}\n\n"
            if told:
                yield told  # in one piece, so that the browser wakes and draws once
            if over:
                return
            try:
                async with asyncio.timeout(HEARTBEAT_S):
                    await changed.wait()
            except TimeoutError:
                yield "event: alive\ndata: {}\n\n"
    finally:
        board.wait_no_more(wake)
