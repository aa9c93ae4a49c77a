"""What an error of the network says, in words."""

import os
import socket
import ssl

DEEPEST = 16
"""Errors behind an error."""


def why(error: BaseException) -> str:
    """What lies at the root of it."""
    root, seen = error, 0
    while (under := root.__cause__ or root.__context__) and seen < DEEPEST:
        root, seen = under, seen + 1
    match root:
        case ssl.SSLCertVerificationError():
            return f"its certificate is not trusted ({root.verify_message})"
        case ssl.SSLError():
            return "it does not speak HTTPS; try http://"
        case socket.gaierror():
            return "there is no such host"
        case OSError() if root.errno:
            return os.strerror(root.errno)
        case _:
            return str(error) or type(error).__name__
