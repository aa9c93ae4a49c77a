"""Why there is no connection, as a clause that says what would be right where that is known."""

import os
import ssl

from websockets.exceptions import (
    ConnectionClosed,
    InvalidHandshake,
    InvalidMessage,
    InvalidStatus,
)
from websockets.frames import Close, CloseCode
from websockets.http11 import Response

from executive.guards import in_words
from executive.ros.address import HEADERS
from executive.ros.packets import MOST_BYTES
from executive.servers.address import without_secrets
from executive.text import printable

WHICH = "does it speak TLS? ws:// is without, wss:// with"
TRUSTED = "SSL_CERT_FILE"
"""Environment variable of OpenSSL's."""
NOBODY_SIGNED = (18, 19, 20, 21)
"""OpenSSL's codes for a certificate that leads to no authority that is trusted here."""


def why_lost(error: Exception) -> str:
    """What an exception says about a connection that ended, or that there could not be."""
    match error:
        case ConnectionClosed(sent=Close(code=CloseCode.MESSAGE_TOO_BIG)):
            return f"it sent a message of more than {MOST_BYTES:,} bytes"
        case ConnectionClosed():
            return "it broke off"
        case TimeoutError():
            return "nobody answers (is rosbridge started there?)"
        case ConnectionRefusedError():
            return "nobody listens there (is rosbridge started?)"
        case ConnectionResetError():
            return f"it hangs up at once ({WHICH})"
        case InvalidStatus():
            return _why_not_let_in(error.response)
        case InvalidMessage():
            return f"what answers there is no websocket ({WHICH})"
        case InvalidHandshake():
            return f"it was not let in: {in_words(error)}"
        case ssl.SSLCertVerificationError():
            return _why_not_trusted(error)
        case ssl.SSLError():
            return "it does not speak TLS as it should (ws:// is without)"
        case OSError() if error.strerror:
            return printable(error.strerror).lower()
        case _:
            return in_words(error)


def _why_not_let_in(answer: Response) -> str:
    """By what the door says, in the numbers of HTTP."""
    match answer.status_code:
        case 301 | 302 | 303 | 307 | 308 if there := answer.headers.get_all("Location"):
            return f"it sends to {printable(without_secrets(there[0]))[:200]}; give that address"
        case 401 | 403 as status:
            return f"it was not let in (HTTP {status}): what the door asks for goes into {HEADERS}"
        case 502 | 503 | 504 as status:
            return f"the door is there, but the robot behind it is not (HTTP {status})"
        case status:
            return f"there is no websocket at this address (HTTP {status})"


def _why_not_trusted(error: ssl.SSLCertVerificationError) -> str:
    said = printable(error.verify_message).rstrip(".")
    clause = f"its certificate is not trusted ({said})"
    if error.verify_code not in NOBODY_SIGNED:
        return clause
    named = printable(os.environ.get(TRUSTED, ""))
    now = f", and not {named}" if named else ""
    return f"{clause}: if it should be, the environment variable {TRUSTED} names its file{now}"
