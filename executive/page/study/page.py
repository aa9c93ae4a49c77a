"""The page of a study: what the participant reads and answers, and the person's page in between."""

import json
import queue
import threading
from collections.abc import Callable
from typing import Any

from starlette.requests import Request
from starlette.responses import JSONResponse, PlainTextResponse, Response
from starlette.routing import Route

from executive.events import Inbox
from executive.page.address import Address
from executive.page.page import Page
from executive.page.sink import PageSink
from executive.page.site import ASSETS
from executive.page.study.participant import Participant
from executive.page.study.showing import Shown

MOST_BYTES = 2**20
"""Of what a page sends: the longest answers to a questionnaire."""
SCRIPT = '<script type="module" src="page.js"></script>'
OURS = '<link rel="stylesheet" href="study.css">\n<script type="module" src="study.js"></script>\n'

Fault = Callable[[Any], str]
"""What is wrong with what the participant sent; empty if nothing is."""


class StudyPage(Page):
    """Serves both; what the participant does is waited for by the one who leads them."""

    person: Participant

    def __init__(
        self, address: Address | None = None, token: str = "", *, speech: bool = False
    ) -> None:
        """Serve at once; there is nothing to do yet.

        Raises:
            InputError: if the address cannot be had.
        """
        self._sent: queue.SimpleQueue[Any] = queue.SimpleQueue()
        self._lock = threading.Lock()
        self._awaited = ""
        self._fault: Fault = _nothing_wrong
        self._take: Callable[[Any], None] = self._sent.put
        self._shown: Shown = {}
        super().__init__(Inbox(), address, token, speech=speech)
        self.converse(Inbox())

    def converse(self, inbox: Inbox) -> Participant:
        """Begin a new conversation, with a robot that hears of it by this inbox."""
        if isinstance(self.person, Participant):
            self.person.dismiss()
        self.board.forget()
        self.sink = PageSink(self.board)
        self.person = Participant(inbox, self.board)
        if self.desk:
            self.desk.step_in(inbox, self.person)
        self.board.put("study", self._shown)
        self.board.flush()
        return self.person

    def show(self, shown: Shown, fault: Fault, take: Callable[[Any], None] | None = None) -> None:
        """Show a step, and take from now on what is done in it; `wait` waits for it by default."""
        with self._lock:
            self._awaited, self._fault, self._shown = shown["step"], fault, shown
            self._take = take or self._sent.put
        self.board.put("study", shown)
        self.board.flush()

    def wait(self) -> Any:
        """What the participant sent.

        Raises:
            KeyboardInterrupt: if nobody waits any more.
        """
        value = self._sent.get()
        if value is None:
            raise KeyboardInterrupt
        return value

    def interrupt(self) -> None:
        """Have nobody wait any more; from a signal handler, too."""
        self._sent.put(None)

    # --- what the server asks; in its own threads ---

    def sends(self, step: object, value: object) -> tuple[int, str]:
        """The participant did something in a step: a status of HTTP, and what to say to it."""
        with self._lock:
            if step != self._awaited:
                return 409, "This is over."
            if why := self._fault(value):
                return 422, why
            self._awaited = ""
        self._take(value)
        return 200, ""

    def own_routes(self) -> tuple[Route, ...]:
        """The page with the study around it, and what the participant does in that."""
        return Route("/", self._page), Route("/study", self._answer, methods=["POST"])

    async def _page(self, request: Request) -> Response:
        html = ASSETS["/index.html"].read_text("utf-8").replace(SCRIPT, OURS + SCRIPT)
        return Response(html, media_type="text/html")

    async def _answer(self, request: Request) -> Response:
        content = b""
        async for part in request.stream():
            content += part
            if len(content) > MOST_BYTES:
                return PlainTextResponse("This is too long.", 413)
        try:
            sent = json.loads(content)
            status, why = self.sends(sent["step"], sent["value"])
        except (ValueError, LookupError, TypeError, RecursionError):
            return PlainTextResponse("This is nothing that the page sends.", 400)
        return JSONResponse({}) if status == 200 else PlainTextResponse(why, status)


def _nothing_wrong(value: Any) -> str:
    return ""
