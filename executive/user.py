"""Implementations of `User`: a person at a console, and stand-ins for one."""

import random
import sys
import threading
import time
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from contextlib import suppress
from io import TextIOWrapper, UnsupportedOperation
from typing import TextIO

from executive.events import THE_PERSON, Inbox, StopRequested
from executive.keyboard import keyboard_of
from executive.language.commands import NOT_KEPT, WILL_NOT
from executive.language.control import Control, control
from executive.language.meaning import Refusal
from executive.language.reader import english
from executive.terminal import Terminal
from executive.text import LONGEST, one_line, printable, too_long, writable
from executive.types.dialogue import Question, QuestionKind
from executive.types.results import Answered, Failed

STOPPING = "Stopping."
INPUT_ENDED = "the input has ended"
FORGOTTEN = "What you said before is forgotten."

CYAN = 36
"""SGR code for what the robot says, if the terminal shows colours."""
MOST_LINES = 1000
"""Reading of a script pauses while this many lines are waiting."""
POLL_S = 0.05
NOTHING_TO_STOP = "There is nothing to stop: I am at rest."


def at_rest(words: str) -> str:
    """What to say to words that say stop while nothing runs.

    Some say what is not to be done later: "don't go into the bedroom", and not only "don't move".
    """
    said = english().read(words)
    forbids = isinstance(said, Refusal) and " " in said.words
    return WILL_NOT + NOT_KEPT if forbids else NOTHING_TO_STOP


class Console:
    """A person at a terminal.

    A thread of its own reads all lines, so that a stop is heard, and answered, at any moment. Other
    lines go to the open request: a question of the robot, or the prompt for a command. From a
    terminal, a line that comes without an open request is an event of its own: it never becomes the
    answer to a question that the person has not seen. Any other source is a script, whose lines are
    queued. A stop clears the queue.
    """

    def __init__(
        self, inbox: Inbox, source: TextIO | None = None, out: TextIO | None = None
    ) -> None:
        """Read from `source` (default: standard input), write to `out` (standard error)."""
        self._inbox = inbox
        self._out = out or sys.stderr
        self.aloud: Callable[[str], None] = lambda text: None
        """Callback for each sentence of the robot, to say it aloud."""
        self.first: Callable[[str], bool] = lambda line: False
        """Callback for each line before it is handled; True if it has taken the line."""
        self._lock = threading.Lock()
        self._lines: deque[str] = deque()
        self._request: int | None = None
        self._prompting = False
        self._begun = False
        """Whether anything was asked or said so far."""
        self._kept_open = False
        self._typing_is_over = source is None and sys.stdin is None
        self._ended = ""
        """Why the input has ended; empty if it has not."""
        source = source or sys.stdin
        self._typed = source is not None and _is_terminal(source)
        self._keyboard = keyboard_of(source, self._out) if source and self._out else None
        if source is None:
            self._ended = "there is nobody to ask"
        else:
            threading.Thread(target=self._read, args=[source], name="console", daemon=True).start()

    def ask(self, question: Question) -> int:
        """Print the question; ends Answered with the next line, or Failed at the end of input."""
        self._say(question.text)
        return self._prompt(self._wait(prompting=False))

    def listen(self, prompt: str = "") -> int:
        """Wait for a command; ends like `ask`, and Failed if the person ends the session."""
        request = self._wait(prompting=True)
        if prompt:
            self._say(prompt)
        return self._prompt(request)

    def cancel(self, request: int) -> None:
        """Withdraw the question."""
        self._inbox.drop(request)
        with self._lock:
            if self._request == request:
                self._request = None
                self._rest()

    def tell(self, text: str) -> None:
        """Print a sentence."""
        self._begun = True
        self._say(text)

    def says(self, words: str) -> None:
        """Handle words that the person said by other means; any thread may call it."""
        self._hear(words, typed=True)

    def mention(self, text: str) -> None:
        """Say something outside of a mission, at once; any thread may call it."""
        self._say(text)

    @property
    def is_busy(self) -> bool:
        """Whether there may be something to stop: the prompt does not wait for a command."""
        return not self._is_idle

    def keep_open(self, kept: bool) -> None:
        """Set whether the person is heard elsewhere, too; then the end of input has no effect."""
        with self._lock:
            self._kept_open = kept
            if self._typing_is_over:
                self._ended = "" if kept else INPUT_ENDED
            self._serve()

    def _say(self, text: str) -> None:
        """Print a sentence; errors of the stream are ignored, so that they end nothing."""
        self._speak(text)
        with suppress(OSError, ValueError):
            if isinstance(self._out, Terminal):
                self._out.write_line(text, CYAN)
                self._out.flush()
            elif self._out is not None:
                print(printable(text), file=self._out, flush=True)

    def _speak(self, text: str) -> None:
        """Say a sentence aloud."""
        self.aloud(text)

    def _prompt(self, request: int) -> int:
        """Show a prompt, unless a queued line has answered the request already."""
        with self._lock:
            if self._keyboard and self._request == request:
                self._keyboard.prompt()
        return request

    def _rest(self) -> None:
        """Remove the prompt."""
        if self._keyboard:
            self._keyboard.rest()

    def _wait(self, *, prompting: bool) -> int:
        request = self._inbox.open(real=True)
        with self._lock:
            self._begun = True
            if self._typed and not prompting:
                self._lines.clear()  # typed before the person saw the question
            self._request, self._prompting = request, prompting
            self._serve()
        return request

    # --- from here on in the reading thread ---

    def _read(self, source: TextIO) -> None:
        for line in self._keyboard.lines() if self._keyboard else _lines(source):
            while len(self._lines) >= MOST_LINES:
                time.sleep(POLL_S)
            if self._hear(writable(line).strip()) is Control.QUIT:
                return
        self._typing_ends()

    def _typing_ends(self) -> None:
        with self._lock:
            self._typing_is_over = True
            kept = self._kept_open
        if not kept:
            self._end(INPUT_ENDED)

    def _hear(self, line: str, *, typed: bool = False) -> Control | None:
        """Handle a line; `typed` if the person says it now, so that it must not be queued."""
        words, said = one_line(line), control(line)
        if self.first(words):
            return None
        if said is Control.QUIT:
            self._quit()
        elif said is Control.STOP:
            self._stop(words=words)
        elif why := too_long(line):
            self._say(f"Sorry: {why}.")
        elif words and not self._keep(words, typed or self._typed):
            self._inbox.hear(words)
        return said

    def _keep(self, words: str, typed: bool) -> bool:
        """Give a line to the open request, or queue it; return whether either was possible."""
        with self._lock:
            taken = self._request is not None or not (typed and self._begun)
            if taken:
                self._lines.append(words)
                self._serve()
            return taken

    def _stop(self, by: str = THE_PERSON, words: str = "") -> None:
        with self._lock:
            idle, forgotten = self._is_idle, bool(self._lines)
            self._lines.clear()
        if not idle:
            self._inbox.post(StopRequested(by))
        self._say((at_rest(words) if idle else STOPPING) + f" {FORGOTTEN}" * forgotten)

    @property
    def _is_idle(self) -> bool:
        """Whether the prompt waits for a command."""
        return self._prompting and self._request is not None

    def _quit(self) -> None:
        """End the input; at a terminal, also stop a mission that runs."""
        with self._lock:
            runs = self._typed and not self._is_idle
        if runs:
            self._stop()
        self._end("the session was ended")

    def _end(self, why: str) -> None:
        with self._lock:
            self._ended = why
            self._serve()

    def _serve(self) -> None:
        """Give the oldest line to the open request; the caller holds the lock."""
        if self._request is None:
            return
        if self._lines:
            self._inbox.end(self._request, Answered(self._lines.popleft()))
        elif self._ended:
            self._inbox.end(self._request, Failed(self._ended))
        else:
            return
        self._request = None
        self._rest()


def _is_terminal(source: TextIO) -> bool:
    try:
        return source.isatty()
    except (OSError, ValueError):
        return False


def _lines(source: TextIO) -> Iterator[str]:
    """The lines, those that are too long cut off; ends if no more can be read."""
    if isinstance(source, TextIOWrapper):
        with suppress(UnsupportedOperation):
            source.reconfigure(errors="replace")
    begun = False
    while True:
        try:
            part = source.readline(LONGEST + 2)
        except (OSError, ValueError):
            return
        if not part:
            return
        if not begun:
            yield part
        begun = not part.endswith("\n")


class _Prompt:
    """Base of the simulated persons, who answer at once."""

    def __init__(self, inbox: Inbox, out: TextIO | None = None) -> None:
        self._inbox = inbox
        self._out = out
        self.told: list[str] = []

    def cancel(self, request: int) -> None:
        """Withdraw the question."""
        self._inbox.drop(request)

    def tell(self, text: str) -> None:
        """Keep the sentence in `told`, and print it if there is an output."""
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
            with suppress(OSError, ValueError):
                print(printable(text), file=self._out, flush=True)


class Oracle(_Prompt):
    """The paper's simulated user, who always answers correctly.

    For a class of things, it chooses one that is in the home, by the seed, and keeps to it. It
    confirms the robot's understanding if such a thing is in the home.
    """

    def __init__(
        self,
        inbox: Inbox,
        where: Callable[[str], str | None],
        seed: int = 0,
        out: TextIO | None = None,
    ) -> None:
        """`where` gives the ground truth: the furniture that an object is on (None: on none)."""
        super().__init__(inbox, out)
        self._where = where
        self._random = random.Random(seed)
        self._meant: dict[str, str] = {}

    def ask(self, question: Question) -> int:
        """Answer from the ground truth."""
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
    """Gives prepared answers, for tests: None never ends; without answers left, it is Failed."""

    def __init__(self, inbox: Inbox, answers: Iterable[str | None] = ()) -> None:
        """Give these answers, in order."""
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
    """No person: every question fails at once."""

    def ask(self, question: Question) -> int:
        """Fail."""
        return self._answer(question, Failed("there is nobody to ask"))
