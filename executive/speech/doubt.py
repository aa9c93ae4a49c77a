"""What was heard and is not certain is asked back, and done only when the person says yes to it."""

import re
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass, replace

from executive.events import Inbox, Listened
from executive.interfaces.dialogue import Interpreter
from executive.language.commands import WILL_NOT
from executive.language.control import Control, control
from executive.speech.interfaces import Reading
from executive.speech.jsgf import LITTLE
from executive.speech.overlap import NONE, Overlap
from executive.user import Console

PATIENCE_S = 20.0
"""How long what was asked back waits for its yes."""
AGAIN_OR_TYPE = "Please say it again, or type it."
UNCLEAR = "I did not understand you. Please say it again."
YES_OR_NO = "Please say yes or no"
OVERSPOKEN = "I was speaking, and did not understand you. Please say it again."
TOO_MUCH = "That is more than I can hear at a time. Please say the last of it again."
FRESH_S = 4.0
"""So long ago it may have begun: else it could become the answer to what was asked since."""
SHORTEST = 3
"""Letters of a word that may have been cut short."""
OWN = 0.5
"""If more of the telling words are the robot's own, it has heard itself."""
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
        return f"Did you say: {_bare(self.words)}?"


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
        self._asked_at = self._until = 0.0
        self.changed: Callable[[], None] = lambda: None
        """Is called when something is asked back, and when it is no longer."""
        person.first = self.takes

    @property
    def asked_back(self) -> AskedBack | None:
        """What a button may still answer; None if there is nothing."""
        return self._asked

    def hear(self, reading: Reading, overlap: Overlap = NONE, began: float | None = None) -> None:
        """The ears understood this, and the robot spoke meanwhile or not.

        What was heard while it spoke is never certain. Mostly it is the robot itself. Ears take
        their time: what the person began to say (`began`, by the clock of this doubt) before
        something was asked back is no answer to it.
        """
        began = self._now() if began is None else began
        if not overlap.own:
            self._hear(reading, began)
        elif reading.text and not self._is_own(reading.text, overlap.own):
            self._hear(replace(reading, sure=False), began)
        elif overlap.beside:
            self._log(reading, "overspoken")
            self._person.mention(OVERSPOKEN)
        elif reading.text:
            self._log(reading, "the robot itself")

    def missed(self) -> None:
        """Somebody says more than the ears can hear."""
        self._person.mention(TOO_MUCH)

    def _hear(self, reading: Reading, began: float) -> None:
        text, asked = reading.text, self._waiting()
        if reading.problem:
            self._log(reading, f"failed: {reading.problem}")
            self._person.mention(f"I could not hear you: {reading.problem}. {AGAIN_OR_TYPE}")
        elif text and control(text) is Control.STOP:
            self._log(reading, "a stop")
            self._person.says(text)
        elif not text:
            self._log(reading, "not understood")
            self._person.mention(self._question(asked) if asked else UNCLEAR)
        elif asked and self._interpreter.agrees(text) is not None:
            self._answer(reading, asked, early=began < self._asked_at)
        elif reading.sure and self._now() - began <= FRESH_S:
            self._take()
            self._log(reading, "certain")
            self._person.says(text)
        else:
            self._log(reading, "asked back")
            self._ask(text)

    def stop(self, *, busy: bool = True) -> None:
        """The spotter heard a stop; if the robot only spoke, there is no more to stop."""
        self._log(Reading(SPOTTER, "stop"), "a stop")
        self._take()
        if busy:
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

    def _is_own(self, text: str, own: str) -> bool:
        """A stop at rest is taken for the robot's own, too: an answer would be heard again."""
        stops = control(text) is Control.STOP
        return is_own(text, own) or (stops and not self._person.is_busy)

    def _answer(self, reading: Reading, asked: str, *, early: bool) -> None:
        """A yes has to be certain; a no need not be. Both have to come after the question."""
        agrees = self._interpreter.agrees(reading.text)
        if early or (agrees and not reading.sure):
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
            self._person.mention(WILL_NOT)

    def _ask(self, text: str) -> None:
        with self._lock:
            self._number += 1
            self._asked = asked = AskedBack(self._number, text)
            self._asked_at = self._now()
            self._until = self._asked_at + PATIENCE_S
        self._person.mention(asked.text)
        self.changed()

    def _question(self, asked: str) -> str:
        return f"{YES_OR_NO}: {_bare(asked)}?"

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


def is_own(heard: str, own: str) -> bool:
    """Whether what was heard is made of what the robot said itself."""
    words = _words(heard)
    telling = [word for word in words if word not in LITTLE] or words
    return sum(_begins_one_of(_words(own), word) for word in telling) > OWN * len(telling)


def _begins_one_of(words: list[str], word: str) -> bool:
    """It may have been cut short: "halting" was heard as "halt"."""
    return word in words or (len(word) >= SHORTEST and any(w.startswith(word) for w in words))


def _bare(text: str) -> str:
    """Without the sign at its end, which servers write."""
    return text.rstrip(".!?… ")


def _words(text: str) -> list[str]:
    return re.findall(r"[a-z0-9']+", text.lower())
