"""A language model behind HTTP: any server with OpenAI's `/v1/chat/completions`."""

import asyncio
import logging
import threading
from dataclasses import asdict

from executive.events import Inbox
from executive.servers.address import refuse_secrets
from executive.servers.key import LLM_KEY, Key
from executive.text import printable
from executive.types.llm import ChatRequest, RankRequest, Usage
from executive.types.results import Failed, Replied, Result
from kb.llm.options import USUAL, ModelOptions
from kb.llm.server.asking import Asked, Asking
from kb.llm.server.dialect import Dialect
from kb.llm.server.wire import Written
from kb.llm.thinking import answer_of, used_up
from kb.llm.threads import Daemons

BYTES_PER_TOKEN = 3
"""A cautious estimate for English: such servers do not offer their tokenizer."""
_SHOWN = 100
"""Characters of what was not expected."""
MOST_ANSWERED = 200_000
"""Characters of an answer: a recording keeps it with each event, call and tick that has it."""
CLOSING_S = 1.0
"""A thread that takes longer to disconnect is abandoned (s)."""

log = logging.getLogger(__name__)


class Server:
    """Implements `LanguageModel` with a server, which can write but not score.

    Replies are streamed, so that cancelling a request disconnects at once.
    """

    can_rank = False

    def __init__(
        self,
        url: str,
        inbox: Inbox,
        options: ModelOptions = USUAL,
        *,
        model: str | None = None,
        api_key: Key | None = None,
        timeout_s: float = 60.0,
    ) -> None:
        """Prepare the connection; nothing is sent yet.

        Args:
            url: such as `http://127.0.0.1:8000/v1`; `/v1` may be omitted.
            inbox: receives the results.
            options: how the model writes.
            model: the server's name of the model; None: the first in its list that chats.
            api_key: sent as a bearer token, to this server only.
            timeout_s: time limit of a reply, with all retries (s).

        Raises:
            InputError: if the address contains a user or a password.
        """
        refuse_secrets(url, LLM_KEY)
        self._inbox = inbox
        self._options = options
        self._sampling = asdict(options.sampling)
        self._timeout_s = timeout_s
        dialect = Dialect(self._sampling, options.max_tokens, grammar=options.grammar)
        self._asking = Asking(url, dialect, model, api_key or Key(), timeout_s)
        self._tasks: dict[int, asyncio.Task[None]] = {}
        self._looking: asyncio.Task[None] | None = None
        self._ending: asyncio.Task[None] | None = None
        self._loop = asyncio.new_event_loop()
        self._loop.set_default_executor(Daemons())
        self._thread = threading.Thread(target=self._loop.run_forever, name="language model server")
        self._thread.daemon = True
        self._thread.start()

    @property
    def name(self) -> str:
        """The name of the model; the address of the server until it is known."""
        return self._asking.name

    @property
    def context_tokens(self) -> int:
        """Size of the context window (tokens)."""
        return self._options.context_tokens

    def chat(self, request: ChatRequest) -> int:
        """Write a reply; ends Replied, or Failed."""
        number = self._inbox.open(real=True)
        self._loop.call_soon_threadsafe(self._begin, number, request)
        return number

    def rank(self, request: RankRequest) -> int:
        """Ends Failed: such servers do not return the probability of a given text."""
        number = self._inbox.open(real=True)
        self._inbox.end(number, Failed("a server's language model cannot score places"))
        return number

    def prepare(self, request: ChatRequest | RankRequest) -> None:
        """Check that the server is there and which models it has; if not, warn."""
        self._loop.call_soon_threadsafe(self._look)

    def cancel(self, request: int) -> None:
        """Disconnect from the server; no result is delivered."""
        self._loop.call_soon_threadsafe(self._hang_up, request)
        self._inbox.drop(request)

    def count_tokens(self, text: str) -> int:
        """An estimate, usually too high: one token for three bytes."""
        return -(-len(text.encode()) // BYTES_PER_TOKEN)

    def close(self) -> None:
        """Disconnect and end the thread."""
        if self._loop.is_closed():
            return
        self._loop.call_soon_threadsafe(self._end)
        self._thread.join(CLOSING_S)
        if not self._thread.is_alive():
            self._loop.close()

    # --- all that follows runs in the server's thread ---

    def _begin(self, number: int, request: ChatRequest) -> None:
        task = self._loop.create_task(self._serve(number, request))
        self._tasks[number] = task
        task.add_done_callback(lambda _: self._tasks.pop(number))

    def _look(self) -> None:
        if self._looking is None:
            self._looking = self._loop.create_task(self._warn())

    async def _warn(self) -> None:
        if fault := await self._asking.look():
            log.warning("the language model does not answer: %s", fault)

    def _hang_up(self, number: int) -> None:
        if task := self._tasks.get(number):
            task.cancel()

    def _end(self) -> None:
        self._ending = self._loop.create_task(self._hang_up_all())
        self._ending.add_done_callback(lambda _: self._loop.stop())

    async def _hang_up_all(self) -> None:
        tasks = [*self._tasks.values(), *([self._looking] if self._looking else [])]
        for task in tasks:
            task.cancel()
        await asyncio.gather(*tasks, return_exceptions=True)
        await self._asking.close()

    async def _serve(self, number: int, request: ChatRequest) -> None:
        asked = await self._asking.ask(request)
        try:
            result = asked if isinstance(asked, Failed) else self._result(request, asked)
        except Exception as error:  # every request must get a result
            result = Failed(f"its reply cannot be taken in: {printable(type(error).__name__)}")
        self._inbox.end(number, result)

    def _result(self, request: ChatRequest, asked: Asked) -> Result:
        """The answer without the reasoning before it."""
        text, thought = answer_of(asked.text)
        got = asked.got
        written = got.chunks if got.written is None else got.written
        if not text and got.finish_reason == "length":
            return Failed(used_up(written or self._options.max_tokens))
        if not text.strip():
            return Failed(_no_answer(got, thought=thought))
        if len(text) > MOST_ANSWERED:
            return Failed(f"its answer is longer than {MOST_ANSWERED} characters")
        read = got.read
        if read is None:
            read = sum(self.count_tokens(message.content) for message in request.messages)
        usage = Usage(
            model=self.name,
            input_tokens=read,
            evaluated_tokens=max(0, read - got.cached),
            output_tokens=written,
            first_token_s=got.first_token_s,
            total_s=asked.total_s,
            parameters={**self._sampling, "max_tokens": self._options.max_tokens},
        )
        return Replied(request, text, usage, got.finish_reason or "stop")


def _no_answer(got: Written, *, thought: bool) -> str:
    """Why a reply is empty."""
    if got.called:
        return "it called a tool, which it does not have, instead of an answer"
    if thought or got.thought:
        return "it thought, and gave no answer"
    if got.finish_reason not in ("", "stop"):
        return f"its answer is empty ({got.finish_reason})"
    if got.others and not got.is_reply:
        keys = printable(", ".join(got.others))[:_SHOWN]
        return f"it does not answer as /chat/completions does: its reply has only {keys}"
    return "its answer is empty"
