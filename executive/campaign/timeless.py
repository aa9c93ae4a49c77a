"""A language model whose thinking takes no mission time, so that no machine is too slow for it."""

from executive.computing import Computation, GivenUpError, Worker, still_wanted
from executive.events import Ended, Inbox
from executive.interfaces.llm import LanguageModel
from executive.types.llm import ChatRequest, RankRequest
from executive.types.results import Result, Scored

POLL_S = 0.2
"""How often it is looked whether anybody still wants to know (real seconds)."""

_known: dict[tuple[str, RankRequest], Scored] = {}
"""Rankings of this process, by model and request: a ranking has no chance in it."""


class Timeless:
    """Implements `LanguageModel` around one: mission time stands still while that one thinks."""

    def __init__(self, model: LanguageModel, within: Inbox, inbox: Inbox) -> None:
        """Ask `model`, which ends its requests in the inbox `within`; end ours in `inbox`."""
        self._model = model
        self._within = within
        self._inbox = inbox
        self._worker = Worker("timeless model")
        self.name = model.name
        self.context_tokens = model.context_tokens
        self.can_rank = model.can_rank

    def chat(self, request: ChatRequest) -> int:
        """Write a reply; ends Replied, or Failed."""
        return self._ask(request)

    def rank(self, request: RankRequest) -> int:
        """Score the options; ends Scored, or Failed. What was scored before, is known."""
        if scored := _known.get((self.name, request)):
            number = self._inbox.open()
            self._inbox.end(number, scored)
            return number
        return self._ask(request)

    def prepare(self, request: ChatRequest | RankRequest) -> None:
        """Nothing: it need not be fast."""

    def cancel(self, request: int) -> None:
        """Forget the request; what is being thought, is thought to its end."""
        self._inbox.drop(request)

    def count_tokens(self, text: str) -> int:
        """By the model's tokenizer."""
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
        """Have the model answer, and wait for it; on the worker's thread."""
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
