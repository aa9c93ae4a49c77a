"""The events that wake the executive, and the inbox where they wait for it.

Whatever is slow (a drive, a grasp, a picture, a reply, an answer) is opened as a request in the
inbox, goes on elsewhere, and ends as an `Ended` event. Threads share nothing but the inbox.
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
"""The longest single sleep (real time): a signal just before one is handled only after it."""
THE_PERSON = "the person"
"""`StopRequested.by` of a stop in words."""
EXPERIMENTER = "the experimenter"
"""How `StopRequested.by` begins if an experimenter says stop; their name may follow."""


@dataclass(frozen=True, slots=True)
class Started:
    """A command was given; the mission begins."""

    words: str


@dataclass(frozen=True, slots=True, eq=False)
class Ended:
    """A request has ended, as a success or not."""

    request: int
    result: Result


@dataclass(frozen=True, slots=True)
class DeadlinePassed:
    """The deadline of a behaviour has passed; `time` is the mission time (s)."""

    time: float


@dataclass(frozen=True, slots=True)
class StopRequested:
    """Someone says stop: by Ctrl-C, by SIGTERM, in words, or as an experimenter."""

    by: str

    @property
    def ends_session(self) -> bool:
        """Whether it ends the session, as a signal does; after others, talking may go on."""
        return self.by != THE_PERSON and not self.is_of_experimenter

    @property
    def is_of_experimenter(self) -> bool:
        """Whether an experimenter says stop."""
        return self.by.startswith(EXPERIMENTER)


@dataclass(frozen=True, slots=True)
class Heard:
    """The person said something that answers no question, while the robot is busy."""

    words: str


@dataclass(frozen=True, slots=True)
class HandFelt:
    """What the fingers feel has changed: a thing or none; None if the robot cannot tell."""

    holding: bool | None


@dataclass(frozen=True, slots=True)
class Broke:
    """The program itself has failed, for this reason (a clause); the mission cannot go on."""

    reason: str


class Deed(StrEnum):
    """What an experimenter can do in place of the person or the robot."""

    ANSWER = "answer"
    """Answer a question in place of the person."""
    HOLD = "hold"
    """Hold all sentences of the robot from now on (`on`), or do so no longer (`off`)."""
    WORDS = "words"
    """Release a held sentence, as it was or changed; an empty one is never said."""
    PLACE = "place"
    """Send the robot to another place: while it drives to look, or while its choice is held."""
    HOLD_PLACE = "hold_place"
    """Hold all of the robot's choices of places from now on (`on`), or no longer (`off`)."""
    STOP = "stop"


ON, OFF = "on", "off"
"""Values of `Intervened.became` for `HOLD` and `HOLD_PLACE`."""


@dataclass(frozen=True, slots=True)
class Intervened:
    """An experimenter intervened.

    Attributes:
        by: the experimenter.
        deed: what was done: a `Deed`.
        was: the question, the robot's own sentence, or the place that the robot had chosen.
        became: the answer, the sentence that was said, or the place where the robot was sent.
    """

    by: str
    deed: str
    was: str
    became: str


@dataclass(frozen=True, slots=True)
class Listened:
    """A speech recogniser has understood something; what follows from it is an event of its own.

    Attributes:
        by: the recogniser.
        text: the words; empty if there were none.
        confidence: between 0 and 1; 0 if the recogniser does not tell.
        became: what was done with the words: "certain", "asked back", ...
    """

    by: str
    text: str
    confidence: float
    became: str


@dataclass(frozen=True, slots=True)
class BodyTold:
    """The robot's body tells the person something, in a sentence, and goes on with what it does.

    For example that a connection is lost and the robot waits for it, and that it is back.
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
    """A computation is done. This is no event, and no cause to tick; its sequel may post one."""

    computation: Computation[Any]


class Inbox:
    """Events on their way to the ticking thread, open requests, and computations for it.

    `post` may be called from any thread and from a signal handler (SimpleQueue is re-entrant);
    `hear` and `end` from any thread; everything else only from the ticking thread.
    """

    def __init__(self) -> None:
        """Begin empty, with no request open."""
        self._queue: queue.SimpleQueue[Event | _Computed] = queue.SimpleQueue()
        self._taken: deque[Event] = deque()
        self._open: dict[int, bool] = {}
        self._last = 0
        self._ready: deque[tuple[Worker, Computation[Any]]] = deque()
        self._wanted: dict[Computation[Any], tuple[Callable[[], None], int | None]] = {}

    def open(self, *, real: bool = False) -> int:
        """Open a request; `real` if a person or a model will end it, not the simulator."""
        self._last += 1
        self._open[self._last] = real
        return self._last

    def drop(self, request: int) -> None:
        """Forget a cancelled request: its end is not delivered, should it still come.

        Computations for it are given up.
        """
        self._open.pop(request, None)
        for computation in [c for c, (_, of) in self._wanted.items() if of == request]:
            self.give_up(computation)

    def drop_all(self) -> None:
        """Forget all open requests."""
        for request in tuple(self._open):
            self.drop(request)

    def fail(self, request: int, reason: str) -> None:
        """End a request as Failed, also one that was dropped, for a part that cannot do so."""
        self._open[request] = False
        self.end(request, Failed(reason))

    def post(self, event: Event) -> None:
        """Put an event into the inbox, and wake the ticking thread."""
        self._queue.put(event)

    def hear(self, words: str) -> None:
        """Post what the person says unasked; words that say stop are a stop."""
        said = writable(words)
        self.post(StopRequested(THE_PERSON) if control(said) else Heard(said))

    def end(self, request: int, result: Result) -> None:
        """Post the end of a request; any object that is not a result becomes Failed.

        An answer that says stop is a stop.
        """
        result = _fit(result)
        stops = isinstance(result, Answered) and control(result.text)
        self.post(StopRequested(THE_PERSON) if stops else Ended(request, result))

    @property
    def last(self) -> int:
        """Number of the latest request (0: none yet)."""
        return self._last

    @property
    def awaits_real(self) -> bool:
        """Whether a request is open that takes real time (of a person or a model)."""
        return any(self._open.values())

    @property
    def awaits_anything(self) -> bool:
        """Whether any request is open."""
        return bool(self._open)

    def is_open(self, request: int) -> bool:
        """Whether a request is open: neither dropped, nor its end taken."""
        return request in self._open

    def compute(
        self,
        worker: Worker,
        work: Callable[[], T],
        sequel: Callable[[Computation[T]], None],
        request: int | None = None,
    ) -> Computation[T]:
        """Queue a computation, during which mission time stands still.

        Args:
            worker: does it, as soon as the ticking thread sleeps.
            work: the computation.
            sequel: called in the ticking thread, when it wakes after that.
            request: what the computation is for; if this is dropped, there is no sequel.
        """
        computation = Computation(work)
        self._ready.append((worker, computation))
        self._wanted[computation] = (partial(sequel, computation), request)
        return computation

    def give_up(self, computation: Computation[T]) -> None:
        """Give a computation up: there will be no sequel."""
        computation.given_up = True
        self._wanted.pop(computation, None)

    @property
    def computes(self) -> bool:
        """Whether a computation is under way that was not given up."""
        self._collect()
        return bool(self._wanted)

    def await_computed(self, seconds: float) -> bool:
        """Sleep until all computations are done, or someone says stop.

        Other events must wait: how many of them come before the end depends on how fast the machine
        is, and a mission must not. Only what the body tells does not wait: it tells why it takes
        long. Returns False if the time (real seconds) is up first.
        """
        latest = time.monotonic() + seconds
        while self.computes and not self._waits(StopRequested, BodyTold):
            left = latest - time.monotonic()
            if left <= 0:
                return False
            self._sleep(left)
        return True

    def wait(self, seconds: float | None) -> bool:
        """Sleep until there is an event, or the time is up (real seconds; None: no limit)."""
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
        """Whether a stop waits in the inbox."""
        return self._waits(StopRequested)

    def _waits(self, *kinds: type) -> bool:
        """Whether an event of one of these kinds waits in the inbox."""
        self._collect()
        return any(isinstance(event, kinds) for event in self._taken)

    def take_all(self) -> tuple[Event, ...]:
        """Take all events, the oldest first.

        Ends of dropped requests, and second ends of the same request, are left out.
        """
        self._collect()
        events = tuple(event for event in self._taken if self._close(event))
        self._taken.clear()
        return events

    def _close(self, event: Event) -> bool:
        """Close the request of an end; return whether the event counts."""
        if not isinstance(event, Ended):
            return True
        return self._open.pop(event.request, None) is not None

    def _collect(self) -> bool:
        """Receive all that was posted; return whether there are events.

        Ends of dropped requests are removed.
        """
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
        """Start the computations that are ready; sleep until something comes or time is up."""
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
    """The same result, with texts that can be written to a file, whatever an adapter made."""
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
