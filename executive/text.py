"""Text from outside, made fit to be written down."""


def writable(text: str) -> str:
    """The text with whole characters only: every log is UTF-8, which has no halves.

    A byte that is no UTF-8, or half of a surrogate pair (JSON may spell one), becomes U+FFFD; two
    halves that came one after the other become the character that they are.
    """
    return text.encode("utf-16", "surrogatepass").decode("utf-16", "replace")
