"""Confirms uncertain speech: it is asked back, and done only if the person says yes."""

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
"""How long (s) a confirmation waits for a spoken or typed answer; a button may be pressed later."""
AGAIN_OR_TYPE = "Please say it again, or type it."
UNCLEAR = "I did not understand you. Please say it again."
YES_OR_NO = "Please say yes or no"
OVERSPOKEN = "I was speaking, and did not understand you. Please say it again."
TOO_MUCH = "That is more than I can hear at a time. Please say the last of it again."
FRESH_S = 4.0
"""A sure utterance that began longer ago (s) is asked back: it could answer a later question by
mistake."""
SHORTEST = 3
"""The fewest letters of a word that may have been cut short."""
OWN = 0.5
"""If a larger share of the significant words is the robot's own, it has heard itself."""
SPOTTER = "spotter"
"""The name of the stop spotter in logs."""


@dataclass(frozen=True, slots=True)
class AskedBack:
    """Words that wait for the person's confirmation.

    Attributes:
        number: number of the confirmation, by which a button answers it.
        words: the recognised words.
    """

    number: int
    words: str

    @property
    def text(self) -> str:
        """The question to the person."""
        return f"Did you say: {_bare(self.words)}?"


class Doubt:
    """Passes sure readings on to the person's console, and asks the person to confirm others.

    A typed answer counts, too. Any thread may call it.
    """

    def __init__(
        self,
        person: Console,
        interpreter: Interpreter,
        inbox: Inbox,
        now: Callable[[], float] = time.monotonic,
    ) -> None:
        """Pass words on to this person's console."""
        self._person = person
        self._interpreter = interpreter
        self._inbox = inbox
        self._now = now
        self._lock = threading.Lock()
        self._number = 0
        self._asked: AskedBack | None = None
        self._asked_at = self._until = 0.0
        self.changed: Callable[[], None] = lambda: None
        """Callback when a confirmation begins, and when it ends."""
        person.first = self.takes

    @property
    def asked_back(self) -> AskedBack | None:
        """The open confirmation, which a button may answer; None if there is none."""
        return self._asked

    def hear(self, reading: Reading, overlap: Overlap = NONE, began: float | None = None) -> None:
        """Handle a reading; `overlap` says whether the robot spoke meanwhile.

        A reading while it spoke is never sure: mostly it is the robot itself. Recognition takes
        time: an utterance that began (`began`, by the clock of this object) before a confirmation
        was asked is not an answer to it.
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
        """Tell the person that an utterance was dropped, as too many are waiting."""
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
        """Handle a spotted stop; if not `busy`, the robot only spoke: there is nothing to stop."""
        self._log(Reading(SPOTTER, "stop"), "a stop")
        self._take()
        if busy:
            self._person.says("stop")

    def settle(self, number: int, *, agrees: bool) -> bool:
        """Answer a confirmation by a button; return False if it is not open any more.

        A button answers only its own confirmation, so it may come at any time.
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
        """End the open confirmation: the person has done something else."""
        self._take()

    def takes(self, line: str) -> bool:
        """Use a typed or surely recognised line as the answer to a confirmation, if it is one.

        Any other line ends the confirmation. Returns whether the line was used.
        """
        asked = self._take()
        agrees = self._interpreter.agrees(line) if asked else None
        if agrees is None or control(line):
            return False
        self._do(asked, agrees=agrees)
        return True

    def _is_own(self, text: str, own: str) -> bool:
        """Whether the robot heard itself; a stop at rest counts as that.

        Otherwise the robot would reply to it, hear its own reply, and so on.
        """
        stops = control(text) is Control.STOP
        return is_own(text, own) or (stops and not self._person.is_busy)

    def _answer(self, reading: Reading, asked: str, *, early: bool) -> None:
        """Handle an answer: a yes has to be sure, a no need not; both must follow the question."""
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
        """The words of the open confirmation; empty if there is none, or its time has passed."""
        with self._lock:
            return self._asked.words if self._asked and self._now() < self._until else ""

    def _take(self) -> str:
        """The same, and end the confirmation."""
        words = self._waiting()
        with self._lock:
            was, self._asked = self._asked, None
        if was:
            self.changed()
        return words

    def _log(self, reading: Reading, became: str) -> None:
        self._inbox.post(Listened(reading.by, reading.text, reading.confidence, became))


def is_own(heard: str, own: str) -> bool:
    """Whether the recognised words come from the robot's own sentences."""
    words = _words(heard)
    telling = [word for word in words if word not in LITTLE] or words
    return sum(_begins_one_of(_words(own), word) for word in telling) > OWN * len(telling)


def _begins_one_of(words: list[str], word: str) -> bool:
    """Whether a word, perhaps cut short, is among these: "halt" for "halting"."""
    return word in words or (len(word) >= SHORTEST and any(w.startswith(word) for w in words))


def _bare(text: str) -> str:
    """The text without the final punctuation that servers write."""
    return text.rstrip(".!?… ")


def _words(text: str) -> list[str]:
    return re.findall(r"[a-z0-9']+", text.lower())
