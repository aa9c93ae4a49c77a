"""A model's chat template: formats a chat as the model was trained to read it."""

from collections.abc import Sequence
from typing import Any

from llama_cpp.llama_chat_format import Jinja2ChatFormatter

from executive.errors import ModelError
from executive.text import printable
from executive.types.llm import Message
from kb.llm.turns import without_system

LONGEST_FAULT = 200
MOST_MARKUP = 100_000
"""Characters that a template may add to a chat."""

_SYSTEM, _USER = "You know a home well.", "Where is the mug?"
_CHATS = (
    (Message("system", _SYSTEM), Message("user", _USER)),
    (
        Message("system", _SYSTEM),
        Message("user", "Where is the hammer?"),
        Message("assistant", "Here."),
        Message("user", _USER),
    ),
)


class Template:
    """Fills in a chat template, in jinja's sandbox.

    If it supports no system turn, what that says is put into the user's first turn.
    """

    def __init__(self, text: str, begin: str, end: str) -> None:
        """Parse the template and test it.

        Args:
            text: the template.
            begin: markup of the token that begins a text.
            end: markup of the token that ends one.

        Raises:
            ModelError: if it cannot be parsed, rejects plain chats, or omits the content of turns.
        """
        try:
            self._formatter = Jinja2ChatFormatter(text, eos_token=end, bos_token=begin)
        except Exception as error:
            raise ModelError(f"its chat template cannot be read: {_shortly(error)}") from None
        self._knows_system = True
        if not self._says(_SYSTEM, _USER):
            self._knows_system = False
            for chat in _CHATS:
                self.fill(chat)
            if not self._says(_SYSTEM, _USER):
                raise ModelError("its chat template leaves out what is said")

    def fill(self, chat: Sequence[Message]) -> str:
        """The chat as one text, up to the start of the model's next turn.

        Raises:
            ModelError: if the template raises, or the text is far too long.
        """
        chat = chat if self._knows_system else without_system(chat)
        turns: Any = [{"role": turn.role, "content": turn.content} for turn in chat]
        try:
            text = str(self._formatter(messages=turns).prompt)
        except Exception as error:
            fault = f"the model's chat template refuses the prompt: {_shortly(error)}"
            raise ModelError(fault) from None
        if len(text) > MOST_MARKUP + 2 * sum(len(turn.content) for turn in chat):
            raise ModelError("the model's chat template has no end")
        return text

    def _says(self, *parts: str) -> bool:
        """Whether the text of each test chat contains all these parts."""
        try:
            return all(part in self.fill(chat) for chat in _CHATS for part in parts)
        except ModelError:
            return False


def _shortly(error: Exception) -> str:
    return printable(str(error) or type(error).__name__)[:LONGEST_FAULT]
