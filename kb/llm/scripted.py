"""A scripted stand-in for a language model."""

from collections import deque
from collections.abc import Iterable, Sequence

from executive.events import Inbox
from executive.types.llm import ChatRequest, RankRequest, Usage
from executive.types.results import Failed, Replied, Result, Scored

Reply = str | Sequence[float] | None


class Scripted:
    """Implements `LanguageModel` with prepared replies; each request ends at once.

    A text answers `chat`, numbers answer `rank`; for None, no answer ever comes. Without a fitting
    reply, a request ends Failed. `requests` holds all requests, oldest first.
    """

    name = "scripted"

    def __init__(
        self,
        replies: Iterable[Reply],
        inbox: Inbox,
        *,
        can_rank: bool = True,
        context_tokens: int = 4096,
    ) -> None:
        """`replies` are given in order."""
        self.can_rank = can_rank
        self.context_tokens = context_tokens
        self.requests: list[ChatRequest | RankRequest] = []
        self._replies = deque(replies)
        self._inbox = inbox

    def chat(self, request: ChatRequest) -> int:
        """Give the next text; ends Replied, or Failed."""
        return self._answer(request)

    def rank(self, request: RankRequest) -> int:
        """Give the next scores; ends Scored, or Failed."""
        return self._answer(request)

    def prepare(self, request: ChatRequest | RankRequest) -> None:
        """Does nothing."""

    def cancel(self, request: int) -> None:
        """Drop the request."""
        self._inbox.drop(request)

    def count_tokens(self, text: str) -> int:
        """Number of words of the text."""
        return len(text.split())

    def close(self) -> None:
        """Does nothing."""

    def _answer(self, request: ChatRequest | RankRequest) -> int:
        self.requests.append(request)
        number = self._inbox.open()
        if not self._replies:
            self._inbox.end(number, Failed("the script has no more replies"))
        elif (reply := self._replies.popleft()) is not None:
            self._inbox.end(number, self._result(request, reply))
        return number

    def _result(self, request: ChatRequest | RankRequest, reply: str | Sequence[float]) -> Result:
        read = sum(self.count_tokens(message.content) for message in request.messages)
        match request, reply:
            case ChatRequest(), str():
                return Replied(request, reply, Usage(self.name, read, read, len(reply.split())))
            case RankRequest(), [*scores] if len(scores) == len(request.options):
                return Scored(request, tuple(scores), Usage(self.name, read, read))
            case _:
                return Failed(f"the script's next reply, {reply!r}, does not fit the request")
