"""The key of a language model's server: from the environment only, and never anywhere else."""

import os

from executive.errors import InputError

VARIABLE = "EXECUTIVE_LLM_API_KEY"
SHORTEST = 6
"""Characters of what is taken for a secret: a shorter one could be any word."""
HIDDEN = "***"


class Key:
    """A key, or none. It shows itself in the header of a request only."""

    def __init__(self, secret: str | None = None) -> None:
        """Keep it.

        Raises:
            InputError: if it cannot be sent; what it is, is not said.
        """
        secret = (secret or "").strip()
        if not all("!" <= character <= "~" for character in secret):
            raise InputError(VARIABLE, "has characters that no key has", "give the key alone")
        self.__secret = secret

    @classmethod
    def from_environment(cls) -> "Key":
        """The one that EXECUTIVE_LLM_API_KEY holds, or none."""
        return cls(os.environ.get(VARIABLE))

    def __bool__(self) -> bool:
        """Whether there is one."""
        return bool(self.__secret)

    def __repr__(self) -> str:
        """Nothing of it."""
        return f"Key({HIDDEN if self.__secret else ''})"

    def headers(self) -> dict[str, str]:
        """What a request says with it."""
        return {"Authorization": f"Bearer {self.__secret}"} if self.__secret else {}

    def hidden_in(self, text: str) -> str:
        """A text from a server, which may repeat what it was sent, without the key."""
        return text.replace(self.__secret, HIDDEN) if len(self.__secret) >= SHORTEST else text
