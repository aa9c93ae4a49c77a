"""A language model that takes no mission time, so that results do not depend on the machine."""

from executive.computing import Computation, GivenUpError, Worker, still_wanted
from executive.events import Ended, Inbox
from executive.interfaces.llm import LanguageModel
from executive.types.llm import ChatRequest, RankRequest
from executive.types.results import Result, Scored

POLL_S = 0.2
"""How often to check whether the request was dropped (real seconds)."""

_known: dict[tuple[str, RankRequest], Scored] = {}
"""Cache of rankings, by model and request: a ranking is deterministic."""


class Timeless:
    """Implements `LanguageModel` around another one, during which mission time stands still."""

    def __init__(self, model: LanguageModel, within: Inbox, inbox: Inbox) -> None:
        """Wrap `model`, which ends its requests in the inbox `within`; ours end in `inbox`."""
        self._model = model
        self._within = within
        self._inbox = inbox
        self._worker = Worker("timeless model")
        self.name = model.name
        self.context_tokens = model.context_tokens
        self.can_rank = model.can_rank

    def chat(self, request: ChatRequest) -> int:
        """Start to write a reply; ends Replied, or Failed."""
        return self._ask(request)

    def rank(self, request: RankRequest) -> int:
        """Start to score the options; ends Scored, or Failed. Results are cached."""
        if scored := _known.get((self.name, request)):
            number = self._inbox.open()
            self._inbox.end(number, scored)
            return number
        return self._ask(request)

    def prepare(self, request: ChatRequest | RankRequest) -> None:
        """Do nothing: it need not be fast."""

    def cancel(self, request: int) -> None:
        """Drop the request, and abandon its computation."""
        self._inbox.drop(request)

    def count_tokens(self, text: str) -> int:
        """Length of a text in tokens, by the model's tokenizer."""
        return self._model.count_tokens(text)

    def close(self) -> None:
        """Free the model."""
        self._worker.close()
        self._model.close()

    def _ask(self, request: ChatRequest | RankRequest) -> int:
        number = self._inbox.open()

        def sequel(computation: Computation[Result]) -> None:
            self._inbox.end(number, computation.result())

        self._inbox.compute(self._worker, lambda: self._think(request), sequel, number)
        return number

    def _think(self, request: ChatRequest | RankRequest) -> Result:
        """Ask the model and wait for the result; called on the worker's thread."""
        if isinstance(request, RankRequest):
            number = self._model.rank(request)
        else:
            number = self._model.chat(request)
        try:
            result = self._end_of(number)
        except GivenUpError:
            self._model.cancel(number)
            raise
        if isinstance(request, RankRequest) and isinstance(result, Scored):
            _known[self.name, request] = result
        return result

    def _end_of(self, number: int) -> Result:
        while True:
            self._within.wait(POLL_S)
            still_wanted()
            for event in self._within.take_all():
                if isinstance(event, Ended) and event.request == number:
                    return event.result
