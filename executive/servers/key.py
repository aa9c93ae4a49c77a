"""The key of a model's server: from the environment only, and never anywhere else."""

import os

from executive.errors import InputError

LLM_KEY, EARS_KEY = "EXECUTIVE_LLM_API_KEY", "EXECUTIVE_EARS_API_KEY"
"""The variables of the environment."""
SHORTEST = 6
"""Characters of what is taken for a secret: a shorter one could be any word."""
HIDDEN = "***"


class Key:
    """A key, or none. It shows itself in the header of a request only."""

    def __init__(self, secret: str | None = None, variable: str = LLM_KEY) -> None:
        """Keep it; it came from this variable of the environment.

        Raises:
            InputError: if it cannot be sent; what it is, is not said.
        """
        secret = (secret or "").strip()
        if not all("!" <= character <= "~" for character in secret):
            raise InputError(variable, "has characters that no key has", "give the key alone")
        self.__secret = secret

    @classmethod
    def from_environment(cls, variable: str = LLM_KEY) -> "Key":
        """The one that this variable holds, or none."""
        return cls(os.environ.get(variable), variable)

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
