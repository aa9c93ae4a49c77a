"""A person who speaks with the robot: says a command, and yes or no to what is asked back."""

import io
import re
from collections.abc import Callable
from dataclasses import dataclass, field

from executive.events import Heard, Inbox, StopRequested
from executive.interfaces.dialogue import Interpreter
from executive.speech.doubt import Doubt
from executive.speech.interfaces import Ears
from executive.speech.microphone import from_files
from executive.speech.sound import Sound
from executive.speech.utterances import Utterances
from executive.user import Console

ASKED = re.compile(r"(?:Did you say|Please say yes or no): (.*)\?$")
MOST_ANSWERS = 3
"""Whoever is asked a fourth time gives up."""


@dataclass
class Told:
    """What became of one command.

    Attributes:
        asked: what was asked back, in order.
        answers: what the person said to it.
        done: what the robot went to do: words, or "stop".
    """

    asked: list[str] = field(default_factory=list)
    answers: list[str] = field(default_factory=list)
    done: list[str] = field(default_factory=list)


class Spoken:
    """A robot that is at something, and is spoken to."""

    def __init__(self, ears: Ears, interpreter: Interpreter) -> None:
        """It hears by these ears, and understands by this interpreter."""
        self._ears, self._inbox, self._out = ears, Inbox(), io.StringIO()
        person = Console(self._inbox, io.StringIO(), self._out)
        person.keep_open(True)
        person.tell("I begin.")
        self._doubt = Doubt(person, interpreter, self._inbox, now=lambda: 0.0)

    def command(self, sound: Sound, answer: Callable[[str], tuple[str, Sound]]) -> Told:
        """Say a command; `answer` says yes or no to what is asked back."""
        told = Told()
        self._hear(sound)
        while not self._done(told) and len(told.answers) < MOST_ANSWERS:
            asked = self._asked()
            if asked is None:
                break
            told.asked.append(asked)
            words, sound = answer(asked)
            told.answers.append(words)
            self._hear(sound)
        return told

    def _hear(self, sound: Sound) -> None:
        self._out.truncate(0)
        cut = Utterances()
        found = [cut.add(block) for block in from_files([sound], wait=lambda seconds: None)]
        for said in (*found, cut.end()):
            if said is not None:
                self._doubt.hear(self._ears.hear(said))

    def _asked(self) -> str | None:
        """What was asked back last; None if nothing was."""
        lines = self._out.getvalue().strip("\0\n").splitlines()
        found = ASKED.match(lines[-1]) if lines else None
        return found[1] if found else None

    def _done(self, told: Told) -> bool:
        for event in self._inbox.take_all():
            if isinstance(event, StopRequested):
                told.done.append("stop")
            if isinstance(event, Heard):
                told.done.append(event.words)
        return bool(told.done)
