"""The dialogue with the language model, limited to what fits into its context window."""

from collections import deque
from collections.abc import Callable

from executive.types.llm import Message

_SHARE_OF_CONTEXT = 0.5
_SHARE_OF_DIALOGUE = 0.8


def history_budget(context_tokens: int, system_tokens: int) -> int:
    """Token budget of the history: (context / 2 - system prompt) * 0.8.

    From the paper's section "Memory": half of the window is reserved for the reply, and a fifth of
    the rest for the inquiry.
    """
    free = context_tokens * _SHARE_OF_CONTEXT - system_tokens
    return max(0, int(free * _SHARE_OF_DIALOGUE))


class DialogueHistory:
    """Exchanges, oldest first; the oldest are dropped as a whole to stay within the budget."""

    def __init__(self, budget: int, count: Callable[[str], int]) -> None:
        """Remember at most `budget` tokens, counted by `count`."""
        self._budget = budget
        self._count = count
        self._exchanges: deque[tuple[int, Message, Message]] = deque()

    def add(self, inquiry: str, reply: str) -> None:
        """Add an exchange, and drop the oldest ones beyond the budget."""
        tokens = self._count(inquiry) + self._count(reply)
        self._exchanges.append((tokens, Message("user", inquiry), Message("assistant", reply)))
        while self.tokens > self._budget:
            self._exchanges.popleft()

    @property
    def tokens(self) -> int:
        """Number of tokens of the history."""
        return sum(tokens for tokens, _, _ in self._exchanges)

    def messages(self) -> tuple[Message, ...]:
        """The history as chat turns, oldest first."""
        return tuple(turn for _, *turns in self._exchanges for turn in turns)
