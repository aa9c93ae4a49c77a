"""Who answers the robot's questions: a person at a console, or who stands in for one."""

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
"""What the robot says, where colours are seen."""
MOST_LINES = 1000
"""A script is read no further while so many lines of it wait."""
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

    One thread reads lines all the time, so that a stop is heard, and answered, at any moment. What
    else is said goes to whoever asks: a question of the robot, or the prompt for a command. From a
    terminal, a line that comes while nobody asks is an event of its own: it never becomes the
    answer to a question that the person has not seen. Any other source is a script, whose lines are
    kept in order. What waits when a stop comes is forgotten.
    """

    def __init__(
        self, inbox: Inbox, source: TextIO | None = None, out: TextIO | None = None
    ) -> None:
        """Read from `source` (default: standard input), write to `out` (standard error)."""
        self._inbox = inbox
        self._out = out or sys.stderr
        self.aloud: Callable[[str], None] = lambda text: None
        """Is told what the robot says, to say it aloud."""
        self.first: Callable[[str], bool] = lambda line: False
        """Is told each line before it counts, and may take it."""
        self._lock = threading.Lock()
        self._lines: deque[str] = deque()
        self._request: int | None = None
        self._prompting = False
        self._begun = False
        """Whether anything was asked or told so far."""
        self._kept_open = False
        self._typing_is_over = source is None and sys.stdin is None
        self._ended = ""
        """Why no more lines come; empty if they do."""
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
        """Print it."""
        self._begun = True
        self._say(text)

    def says(self, words: str) -> None:
        """They say this otherwise than at the terminal; any thread may call it."""
        self._hear(words, typed=True)

    def mention(self, text: str) -> None:
        """Say something beside any mission, at once; any thread may call it."""
        self._say(text)

    @property
    def is_busy(self) -> bool:
        """Whether there may be something to stop: no command is waited for."""
        return not self._is_idle

    def keep_open(self, kept: bool) -> None:
        """They are heard elsewhere, too: meanwhile, the end of the input ends nothing."""
        with self._lock:
            self._kept_open = kept
            if self._typing_is_over:
                self._ended = "" if kept else INPUT_ENDED
            self._serve()

    def _say(self, text: str) -> None:
        """Print it; a person who cannot be told is no reason to end anything."""
        self._speak(text)
        with suppress(OSError, ValueError):
            if isinstance(self._out, Terminal):
                self._out.write_line(text, CYAN)
                self._out.flush()
            elif self._out is not None:
                print(printable(text), file=self._out, flush=True)

    def _speak(self, text: str) -> None:
        """Say it aloud, too."""
        self.aloud(text)

    def _prompt(self, request: int) -> int:
        """Show a prompt, unless a line waited already."""
        with self._lock:
            if self._keyboard and self._request == request:
                self._keyboard.prompt()
        return request

    def _rest(self) -> None:
        """Take the prompt away."""
        if self._keyboard:
            self._keyboard.rest()

    def _wait(self, *, prompting: bool) -> int:
        request = self._inbox.open(real=True)
        with self._lock:
            self._begun = True
            if self._typed and not prompting:
                self._lines.clear()  # typed before the question was seen
            self._request, self._prompting = request, prompting
            self._serve()
        return request

    # --- from here on in the thread that reads ---

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
        """Do with a line what is to be done; `typed` if it was not kept for later in a script."""
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
        """Give a line to who asks, or keep it until somebody does; whether it was taken."""
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
        """In a script it ends the input; at a terminal, what runs is stopped, too."""
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
        """Give the oldest line to whoever waits; the lock is held."""
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
    """The lines as they come, of too long ones the beginning; ends if no more can be read."""
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
            with suppress(OSError, ValueError):
                print(printable(text), file=self._out, flush=True)


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
