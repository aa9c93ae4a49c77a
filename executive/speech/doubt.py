"""What was heard and is not certain is asked back, and done only when the person says yes to it."""

import threading
import time
from collections.abc import Callable
from dataclasses import dataclass

from executive.events import Inbox, Listened
from executive.interfaces import Interpreter
from executive.language.control import Control, control
from executive.speech.interfaces import Reading
from executive.user import Console

PATIENCE_S = 20.0
"""How long what was asked back waits for its yes."""
UNCLEAR = "I did not understand you. Please say it again."
YES_OR_NO = "Please say yes or no"
DROPPED = "Then I will not."
SPOTTER = "spotter"
"""Who hears a stop, in logs."""


@dataclass(frozen=True, slots=True)
class AskedBack:
    """Words that are done when the person says yes to them.

    Attributes:
        number: tells it from what is asked back before and after.
        words: what was heard.
    """

    number: int
    words: str

    @property
    def text(self) -> str:
        """As the person is asked."""
        return f"Did you say: {self.words}?"


class Doubt:
    """Between the ears and the person: lets through what is certain, and asks about the rest.

    What is typed meanwhile answers it, too. Any thread may call it.
    """

    def __init__(
        self,
        person: Console,
        interpreter: Interpreter,
        inbox: Inbox,
        now: Callable[[], float] = time.monotonic,
    ) -> None:
        """Speak for this person."""
        self._person = person
        self._interpreter = interpreter
        self._inbox = inbox
        self._now = now
        self._lock = threading.Lock()
        self._number = 0
        self._asked: AskedBack | None = None
        self._until = 0.0
        self.changed: Callable[[], None] = lambda: None
        """Is called when something is asked back, and when it is no longer."""
        person.first = self.takes

    @property
    def asked_back(self) -> AskedBack | None:
        """What a button may still answer; None if there is nothing."""
        return self._asked

    def hear(self, reading: Reading) -> None:
        """The ears understood this."""
        text, asked = reading.text, self._waiting()
        if text and control(text) is Control.STOP:
            self._log(reading, "a stop")
            self._person.says(text)
        elif not text:
            self._log(reading, "not understood")
            self._person.mention(self._question(asked) if asked else UNCLEAR)
        elif asked and self._interpreter.agrees(text) is not None:
            self._answer(reading, asked)
        elif reading.sure:
            self._take()
            self._log(reading, "certain")
            self._person.says(text)
        else:
            self._log(reading, "asked back")
            self._ask(text)

    def stop(self) -> None:
        """The spotter heard a stop."""
        self._log(Reading(SPOTTER, "stop"), "a stop")
        self._person.says("stop")

    def settle(self, number: int, *, agrees: bool) -> bool:
        """A button was pressed; False if this is not asked back any more.

        It answers nothing else, however late it comes, so it has all the time that it takes.
        """
        with self._lock:
            asked = self._asked
            if asked is None or asked.number != number:
                return False
            self._asked = None
        self.changed()
        self._do(asked.words, agrees=agrees)
        return True

    def forget(self) -> None:
        """Ask nothing back any more: the person has done something else."""
        self._take()

    def takes(self, line: str) -> bool:
        """Whether a line that was typed, or said with certainty, answers what was asked back.

        Whatever else it is, it takes the place of that.
        """
        asked = self._take()
        agrees = self._interpreter.agrees(line) if asked else None
        if agrees is None or control(line):
            return False
        self._do(asked, agrees=agrees)
        return True

    def _answer(self, reading: Reading, asked: str) -> None:
        """A yes has to be certain; a no need not be."""
        agrees = self._interpreter.agrees(reading.text)
        if agrees and not reading.sure:
            self._log(reading, "asked back")
            self._person.mention(self._question(asked))
            return
        self._log(reading, "an answer")
        self._take()
        self._do(asked, agrees=bool(agrees))

    def _do(self, asked: str, *, agrees: bool) -> None:
        if agrees:
            self._person.says(asked)
        else:
            self._person.mention(DROPPED)

    def _ask(self, text: str) -> None:
        with self._lock:
            self._number += 1
            self._asked = asked = AskedBack(self._number, text)
            self._until = self._now() + PATIENCE_S
        self._person.mention(asked.text)
        self.changed()

    def _question(self, asked: str) -> str:
        return f"{YES_OR_NO}: {asked}?"

    def _waiting(self) -> str:
        """What was asked back and may still be answered; empty if there is nothing."""
        with self._lock:
            return self._asked.words if self._asked and self._now() < self._until else ""

    def _take(self) -> str:
        """The same, and ask it no longer."""
        words = self._waiting()
        with self._lock:
            was, self._asked = self._asked, None
        if was:
            self.changed()
        return words

    def _log(self, reading: Reading, became: str) -> None:
        self._inbox.post(Listened(reading.by, reading.text, reading.confidence, became))
