"""The list of past runs without a robot: the experimenter's page, in which nothing runs."""

import secrets
from pathlib import Path
from typing import Self

from starlette.applications import Starlette
from starlette.requests import Request
from starlette.responses import Response
from starlette.routing import Route

from executive.errors import InputError
from executive.page.address import Address
from executive.page.experiment.desk import Desk
from executive.page.experiment.site import PUBLIC as THEIR_PUBLIC
from executive.page.experiment.site import ROOT, experiment_site
from executive.page.guarding import Guard, parted
from executive.page.serving import Server
from executive.page.site import ASSETS, PUBLIC, Files
from logs.recording.reader import FILE_NAME


class PastRuns:
    """Serves the runs of a folder, to be used in a `with` block."""

    def __init__(self, folder: Path, address: Address, token: str = "") -> None:
        """Serve at once; the token is chosen if none is given.

        Raises:
            InputError: if it is no folder of runs, or the address cannot be had.
        """
        check(folder)
        token = token or secrets.token_urlsafe(16)
        self._server = Server(address)
        self.url = address.url(self._server.port, token, ROOT)
        """What to open in a browser."""
        self.desk = Desk()
        self.desk.look_in(folder)
        self.desk.board.put("past", {"folder": str(folder)})
        theirs = Guard(experiment_site(self.desk), token, address.host, THEIR_PUBLIC)
        shared = Guard(_shared(), token, address.host, PUBLIC)
        self._server.start(parted(ROOT, theirs, shared))

    def __enter__(self) -> Self:
        """Nothing more to open."""
        return self

    def __exit__(self, *_: object) -> None:
        """Serve no more."""
        self.desk.board.end()
        self._server.close()


def check(folder: Path) -> None:
    """See that runs may be in this folder.

    Raises:
        InputError: if it is none, or is itself one run.
    """
    if not folder.is_dir():
        right = "give the folder that missions were recorded into, as --runs had it"
        raise InputError(str(folder), "there is no such folder", right)
    if (folder / FILE_NAME).is_file():
        raise InputError(str(folder), "is one run", f"give the folder it is in: {folder.parent}")


def _shared() -> Starlette:
    """The files that the experimenter's page has in common with the person's."""
    files = Files(ASSETS)

    async def file(request: Request) -> Response:
        return files.at(request.url.path)

    return Starlette(routes=[Route(path, file) for path in sorted(PUBLIC)])
