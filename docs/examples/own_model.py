"""A language model of one's own: this one is a table; yours asks a network or a service.

Writing takes long, so `chat` only starts it: it returns the number of a request at once, and the
reply comes as an event with that number. What the model names goes through the ontology, as with
any model: "moon" is no place of this home, and the robot never hears of it.

    python docs/examples/own_model.py
"""

import json
import threading
from pathlib import Path

from executive import (
    ChatRequest,
    Failed,
    Inbox,
    Outcome,
    RankRequest,
    Replied,
    Result,
    Session,
    Usage,
    load_settings,
)

PLACES = {"pitcher": ["moon", "counter_wagon"], "hammer": ["desk"]}


class TableModel:
    """Implements `LanguageModel`: writes the places that a table has for a thing."""

    name = "table"
    context_tokens = 4096
    can_rank = False
    """It cannot score given answers: it is asked to write (`--elicit generate`)."""

    def __init__(self, inbox: Inbox) -> None:
        """Post replies to this inbox; any thread may."""
        self._inbox = inbox

    def chat(self, request: ChatRequest) -> int:
        """Called on the thread that ticks: start, and return at once."""
        number = self._inbox.open(real=True)  # takes real time: mission time goes on with it
        threading.Thread(target=self._write, args=[number, request], daemon=True).start()
        return number

    def _write(self, number: int, request: ChatRequest) -> None:
        """On a thread of its own. Whatever happens, the request must end."""
        self._inbox.end(number, self._reply(request))

    def _reply(self, request: ChatRequest) -> Result:
        question = request.messages[-1].content
        for thing, places in PLACES.items():
            if thing in question:
                text = json.dumps({"places": places})
                words = len(question.split())
                return Replied(request, text, Usage(self.name, words, words, len(places)))
        return Failed("my table has no such thing")  # a clause that a person understands

    def rank(self, request: RankRequest) -> int:
        """Nobody calls it as long as `can_rank` is False; if somebody does, that ends, too."""
        number = self._inbox.open()
        self._inbox.end(number, Failed("a table cannot rank"))
        return number

    def prepare(self, request: ChatRequest | RankRequest) -> None:
        """What is likely to be asked next: a chance to read ahead, no request."""

    def cancel(self, request: int) -> None:
        """The tree does not want it any more: its reply is not delivered, should it still come."""
        self._inbox.drop(request)

    def count_tokens(self, text: str) -> int:
        """So that prompts keep within `context_tokens`."""
        return len(text.split())

    def close(self) -> None:
        """The session is over."""


def find(words: str, runs: Path = Path("runs")) -> Outcome:
    """One mission with this model, in a home of which nobody knows where things usually are."""
    settings = load_settings(
        world="fake", search="paper", user="none", llm="none", defaults=False, runs=runs
    )
    inbox = Inbox()
    with Session(settings, inbox=inbox, model=TableModel(inbox)) as robot:
        return robot.run(words)


if __name__ == "__main__":
    outcome = find("Find the pitcher")
    print(outcome.reason)
    print(f"what became of the reply: python -m logs llm {outcome.run_dir}")
