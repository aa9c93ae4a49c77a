"""A door with TLS before a websocket server, as a proxy on a robot would have it."""

import asyncio
import shutil
import ssl
import subprocess
import threading
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from urllib.parse import urlsplit

import pytest
from patience import PATIENCE_S


def certificate(folder: Path, of: str = "IP:127.0.0.1") -> Path:
    """A file with a certificate of this host that nobody signed, and its key."""
    if (openssl := shutil.which("openssl")) is None:
        pytest.skip("needs openssl")
    key, cert = folder / "key.pem", folder / "cert.pem"
    kind = ("req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:prime256v1", "-nodes")
    names = ("-subj", "/CN=robot", "-addext", f"subjectAltName={of}", "-days", "2")
    into = ("-keyout", str(key), "-out", str(cert))
    subprocess.run([openssl, *kind, *names, *into], check=True, capture_output=True)
    cert.write_text(cert.read_text() + key.read_text())
    return cert


@contextmanager
def tls_before(url: str, cert: Path) -> Iterator[str]:
    """The address of a door before the server at `url`."""
    context = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
    context.load_cert_chain(cert)
    port = urlsplit(url).port
    loop, started, over = asyncio.new_event_loop(), threading.Event(), asyncio.Event()
    at: list[int] = []

    async def carry(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        with suppress(OSError):
            while content := await reader.read(2**16):
                writer.write(content)
                await writer.drain()
        writer.close()

    async def talk(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        there, to = await asyncio.open_connection("127.0.0.1", port)
        await asyncio.gather(carry(reader, to), carry(there, writer))

    async def serve() -> None:
        server = await asyncio.start_server(talk, "127.0.0.1", 0, ssl=context)
        at.append(server.sockets[0].getsockname()[1])
        started.set()
        await over.wait()
        server.close()

    thread = threading.Thread(target=_run, args=(loop, serve), daemon=True)
    thread.start()
    assert started.wait(PATIENCE_S)
    try:
        yield f"wss://127.0.0.1:{at[0]}"
    finally:
        loop.call_soon_threadsafe(over.set)
        thread.join(PATIENCE_S)


def _run(loop: asyncio.AbstractEventLoop, serve: object) -> None:
    with asyncio.Runner(loop_factory=lambda: loop) as runner:
        runner.run(serve())  # type: ignore[operator]
