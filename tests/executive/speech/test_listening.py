"""Listening while the robot speaks, while ears think, and when the microphone is at fault."""

import io
import threading
from collections.abc import Callable, Iterator

import numpy as np
import pytest
from patience import PATIENCE_S

from executive.errors import InputError
from executive.events import Heard, Inbox, Listened, StopRequested
from executive.language.grammar import EnglishInterpreter
from executive.speech.doubt import OVERSPOKEN, TOO_MUCH, Doubt
from executive.speech.interfaces import Reading
from executive.speech.listening import DEAD, NOBODY, TOO_LONG, Listening
from executive.speech.microphone import BLOCK
from executive.speech.sound import Sound
from executive.user import Console

LOUD = (8000 * np.sin(np.arange(BLOCK))).astype(np.int16)
QUIET = np.ones(BLOCK, dtype=np.int16)
STOP = LOUD + 1
"""What the spotter takes for a stop."""
Block = tuple[Sound, str]
"""What is heard for a tenth of a second, and what the robot says meanwhile."""


def speech(seconds: float, robot: str = "") -> list[Block]:
    return [(LOUD, robot)] * round(seconds * 10)


def silence(seconds: float = 1.0, robot: str = "") -> list[Block]:
    return [(QUIET, robot)] * round(seconds * 10)


class Room:
    """A robot that is spoken to; `ears` tell what they make of each utterance."""

    def __init__(self, *ears: Reading | str, busy: bool = True) -> None:
        self.name = "ears"
        self.readings = [Reading("ears", e, 0.5) if isinstance(e, str) else e for e in ears]
        self.think: Callable[[], object] = lambda: None
        self.saying, self.hushed, self.heard = "", 0, 0
        self.inbox, self.out = Inbox(), io.StringIO()
        self.person = Console(self.inbox, io.StringIO(), self.out)
        self.person.keep_open(True)
        self.person.tell("I begin.")
        if not busy:
            self.person.listen()
        self.doubt = Doubt(self.person, EnglishInterpreter(), self.inbox)

    def hear(self, sound: Sound) -> Reading:
        self.heard += 1
        self.think()
        return self.readings.pop(0)

    def hears_stop(self, block: Sound) -> bool:
        return block is STOP

    def hush(self) -> None:
        self.hushed += 1

    def say(self, text: str) -> None:
        """Not aloud: what it says is in the blocks."""

    def close(self) -> None:
        """Nothing stays open."""

    def listens(self, *parts: list[Block]) -> str:
        """Hear it to the end; what the robot said to it."""
        self.listen_to(self._blocks(parts))
        return self.out.getvalue()

    def listen_to(self, blocks: Iterator[Sound]) -> None:
        listening = Listening(blocks, self, self.doubt, self.person, spotter=self, voice=self)  # type: ignore[arg-type]
        listening.start()
        listening._thread.join(PATIENCE_S)

    def _blocks(self, parts: tuple[list[Block], ...]) -> Iterator[Sound]:
        for sound, self.saying in (block for part in parts for block in part):
            yield sound

    @property
    def events(self) -> list[object]:
        kinds = (Heard, StopRequested)
        return [event for event in self.inbox.take_all() if isinstance(event, kinds)]

    @property
    def became(self) -> list[str]:
        return [e.became for e in self.inbox.take_all() if isinstance(e, Listened)]


def test_a_command_that_is_spoken_into_the_robots_words_is_asked_back() -> None:
    room = Room("bring the mug")
    told = room.listens(speech(2, robot="I look for the pear."), silence())
    assert "Did you say: bring the mug?" in told


def test_the_robots_own_words_are_no_command() -> None:
    room = Room("look for the pear")
    told = room.listens(speech(2, robot="I look for the pear on the bed."), silence())
    assert told == "I begin.\n"
    assert room.became == ["the robot itself"]


@pytest.mark.parametrize("heard", ["", "look for the pear"])
def test_who_speaks_on_after_the_robot_and_is_not_understood_is_told(heard: str) -> None:
    room = Room(heard)
    told = room.listens(speech(2, robot="I look for the pear."), speech(1.5), silence())
    assert OVERSPOKEN in told


def test_what_still_sounds_in_the_room_is_nobody() -> None:
    told = Room("").listens(speech(2, robot="I look for the pear."), speech(0.5), silence())
    assert told == "I begin.\n"


def test_a_yes_that_was_heard_while_the_robot_spoke_is_not_certain() -> None:
    room = Room("bring the mug", Reading("ears", "yes", 0.9, sure=True))
    told = room.listens(speech(1), silence(), speech(1, robot="I look."), silence())
    assert "Please say yes or no: bring the mug?" in told
    assert room.events == []


@pytest.mark.parametrize("busy", [True, False])
def test_a_stop_is_heard_while_the_robot_speaks_and_silences_it(busy: bool) -> None:
    room = Room(busy=busy)
    told = room.listens(speech(1, robot="A long story"), [(STOP, "A long story")], silence())
    assert room.hushed == 1
    assert [type(event) for event in room.events] == [StopRequested] * busy
    assert "nothing to stop" not in told  # it was: the voice


def test_a_stop_is_heard_while_the_ears_think_and_what_they_think_about_is_forgotten() -> None:
    room, stopped = Room("bring the mug"), threading.Event()
    room.think = lambda: stopped.wait(PATIENCE_S)

    def blocks() -> Iterator[Sound]:
        yield from (sound for sound, _ in (*speech(1), *silence()))
        while not room.heard:
            yield QUIET
        yield STOP
        stopped.set()

    room.listen_to(blocks())
    assert "Did you say" not in room.out.getvalue()
    assert [type(event) for event in room.events] == [StopRequested]


def test_who_says_more_than_ears_can_hear_is_told() -> None:
    room, done = Room(*[""] * 9), threading.Event()
    room.think = lambda: done.wait(PATIENCE_S)

    def blocks() -> Iterator[Sound]:
        for sound, _ in (*speech(0.5), *silence()) * 6:
            yield sound
        done.set()

    room.listen_to(blocks())
    assert TOO_MUCH in room.out.getvalue()


def test_why_a_server_could_not_hear_is_told_and_written_down() -> None:
    room = Room(Reading("ears", "", problem="it is out of order"))
    told = room.listens(speech(1), silence())
    assert "I could not hear you: it is out of order. Please say it again, or type it." in told
    assert room.became == ["failed: it is out of order"]


def test_ears_that_raise_do_not_end_the_hearing() -> None:
    room = Room("bring the mug")
    thoughts = iter((True, False))

    def think() -> None:
        if next(thoughts):
            raise ZeroDivisionError

    room.think = think
    told = room.listens(speech(1), silence(), speech(1), silence())
    assert "I could not hear you: the ears failed." in told
    assert "Did you say: bring the mug?" in told


def test_a_goodbye_that_was_heard_ends_nothing_unasked() -> None:
    room = Room("Bye.")
    assert "Did you say: Bye?" in room.listens(speech(1), silence())
    assert room.events == []


def test_a_microphone_that_breaks_off_is_told() -> None:
    def blocks() -> Iterator[Sound]:
        yield QUIET
        raise InputError("--microphone arecord", "it has ended: device lost")

    room = Room()
    room.listen_to(blocks())
    assert "I hear no more: --microphone arecord: it has ended: device lost." in room.out.getvalue()


def test_a_microphone_that_is_switched_off_is_told_once() -> None:
    told = Room().listens([(0 * QUIET, "")] * 250)
    assert told.count(DEAD) == 1


def test_noise_that_goes_on_is_told_once_until_somebody_speaks() -> None:
    room = Room("bring the mug")
    told = room.listens(speech(16), silence(2), speech(40), silence(20), speech(1), silence())
    assert told.count(TOO_LONG) == 1
    assert "Did you say: bring the mug?" in told


def test_sound_in_which_nobody_speaks_is_told_when_it_ends() -> None:
    assert NOBODY in Room().listens(silence(3))


STORY = "It is a long story."


@pytest.mark.parametrize("own", [0, 3], ids=["by headphones", "by a loudspeaker"])
def test_it_falls_silent_for_who_is_louder_and_tells_what_was_not_understood(own: int) -> None:
    room, robot = Room("", ""), np.full(BLOCK, 1 + 1000 * own, dtype=np.int16)
    told = room.listens(
        [(robot, STORY)] * 30, silence(), speech(0.2, robot=STORY), speech(1), silence()
    )
    assert room.hushed == 1
    assert OVERSPOKEN in told


def test_it_goes_on_when_nobody_is_louder_than_itself() -> None:
    room = Room("")
    room.listens(speech(5, robot=STORY), silence())
    assert room.hushed == 0


def test_it_has_to_know_its_own_voice_before_it_gives_way() -> None:
    room = Room("")
    room.listens(silence(1, robot=STORY), speech(3, robot=STORY), silence())
    assert room.hushed == 0
