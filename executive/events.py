"""Everything that can wake the executive, and the one box where it waits to be read.

Slow things (a drive, a grasp, a picture, a reply, an answer) are opened here as a request, go on
elsewhere, and end as an `Ended` event. The Inbox is the only thing that threads share.
"""

import math
import queue
import time
from collections import deque
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, replace
from enum import StrEnum
from functools import partial
from typing import Any, TypeVar

from executive.computing import Computation, Worker
from executive.language.control import control
from executive.text import writable
from executive.types.results import Answered, Failed, Replied, Result, Saw, Scored, Succeeded

T = TypeVar("T")

HEEDING_S = 0.2
"""The longest sleep at a stretch (real time): a signal just before it is heeded only after it."""
THE_PERSON = "the person"
"""Who says stop in words."""
EXPERIMENTER = "the experimenter"
"""Who says stop in the experimenter's page; their name comes after it, if they gave one."""


@dataclass(frozen=True, slots=True)
class Started:
    """A command was given; the mission begins."""

    words: str


@dataclass(frozen=True, slots=True, eq=False)
class Ended:
    """The request with this number ended, well or not."""

    request: int
    result: Result


@dataclass(frozen=True, slots=True)
class DeadlinePassed:
    """The time that some behaviour waited for has come (mission time, seconds)."""

    time: float


@dataclass(frozen=True, slots=True)
class StopRequested:
    """Someone wants the robot at rest: Ctrl-C, SIGTERM, the word "stop", or an experimenter."""

    by: str

    @property
    def ends_session(self) -> bool:
        """Whether it is for good, as a signal is: who talks with the robot may go on."""
        return self.by != THE_PERSON and not self.is_of_experimenter

    @property
    def is_of_experimenter(self) -> bool:
        """Whether an experimenter said so."""
        return self.by.startswith(EXPERIMENTER)


@dataclass(frozen=True, slots=True)
class Heard:
    """The person said something that answers no question, while the robot is at something."""

    words: str


@dataclass(frozen=True, slots=True)
class HandFelt:
    """What the fingers feel is not what they felt before: something, nothing; None: no telling."""

    holding: bool | None


@dataclass(frozen=True, slots=True)
class Broke:
    """The program itself failed, and why, as a clause: the mission cannot go on."""

    reason: str


class Deed(StrEnum):
    """What an experimenter may do in somebody's stead."""

    ANSWER = "answer"
    """Answer a question in the person's stead."""
    HOLD = "hold"
    """Hold what the robot says from here on, or let it go."""
    WORDS = "words"
    """Let a sentence go that was held, as it was or otherwise; empty: it is never said."""
    PLACE = "place"
    """Send the robot elsewhere than it would go: on its way to look, or where its choice waits."""
    HOLD_PLACE = "hold_place"
    """Hold what the robot chooses from here on of places (`on`), or let it go (`off`)."""
    STOP = "stop"


ON, OFF = "on", "off"
"""What becomes of `HOLD` and `HOLD_PLACE`."""


@dataclass(frozen=True, slots=True)
class Intervened:
    """An experimenter stepped in.

    Attributes:
        by: who.
        deed: what was done: a `Deed`.
        was: the question; the sentence as the robot made it; the place that it had chosen.
        became: the answer; the sentence as it was said; the place where it was sent.
    """

    by: str
    deed: str
    was: str
    became: str


@dataclass(frozen=True, slots=True)
class Listened:
    """Ears understood something; what comes of it is an event of its own.

    Attributes:
        by: which ears.
        text: the words; empty if there were none.
        confidence: between 0 and 1; 0 if the ears cannot tell.
        became: what was made of it: "certain", "asked back", ...
    """

    by: str
    text: str
    confidence: float
    became: str


@dataclass(frozen=True, slots=True)
class BodyTold:
    """The robot's body has something to tell the person, a sentence, and goes on with what it does.

    So is told that a link is lost and waited for, and that it is back.
    """

    words: str


Event = (
    Started
    | Ended
    | DeadlinePassed
    | StopRequested
    | Heard
    | HandFelt
    | Broke
    | Intervened
    | Listened
    | BodyTold
)


@dataclass(frozen=True, slots=True, eq=False)
class _Computed:
    """Not an event: nobody ticks for it. Its sequel may post one."""

    computation: Computation[Any]


class Inbox:
    """Events on their way to the thread that ticks, and what is computed for it meanwhile.

    `post` may be called from any thread and from a signal handler (SimpleQueue is re-entrant), and
    `hear` and `end` from any thread; the rest belongs to the thread that ticks.
    """

    def __init__(self) -> None:
        """Make an empty box with nothing under way."""
        self._queue: queue.SimpleQueue[Event | _Computed] = queue.SimpleQueue()
        self._taken: deque[Event] = deque()
        self._open: dict[int, bool] = {}
        self._last = 0
        self._ready: deque[tuple[Worker, Computation[Any]]] = deque()
        self._wanted: dict[Computation[Any], tuple[Callable[[], None], int | None]] = {}

    def open(self, *, real: bool = False) -> int:
        """Number a new request; `real` if a person or a model, not the simulator, will end it."""
        self._last += 1
        self._open[self._last] = real
        return self._last

    def drop(self, request: int) -> None:
        """Forget a cancelled request: its end, should it still come, is not delivered.

        What is computed for it is given up.
        """
        self._open.pop(request, None)
        for computation in [c for c, (_, of) in self._wanted.items() if of == request]:
            self.give_up(computation)

    def drop_all(self) -> None:
        """Forget every request that is under way: what was asked for is not wanted any more."""
        for request in tuple(self._open):
            self.drop(request)

    def fail(self, request: int, reason: str) -> None:
        """End a request as Failed for one who cannot: it counts, even if it was dropped."""
        self._open[request] = False
        self.end(request, Failed(reason))

    def post(self, event: Event) -> None:
        """Put an event in the box and wake whoever waits."""
        self._queue.put(event)

    def hear(self, words: str) -> None:
        """Post what the person says unasked, from any thread; what says stop is a stop."""
        said = writable(words)
        self.post(StopRequested(THE_PERSON) if control(said) else Heard(said))

    def end(self, request: int, result: Result) -> None:
        """Post the end of a request; what is no result is Failed.

        An answer that says stop is a stop, whoever was asked.
        """
        result = _fit(result)
        stops = isinstance(result, Answered) and control(result.text)
        self.post(StopRequested(THE_PERSON) if stops else Ended(request, result))

    @property
    def last(self) -> int:
        """Number of the last request that was opened (0: none yet)."""
        return self._last

    @property
    def awaits_real(self) -> bool:
        """Whether something that takes real time (a person, a model) is under way."""
        return any(self._open.values())

    @property
    def awaits_anything(self) -> bool:
        """Whether any request is under way."""
        return bool(self._open)

    def is_open(self, request: int) -> bool:
        """Whether this request was neither ended (and its end taken) nor dropped."""
        return request in self._open

    def compute(
        self,
        worker: Worker,
        work: Callable[[], T],
        sequel: Callable[[Computation[T]], None],
        request: int | None = None,
    ) -> Computation[T]:
        """Have something computed, while mission time stands still.

        Args:
            worker: who does it, as soon as the ticking thread sleeps.
            work: what.
            sequel: done by the ticking thread when it wakes.
            request: for which it is; where that is dropped, there is no sequel.
        """
        computation = Computation(work)
        self._ready.append((worker, computation))
        self._wanted[computation] = (partial(sequel, computation), request)
        return computation

    def give_up(self, computation: Computation[T]) -> None:
        """Nobody waits for it any more: there will be no sequel."""
        computation.given_up = True
        self._wanted.pop(computation, None)

    @property
    def computes(self) -> bool:
        """Whether something is computed that is still wanted."""
        self._collect()
        return bool(self._wanted)

    def await_computed(self, seconds: float) -> bool:
        """Sleep until all is computed or someone says stop; False if the real time is up first.

        Other events wait: which of them would come before the end is the machine's chance. But a
        body has something to tell just when it takes long.
        """
        latest = time.monotonic() + seconds
        while self.computes and not self._waits(StopRequested, BodyTold):
            left = latest - time.monotonic()
            if left <= 0:
                return False
            self._sleep(left)
        return True

    def wait(self, seconds: float | None) -> bool:
        """Sleep until an event is there or the time (real seconds; None: no limit) is up."""
        if self._collect():
            return True
        self._sleep(seconds)
        return self._collect()

    @property
    def has_events(self) -> bool:
        """Whether `take_all` would return anything now."""
        return self._collect()

    @property
    def stop_waits(self) -> bool:
        """Whether someone said stop, and nobody has heard it yet."""
        return self._waits(StopRequested)

    def _waits(self, *kinds: type) -> bool:
        """Whether there is such an event, and nobody has taken it yet."""
        self._collect()
        return any(isinstance(event, kinds) for event in self._taken)

    def take_all(self) -> tuple[Event, ...]:
        """Empty the box, oldest first.

        Ends of dropped requests are left out, and so is a second end of the same request.
        """
        self._collect()
        events = tuple(event for event in self._taken if self._close(event))
        self._taken.clear()
        return events

    def _close(self, event: Event) -> bool:
        """Whether the event counts; an end closes its request."""
        if not isinstance(event, Ended):
            return True
        return self._open.pop(event.request, None) is not None

    def _collect(self) -> bool:
        """Move what was posted to the taken side, less the ends of dropped requests."""
        while True:
            try:
                self._receive(self._queue.get_nowait())
            except queue.Empty:
                break
        self._taken = deque(
            e for e in self._taken if not isinstance(e, Ended) or e.request in self._open
        )
        return bool(self._taken)

    def _sleep(self, seconds: float | None) -> None:
        """Have computed what is ready, until something comes or the time is up."""
        while self._ready:
            worker, computation = self._ready.popleft()
            if computation in self._wanted:
                worker.start(computation, partial(self._queue.put, _Computed(computation)))
        latest = math.inf if seconds is None else time.monotonic() + seconds
        while (left := latest - time.monotonic()) > 0:
            with suppress(queue.Empty):
                self._receive(self._queue.get(timeout=min(left, HEEDING_S)))
                return

    def _receive(self, item: Event | _Computed) -> None:
        if not isinstance(item, _Computed):
            self._taken.append(item)
        elif wanted := self._wanted.pop(item.computation, None):
            item.computation.settle()
            wanted[0]()


def _fit(result: Result) -> Result:
    """The result with texts that can be written down, whoever made it."""
    match result:
        case Failed(reason):
            return replace(result, reason=_text(reason))
        case Answered(text):
            return Answered(_text(text))
        case Replied(text=text):
            return replace(result, text=_text(text))
        case Succeeded() | Saw() | Scored():
            return result
        case _:
            return Failed(f"it ended with {type(result).__name__}, which is no result")


def _text(text: object) -> str:
    return writable(text if isinstance(text, str) else repr(text))
