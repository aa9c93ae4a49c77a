"""Text from outside, made fit to be written down; text for others, who may have read enough."""

import os
import sys
from collections.abc import Callable


def writable(text: str) -> str:
    """The text with whole characters only: every log is UTF-8, which has no halves.

    A byte that is no UTF-8, or half of a surrogate pair (JSON may spell one), becomes U+FFFD; two
    halves that came one after the other become the character that they are.
    """
    return text.encode("utf-16", "surrogatepass").decode("utf-16", "replace")


def piped(main: Callable[[], int]) -> int:
    """Run a command whose output may be piped; if the reader (`head`) leaves, end in silence."""
    try:
        status = main()
        sys.stdout.flush()
        return status
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 1
