"""A stand-in for a language model: it says what it was told to say."""

from collections import deque
from collections.abc import Iterable, Sequence

from executive.events import Inbox
from executive.types.llm import ChatRequest, RankRequest, Usage
from executive.types.results import Failed, Replied, Result, Scored

Reply = str | Sequence[float] | None


class Scripted:
    """Implements `LanguageModel` with replies that were written before; each request ends at once.

    A text answers `chat`, numbers answer `rank`, and None is a model that never answers. Without a
    fitting reply a request ends Failed. `requests` holds what was asked, oldest first.
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
        """Give the replies in the order in which they will be asked for."""
        self.can_rank = can_rank
        self.context_tokens = context_tokens
        self.requests: list[ChatRequest | RankRequest] = []
        self._replies = deque(replies)
        self._inbox = inbox

    def chat(self, request: ChatRequest) -> int:
        """Say the next reply; ends Replied, or Failed."""
        return self._answer(request)

    def rank(self, request: RankRequest) -> int:
        """Give the next scores; ends Scored, or Failed."""
        return self._answer(request)

    def prepare(self, request: ChatRequest | RankRequest) -> None:
        """Nothing to prepare."""

    def cancel(self, request: int) -> None:
        """Forget the request."""
        self._inbox.drop(request)

    def count_tokens(self, text: str) -> int:
        """How many words the text has."""
        return len(text.split())

    def close(self) -> None:
        """Nothing to free."""

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
