"""Who answers the robot's questions: a person at a console, or who stands in for one."""

import random
import sys
import threading
from collections import deque
from collections.abc import Callable, Iterable
from typing import TextIO

from executive.events import Inbox, StopRequested
from executive.text import writable
from executive.types import Answered, Failed, Question, QuestionKind

STOP_WORDS = frozenset({"stop", "halt"})


class Console:
    """A person at a terminal.

    One thread reads lines all the time, so that "stop" is heard at any moment. Other lines are kept
    in order and go to whoever asks next: a question of the robot, or the prompt for a command.
    """

    def __init__(
        self, inbox: Inbox, source: TextIO | None = None, out: TextIO | None = None
    ) -> None:
        """Read from `source` (default: standard input), write to `out` (standard error)."""
        self._inbox = inbox
        self._source = source or sys.stdin
        self._out = out or sys.stderr
        self._lock = threading.Lock()
        self._lines: deque[str] = deque()
        self._at_end = False
        self._request: int | None = None
        threading.Thread(target=self._read, name="console", daemon=True).start()

    def ask(self, question: Question) -> int:
        """Print the question; ends Answered with the next line, or Failed at the end of input."""
        print(question.text, file=self._out, flush=True)
        return self.listen()

    def listen(self) -> int:
        """Wait for the next line; ends like `ask`."""
        request = self._inbox.open(real=True)
        with self._lock:
            self._request = request
            self._serve()
        return request

    def cancel(self, request: int) -> None:
        """Withdraw the question; a later answer goes to the next one."""
        self._inbox.drop(request)
        with self._lock:
            if self._request == request:
                self._request = None

    def tell(self, text: str) -> None:
        """Print it."""
        print(text, file=self._out, flush=True)

    def _read(self) -> None:
        for line in self._source:
            words = writable(line).strip()
            if words.lower() in STOP_WORDS:
                self._inbox.post(StopRequested("the person"))
            elif words:
                with self._lock:
                    self._lines.append(words)
                    self._serve()
        with self._lock:
            self._at_end = True
            self._serve()

    def _serve(self) -> None:
        """Give the oldest line to whoever waits; the lock is held."""
        if self._request is None:
            return
        if self._lines:
            self._inbox.end(self._request, Answered(self._lines.popleft()))
        elif self._at_end:
            self._inbox.end(self._request, Failed("the input has ended"))
        else:
            return
        self._request = None


class _Prompt:
    """What the simulated persons share: they answer at once."""

    def __init__(self, inbox: Inbox, out: TextIO | None = None) -> None:
        self._inbox = inbox
        self._out = out
        self.told: list[str] = []

    def cancel(self, request: int) -> None:
        """Withdraw the question."""
        self._inbox.drop(request)

    def tell(self, text: str) -> None:
        """Keep what was said, and print it if there is where to."""
        self.told.append(text)
        self._print(text)

    def _answer(self, question: Question, result: Answered | Failed) -> int:
        self._print(question.text)
        self._print(f"> {result.text}" if isinstance(result, Answered) else f"({result.reason})")
        request = self._inbox.open()
        self._inbox.end(request, result)
        return request

    def _print(self, text: str) -> None:
        if self._out is not None:
            print(text, file=self._out, flush=True)


class Oracle(_Prompt):
    """The paper's simulated user, who always answers right.

    Of a class of things it means one that is in the home, chosen by the seed, and sticks to it.
    What the robot makes of its words is right if such a thing is in the home.
    """

    def __init__(
        self,
        inbox: Inbox,
        where: Callable[[str], str | None],
        seed: int = 0,
        out: TextIO | None = None,
    ) -> None:
        """`where` tells, by the world's truth, on which furniture an object is (None: nowhere)."""
        super().__init__(inbox, out)
        self._where = where
        self._random = random.Random(seed)
        self._meant: dict[str, str] = {}

    def ask(self, question: Question) -> int:
        """Answer from the truth."""
        match question.kind:
            case QuestionKind.WHERE_IS:
                answer = self._where(question.about)
            case QuestionKind.CONFIRM:
                answer = "yes" if any(map(self._where, question.options)) else "no"
            case _:
                answer = self._choose(question)
        return self._answer(question, Answered(answer or "I don't know"))

    def _choose(self, question: Question) -> str | None:
        here = [name for name in question.options if self._where(name)]
        if not here:
            return None
        return self._meant.setdefault(question.about, self._random.choice(here))


class Scripted(_Prompt):
    """Gives prepared answers, for tests: None stays silent for ever; no more answers is Failed."""

    def __init__(self, inbox: Inbox, answers: Iterable[str | None] = ()) -> None:
        """Answer in this order."""
        super().__init__(inbox)
        self._answers = deque(answers)
        self.asked: list[Question] = []

    def ask(self, question: Question) -> int:
        """Give the next answer."""
        self.asked.append(question)
        if not self._answers:
            return self._answer(question, Failed("the script has no more answers"))
        answer = self._answers.popleft()
        if answer is None:
            return self._inbox.open()
        return self._answer(question, Answered(answer))


class Nobody(_Prompt):
    """Nobody is there: every question fails at once."""

    def ask(self, question: Question) -> int:
        """Fail."""
        return self._answer(question, Failed("there is nobody to ask"))
