"""What the server answers to the experimenter's page."""

from collections.abc import Awaitable, Callable
from typing import Any

from starlette.applications import Starlette
from starlette.requests import Request
from starlette.responses import Response
from starlette.routing import Route

from executive.errors import InputError
from executive.page.experiment.desk import Desk
from executive.page.site import Files, answered, assets_of, board_events, sent_json

ROOT = "/experiment"
ASSETS = assets_of("executive.page.experiment", ROOT)
PUBLIC = frozenset(ASSETS)
"""What needs no token: it is the same for everyone."""
LONGEST = 300
"""Of a word to search for, or a name (characters)."""

Answer = Callable[[Request], Awaitable[Response]]


def experiment_site(desk: Desk) -> Starlette:
    """The application, still open to all: `Guard` comes around it."""
    asked: dict[str, Callable[[Request], Any]] = {
        "runs": lambda r: desk.runs(_word(r, "words"), _word(r, "status")),
        "run": lambda r: desk.run(
            _word(r, "run"), _perhaps(r, "known") or 0, anew=_word(r, "anew") != ""
        ),
        "step": lambda r: desk.step(_word(r, "run"), _number(r, "step"), _perhaps(r, "shown")),
        "lines": lambda r: desk.lines(
            _word(r, "run"), _number(r, "step"), _word(r, "kinds"), _word(r, "words")
        ),
        "node": lambda r: desk.node(_word(r, "run"), _number(r, "step"), _number(r, "node")),
        "call": lambda r: desk.call(_word(r, "run"), _number(r, "call")),
        "parting": lambda r: desk.parting(_word(r, "one"), _word(r, "other")),
    }
    told: dict[str, Callable[[dict[str, Any]], Any]] = {
        "replay": lambda sent: desk.replay(_text(sent, "run")),
        "intervene": desk.intervene,
        "view": lambda sent: desk.view(_text(sent, "run")),
    }
    assets = Files(ASSETS)

    async def file(request: Request) -> Response:
        path = request.url.path
        return assets.at(f"{ROOT}/index.html" if path == ROOT else path)

    async def events(request: Request) -> Response:
        return board_events(desk.board, request)

    return Starlette(
        routes=[
            *(Route(path, file) for path in (ROOT, *sorted(PUBLIC))),
            Route(f"{ROOT}/events", events),
            *(Route(f"{ROOT}/{name}", _asking(ask)) for name, ask in asked.items()),
            *(
                Route(f"{ROOT}/{name}", _telling(tell), methods=["POST"])
                for name, tell in told.items()
            ),
        ]
    )


def _asking(ask: Callable[[Request], Any]) -> Answer:
    async def answer(request: Request) -> Response:
        return await answered(ask, request)

    return answer


def _telling(tell: Callable[[dict[str, Any]], Any]) -> Answer:
    async def answer(request: Request) -> Response:
        return await answered(tell, await sent_json(request))

    return answer


def _word(request: Request, name: str) -> str:
    return request.query_params.get(name, "")[:LONGEST]


def _text(sent: dict[str, Any], name: str) -> str:
    value = sent.get(name)
    return value if isinstance(value, str) else ""


def _number(request: Request, name: str) -> int:
    word = _word(request, name)
    try:
        return int(word[:12])
    except ValueError:
        raise InputError(name, f"is {word[:12]!r}", "give a whole number") from None


def _perhaps(request: Request, name: str) -> int | None:
    return _number(request, name) if _word(request, name) else None
