"""A robot that is talked with by its page, in this process; and a plain client of the page."""

import http.client
import json
import threading
import time
from collections.abc import Iterator
from contextlib import closing, contextmanager
from dataclasses import dataclass, field
from email.message import Message
from pathlib import Path
from typing import Any
from urllib.parse import parse_qs, urlencode, urlsplit

from patience import PATIENCE_S, until

from executive import Session, load_settings
from executive.app.embodiment import Embodiment, Setup
from executive.app.simulation import fake
from executive.events import Inbox
from executive.page.address import Address
from executive.page.page import Page
from executive.types.outcome import Outcome

TOKEN = "the-token"


@dataclass
class Robot:
    """One whose page is open.

    Attributes:
        page: its page.
        outcomes: how those ended that are over.
        ticks: how often each of them was ticked.
        over: is set when the person has ended the conversation.
    """

    page: Page
    outcomes: list[Outcome] = field(default_factory=list)
    ticks: list[int] = field(default_factory=list)
    over: threading.Event = field(default_factory=threading.Event)

    def ended(self, count: int) -> Outcome:
        """Wait until so many missions have ended and the robot listens again; how the last did."""
        until(lambda: len(self.outcomes) >= count, "the end of the mission")
        heard(self.page, "doing", state="ready")
        return self.outcomes[count - 1]

    def converse(self, session: Session) -> None:
        """Do what the person says, until they end it."""
        while (line := session.next_command(self.page.person)) is not None:
            if not session.talk(line):
                self.outcomes.append(session.run(line))
                self.ticks.append(session.ticks)
        self.over.set()


@contextmanager
def robot(
    runs: Path, *, recorded: bool = False, experimenter: bool = False, **settings: Any
) -> Iterator[Robot]:
    """A robot in the instant world whose page is served, in a conversation."""
    inbox = Inbox()
    given = {
        "world": "fake",
        "llm": "none",
        "search": "paper",
        "runs": runs,
        "answer_timeout_s": 3600.0,
        **settings,
    }
    with Page(inbox, Address(port=0, experimenter=experimenter), token=TOKEN) as page:
        made = Robot(page)

        def live() -> None:
            with Session(
                load_settings(**given),
                inbox=inbox,
                user=page.person,
                sinks=page.sinks,
                recorded=recorded,
            ) as session:
                page.follow(session)
                made.converse(session)

        thread = threading.Thread(target=live, daemon=True)
        thread.start()
        try:
            yield made
        finally:
            page.stops()
            page.says("quit")
            thread.join(PATIENCE_S)


@contextmanager
def page_alone() -> Iterator[Page]:
    """A page without a robot."""
    with Page(Inbox(), Address(port=0), token=TOKEN) as page:
        yield page


def in_real_time(setup: Setup) -> Embodiment:
    """The instant world, in which everything takes its time: for who wants to interfere.

    `--world` names it.
    """
    body = fake(setup)
    open_ = setup.inbox.open
    setup.inbox.open = lambda *, real=False: open_(real=True)  # type: ignore[method-assign]
    return body


# --- the wire ---


@dataclass
class Answer:
    """What the page's server answered."""

    status: int
    headers: Message
    body: bytes


@dataclass
class Told:
    """One server-sent event."""

    number: str
    name: str
    value: Any


def ask(page: Page, path: str, **given: Any) -> Answer:
    """What the page's server answers; see `_sent`."""
    connection = _sent(page, path, **given)
    with closing(connection), connection.getresponse() as answer:
        return Answer(answer.status, answer.headers, answer.read())


def post(page: Page, path: str, value: Any, **given: Any) -> int:
    """Send JSON; the status."""
    return ask(page, path, method="POST", body=json.dumps(value).encode(), **given).status


def step_in(page: Page, deed: str, *, status: int = 200, by: str = "Anna", **values: Any) -> Any:
    """Do something as an experimenter; what the server says."""
    body = json.dumps({"deed": deed, "by": by, **values}).encode()
    given = {"method": "POST", "body": body, "token": their_token(page)}
    answer = ask(page, "/experiment/intervene", **given)
    assert answer.status == status, answer.body
    return json.loads(answer.body)


def notice(page: Page, name: str, **values: Any) -> Any:
    """What the experimenter's page is told."""
    return heard(page, name, token=their_token(page), path="/experiment/events", **values)


def their_token(page: Page) -> str:
    """That of the experimenter."""
    return parse_qs(urlsplit(page.experimenter_url).query)["token"][0]


def told(page: Page, **given: Any) -> Iterator[Told]:
    """What a page is told, as it comes, for a while; `given` as for `ask`."""
    connection = _sent(page, given.pop("path", "/events"), **given)
    with closing(connection), connection.getresponse() as answer:
        fields: dict[str, str] = {}
        latest = time.monotonic() + PATIENCE_S
        while time.monotonic() < latest and (raw := answer.readline()):
            line = raw.decode().rstrip("\n")
            if line:
                key, _, value = line.partition(": ")
                fields[key] = value
            elif "event" in fields:
                yield Told(fields.get("id", ""), fields["event"], json.loads(fields["data"]))
                fields = {}


def heard(
    page: Page, name: str, *, token: str = TOKEN, path: str = "/events", **values: Any
) -> Any:
    """The first of this name that a page is told, and that has these values."""
    with closing(told(page, token=token, path=path)) as reading:
        for one in reading:
            if one.name == name and one.value and values.items() <= one.value.items():
                return one.value
    raise AssertionError(f"no {name} like {values}")


def _sent(
    page: Page,
    path: str,
    *,
    method: str = "GET",
    body: bytes | None = None,
    token: str = TOKEN,
    headers: dict[str, str] | None = None,
    **query: Any,
) -> http.client.HTTPConnection:
    """Send a request; a POST with the page's own origin, unless it has other headers."""
    parts = urlsplit(page.url)
    connection = http.client.HTTPConnection(parts.hostname or "", parts.port, timeout=PATIENCE_S)
    own = {"origin": f"http://{parts.netloc}"} if method == "POST" else {}
    where = f"{path}?{urlencode({**query, 'token': token})}"
    connection.request(method, where, body, own if headers is None else headers)
    return connection
