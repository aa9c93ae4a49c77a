"""Chats for models that support no system turn, such as Gemma 2."""

from collections.abc import Sequence
from dataclasses import replace

from executive.types.llm import Message


def without_system(chat: Sequence[Message]) -> tuple[Message, ...]:
    """The chat with the content of its system turns at the start of the first user turn.

    If there is no user turn, one with this content comes first.
    """
    system = [turn.content for turn in chat if turn.role == "system"]
    others = [turn for turn in chat if turn.role != "system"]
    first = next((i for i, turn in enumerate(others) if turn.role == "user"), None)
    if not system:
        return tuple(chat)
    if first is None:
        return (Message("user", "\n\n".join(system)), *others)
    asked = others[first]
    others[first] = replace(asked, content="\n\n".join([*system, asked.content]))
    return tuple(others)
