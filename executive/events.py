"""The events that wake the executive, and the inbox that holds them until they are read.

Slow work (a drive, a grasp, a picture, a reply, an answer) is opened here as a request, goes on
elsewhere, and ends as an `Ended` event. The Inbox is the only object that threads share.
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
"""The longest single sleep (real seconds): Python handles a signal that comes just before a sleep
only after it."""
THE_PERSON = "the person"
"""The source of a stop in words."""
EXPERIMENTER = "the experimenter"
"""The source of a stop in the experimenter's page; a name follows it, if they gave one."""


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
    """The deadline of a behaviour has passed (mission time, seconds)."""

    time: float


@dataclass(frozen=True, slots=True)
class StopRequested:
    """A request to stop the robot: Ctrl-C, SIGTERM, the word "stop", or an experimenter."""

    by: str

    @property
    def ends_session(self) -> bool:
        """Whether it ends the session, as a signal does; a person or experimenter may go on."""
        return self.by != THE_PERSON and not self.is_of_experimenter

    @property
    def is_of_experimenter(self) -> bool:
        """Whether it comes from an experimenter."""
        return self.by.startswith(EXPERIMENTER)


@dataclass(frozen=True, slots=True)
class Heard:
    """The person said something that is not an answer to a question, during a mission."""

    words: str


@dataclass(frozen=True, slots=True)
class HandFelt:
    """What the fingers feel has changed: True: something, False: nothing, None: unknown."""

    holding: bool | None


@dataclass(frozen=True, slots=True)
class Broke:
    """An internal error, in words, as a clause: the mission cannot go on."""

    reason: str


class Deed(StrEnum):
    """What an experimenter may do in place of the person or the robot."""

    ANSWER = "answer"
    """Answer a question in place of the person."""
    HOLD = "hold"
    """From now on hold what the robot says (`on`), or release it (`off`)."""
    WORDS = "words"
    """Release a held sentence, unchanged or changed; empty: do not say it."""
    PLACE = "place"
    """Send the robot to another place: on its way to look, or while its choice is held."""
    HOLD_PLACE = "hold_place"
    """From now on hold the robot's choices of places (`on`), or release them (`off`)."""
    STOP = "stop"


ON, OFF = "on", "off"
"""The values of `HOLD` and `HOLD_PLACE`."""


@dataclass(frozen=True, slots=True)
class Intervened:
    """An experimenter intervened.

    Attributes:
        by: name of the experimenter.
        deed: the kind of intervention: a `Deed`.
        was: the question, the robot's own sentence, or the place that it had chosen.
        became: the answer, the sentence as it was said, or the place where it was sent.
    """

    by: str
    deed: str
    was: str
    became: str


@dataclass(frozen=True, slots=True)
class Listened:
    """Speech was recognised, or not; its effect is an event of its own.

    Attributes:
        by: name of the recogniser.
        text: the words; empty if there were none.
        confidence: in [0, 1]; 0 if the recogniser gives none.
        became: how it was handled: "certain", "asked back", ...
    """

    by: str
    text: str
    confidence: float
    became: str


@dataclass(frozen=True, slots=True)
class BodyTold:
    """A sentence from the robot's body for the person; the body's request goes on.

    For example: the connection is lost and waited for, or is back.
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
    """The end of a computation. It is not an event and causes no tick; its sequel may post one."""

    computation: Computation[Any]


class Inbox:
    """The queue of events for the ticking thread, with open requests and computations.

    `post` may be called from any thread and from a signal handler (SimpleQueue is re-entrant);
    `hear` and `end` from any thread; everything else only from the ticking thread.
    """

    def __init__(self) -> None:
        """Make an inbox without events or requests."""
        self._queue: queue.SimpleQueue[Event | _Computed] = queue.SimpleQueue()
        self._taken: deque[Event] = deque()
        self._open: dict[int, bool] = {}
        self._last = 0
        self._ready: deque[tuple[Worker, Computation[Any]]] = deque()
        self._wanted: dict[Computation[Any], tuple[Callable[[], None], int | None]] = {}

    def open(self, *, real: bool = False) -> int:
        """Open a request; return its number. `real` if its end takes real time (person, model)."""
        self._last += 1
        self._open[self._last] = real
        return self._last

    def drop(self, request: int) -> None:
        """Close a cancelled request: its end, if it still comes, is not delivered.

        Computations for it are abandoned.
        """
        self._open.pop(request, None)
        for computation in [c for c, (_, of) in self._wanted.items() if of == request]:
            self.give_up(computation)

    def drop_all(self) -> None:
        """Close all open requests, as `drop` does."""
        for request in tuple(self._open):
            self.drop(request)

    def fail(self, request: int, reason: str) -> None:
        """End a request as Failed; it is delivered even if the request was dropped."""
        self._open[request] = False
        self.end(request, Failed(reason))

    def post(self, event: Event) -> None:
        """Add an event and wake the thread that waits."""
        self._queue.put(event)

    def hear(self, words: str) -> None:
        """Post what the person says without being asked; words that say stop become a stop."""
        said = writable(words)
        self.post(StopRequested(THE_PERSON) if control(said) else Heard(said))

    def end(self, request: int, result: Result) -> None:
        """Post the end of a request; a value that is not a `Result` becomes Failed.

        An answer that says stop becomes a stop.
        """
        result = _fit(result)
        stops = isinstance(result, Answered) and control(result.text)
        self.post(StopRequested(THE_PERSON) if stops else Ended(request, result))

    @property
    def last(self) -> int:
        """Number of the last request that was opened; 0 if none was."""
        return self._last

    @property
    def awaits_real(self) -> bool:
        """Whether an open request takes real time (a person, a model)."""
        return any(self._open.values())

    @property
    def awaits_anything(self) -> bool:
        """Whether any request is open."""
        return bool(self._open)

    def is_open(self, request: int) -> bool:
        """Whether this request was neither dropped, nor ended and its end taken."""
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
            worker: runs it, as soon as the ticking thread sleeps.
            work: the computation; it runs on the worker's thread.
            sequel: called on the ticking thread when the work has ended.
            request: the request that it is for; if that is dropped, `sequel` is not called.
        """
        computation = Computation(work)
        self._ready.append((worker, computation))
        self._wanted[computation] = (partial(sequel, computation), request)
        return computation

    def give_up(self, computation: Computation[T]) -> None:
        """Abandon a computation; its sequel will not be called."""
        computation.given_up = True
        self._wanted.pop(computation, None)

    @property
    def computes(self) -> bool:
        """Whether any computation is queued or running that was not abandoned."""
        self._collect()
        return bool(self._wanted)

    def await_computed(self, seconds: float) -> bool:
        """Sleep until all computations have ended, or a stop or a message of the body has come.

        Other events have to wait, since it depends on the machine's speed which of them come before
        the end. A message of the body does not: it comes just when a computation takes long.

        Returns:
            False if `seconds` of real time passed first.
        """
        latest = time.monotonic() + seconds
        while self.computes and not self._waits(StopRequested, BodyTold):
            left = latest - time.monotonic()
            if left <= 0:
                return False
            self._sleep(left)
        return True

    def wait(self, seconds: float | None) -> bool:
        """Sleep until there is an event or the time (real seconds; None: no limit) is up.

        Returns:
            Whether there is an event.
        """
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
        """Whether a stop is waiting to be taken."""
        return self._waits(StopRequested)

    def _waits(self, *kinds: type) -> bool:
        """Whether an event of these types is waiting to be taken."""
        self._collect()
        return any(isinstance(event, kinds) for event in self._taken)

    def take_all(self) -> tuple[Event, ...]:
        """Take all events, oldest first.

        Ends of dropped requests, and second ends of the same request, are left out.
        """
        self._collect()
        events = tuple(event for event in self._taken if self._close(event))
        self._taken.clear()
        return events

    def _close(self, event: Event) -> bool:
        """Whether to deliver the event; an `Ended` closes its request."""
        if not isinstance(event, Ended):
            return True
        return self._open.pop(event.request, None) is not None

    def _collect(self) -> bool:
        """Move posted events to `_taken`, drop ends of dropped requests; return if any are left."""
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
        """Start the queued computations, and sleep until something is posted or the time is up."""
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
    """The result with its texts made valid UTF-8; Failed if it is not a result."""
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
