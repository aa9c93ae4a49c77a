"""How the page is served: from a socket, by a thread of its own."""

import socket
import threading

import uvicorn

from executive.errors import InputError
from executive.page.address import Address
from executive.page.guarding import Site

CLOSED_S = 1.0
"""How long the pages may take to be told that it is over."""


class Server:
    """Serves a site until it is closed."""

    def __init__(self, address: Address) -> None:
        """Take the port; nothing is answered yet.

        Raises:
            InputError: if it cannot be had.
        """
        address.checked()
        self._address = address
        self._socket = _bound(address)
        self.port: int = self._socket.getsockname()[1]
        self._server: uvicorn.Server | None = None
        self._thread: threading.Thread | None = None

    def start(self, site: Site) -> None:
        """Answer from now on."""
        address = self._address
        config = uvicorn.Config(
            site,
            log_config=None,
            log_level="warning",
            access_log=False,
            lifespan="off",
            ws="none",
            server_header=False,
            timeout_graceful_shutdown=1,
            ssl_certfile=address.certificate,
            ssl_keyfile=address.key,
        )
        self._server = uvicorn.Server(config)
        self._thread = threading.Thread(
            target=self._server.run, args=[[self._socket]], name="page", daemon=True
        )
        self._thread.start()

    def close(self) -> None:
        """Answer no more."""
        if self._server and self._thread:
            self._server.should_exit = True
            self._thread.join(CLOSED_S)
        self._socket.close()


def _bound(address: Address) -> socket.socket:
    try:
        found = socket.getaddrinfo(address.host, address.port, type=socket.SOCK_STREAM)
        family, _, _, _, where = found[0]
        # asyncio sends at once (TCP_NODELAY) only by what says that it is TCP; else an answer in
        # two parts waits 40 ms for the receipt of the first
        listening = socket.socket(family, socket.SOCK_STREAM, socket.IPPROTO_TCP)
        listening.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            listening.bind(where)
            listening.listen()  # two may be bound to a port before one listens
        except OSError:
            listening.close()
            raise
        return listening
    except (OSError, OverflowError, UnicodeError) as error:
        why = getattr(error, "strerror", None) or "it is no address"
        where_ = f"{address.host}:{address.port}"
        right = "give another port, as in --page 8081; --page-address has to be of this machine"
        raise InputError("--page", f"{where_} cannot be had: {why}", right) from None
