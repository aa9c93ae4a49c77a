"""The page as a whole: what is shown, who speaks, and the server between."""

import secrets
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Self

from starlette.routing import Route

from executive.app.speaking import vocabulary
from executive.errors import InputError
from executive.events import Inbox
from executive.language.phrases import spoken
from executive.language.wording import Wording
from executive.page.address import Address
from executive.page.board import Board
from executive.page.experiment.desk import Desk
from executive.page.experiment.runs import Runs
from executive.page.experiment.site import PUBLIC as EXPERIMENT_PUBLIC
from executive.page.experiment.site import ROOT, experiment_site
from executive.page.guarding import Guard, Site, parted
from executive.page.hearing import Alternative
from executive.page.person import PagePerson
from executive.page.plan import plan
from executive.page.portraits import Portraits
from executive.page.serving import Server
from executive.page.sink import PageSink
from executive.page.site import PUBLIC, site
from executive.page.why import why_said
from logs.recorder import Sink

if TYPE_CHECKING:
    from executive.app.session import Session


class Page:
    """The person's page, to be used in a `with` block, inside of which it is served.

    It is there before the robot is: `person` and `sink` are for the session, which is shown with
    `follow` when it is built.
    """

    def __init__(
        self,
        inbox: Inbox,
        address: Address | None = None,
        token: str = "",
        *,
        speech: bool = True,
    ) -> None:
        """Serve at once; the token is chosen if none is given.

        With `speech`, the person may have their browser listen and speak.

        Raises:
            InputError: if the address cannot be had.
        """
        address = address or Address()
        token = token or secrets.token_urlsafe(16)
        self.speech = speech
        self._server = Server(address)
        self.url = address.url(self._server.port, token)
        """What to open in a browser."""
        self.board = Board()
        self.sink = PageSink(self.board)
        self.person = PagePerson(inbox, self.board)
        self._portraits = Portraits({})
        self._runs: Runs | None = None
        guarded: Site = Guard(site(self), token, address.host, PUBLIC)
        self.desk = Desk() if address.experimenter else None
        """Behind the experimenter's page; None if there is none."""
        self.experimenter_url = ""
        """What the experimenter opens; empty if there is no such page."""
        if self.desk:
            self.desk.step_in(inbox, self.person)
            own = secrets.token_urlsafe(16)
            self.experimenter_url = address.url(self._server.port, own, ROOT)
            theirs = Guard(experiment_site(self.desk), own, address.host, EXPERIMENT_PUBLIC)
            guarded = parted(ROOT, theirs, guarded)
        self._server.start(guarded)

    def __enter__(self) -> Self:
        """Nothing more to open."""
        return self

    def __exit__(self, *_: object) -> None:
        """Close."""
        self.close()

    def close(self) -> None:
        """Tell the open pages that it is over, and serve no more."""
        self.board.put("doing", {"state": "over"})
        self.board.put("question", None)
        self.board.end()
        if self.desk:
            self.desk.board.end()
        self._server.close()

    def follow(self, session: "Session") -> None:
        """Show the home and the missions of this session."""
        home = session.parts.home
        wording = Wording(session.parts.knowledge.called)
        self._runs = Runs(session.settings.runs)
        self._portraits = Portraits(home.drawn_models())
        self.board.put("home", plan(home, wording))
        self.board.put("things", _things(session, self._portraits))
        known = vocabulary(session.parts.knowledge)
        self.person.follow(session, (*known.things, *known.places))
        self.board.put("speech", self.speech)
        self.board.flush()
        if self.desk:
            self.desk.live.name = lambda: session.folder.name if session.folder else ""
            self.desk.look_in(session.settings.runs)
            if self.desk.wizard:
                self.desk.wizard.know({p.name: wording.label(p.name) for p in home.furniture})
                session.standing = self.desk.wizard.standing

    @property
    def sinks(self) -> tuple[Sink, ...]:
        """The logs that show missions, for the session."""
        return (self.sink, self.desk.live) if self.desk else (self.sink,)

    # --- what the server asks; in its own threads ---

    def own_routes(self) -> tuple[Route, ...]:
        """What is answered besides the page, or in its place."""
        return ()

    def says(self, words: str) -> None:
        """The person sent words."""
        self.person.says(words)

    def answers(self, words: str, question: int) -> bool:
        """The person chose an answer of this question; False if that is over."""
        return self.person.answers(words, question)

    def hears(self, heard: Sequence[Alternative], utterance: str, *, final: bool) -> str:
        """The person's browser heard this: what became of it; empty if it should not listen."""
        return self.person.hears(heard, utterance, final=final) if self.speech else ""

    def settles(self, number: int, *, agrees: bool) -> bool:
        """The person said yes or no to what was asked back; False if that is over."""
        return self.person.settles(number, agrees=agrees)

    def stops(self) -> None:
        """The person pressed the stop button."""
        self.person.stops()

    def picture(self, number: int) -> bytes | None:
        """One of the latest pictures of the camera, as JPEG."""
        return self.sink.picture(number)

    def portrait(self, name: str) -> bytes | None:
        """A picture of a thing, as PNG."""
        return self._portraits.png(name)

    def why(self, run: str, time_s: float) -> list[dict[str, Any]]:
        """The decisions behind a sentence.

        Raises:
            InputError: if there is no such run.
        """
        if self._runs is None:
            raise InputError("run", "there is no such run")
        return why_said(self._runs.path(run), time_s)


def _things(session: "Session", portraits: Portraits) -> dict[str, dict[str, Any]]:
    """What the robot may be asked for: how it is called, and whether there is a picture of it."""
    pictured = set(portraits.names())
    return {
        name: {"label": spoken(name), "picture": name in pictured}
        for name in session.parts.knowledge.objects()
    }
