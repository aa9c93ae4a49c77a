"""Stand-ins for clock, robot, model and person in a replay."""

from collections.abc import Iterable, Mapping
from math import inf

from executive.events import Ended, Event, Inbox, StopRequested
from executive.records import Tick
from executive.situation import Situation
from executive.types.dialogue import Question
from executive.types.goals import Goal, Halt
from executive.types.llm import ChatRequest, RankRequest
from executive.types.results import Succeeded
from logs.recording.reader import Turn


class RecordedTime:
    """The Clock of a replay: each wait advances to the next events of the recording."""

    def __init__(self, turns: Iterable[Turn], inbox: Inbox, requests_before: int) -> None:
        """Play these turns; the session had opened `requests_before` requests before them.

        In the replay, requests are numbered from 1.
        """
        self._turns = iter(turns)
        self._inbox = inbox
        self._requests_before = requests_before
        self._now = 0.0
        self._stopped = False
        self._held_back: tuple[Event, ...] = ()
        self.turn: Turn | None = None
        """The current turn of the recording; None before its beginning, and at its end."""
        self.missed: Turn | None = None
        """The first turn in which the recording has a tick and the replay has not."""
        self._ticked = False

    def now(self) -> float:
        """The recorded mission time (s)."""
        return self._now

    def restart(self) -> None:
        """Do nothing: recorded times begin at 0."""

    def wait(self, deadline: float | None) -> None:
        """Post the next recorded events; at the end, post a stop, then advance to the deadline."""
        if self._inbox.has_events:
            return
        if self._held_back:
            self._post(self._held_back)
        elif (turn := self.next_turn()) is not None:
            self._now = turn.time_s
            self._post(turn.events)
        elif self._stopped and deadline is not None:
            self._now = deadline
        else:
            self.stop("the end of the recording")

    def next_turn(self) -> Turn | None:
        """Advance to the next turn of the recording; None at its end."""
        if self.missed is None and self.turn and self.turn.tick and not self._ticked:
            self.missed = self.turn
        self.turn, self._ticked = next(self._turns, None), False
        return self.turn

    def tick(self) -> Tick | None:
        """The recorded tick for the one that the replay makes now; None if there is none."""
        self._ticked = True
        return self.turn.tick if self.turn else None

    def stop(self, by: str) -> None:
        """End the replay."""
        self._stopped = True
        self._inbox.post(StopRequested(by))

    def _post(self, events: tuple[Event, ...]) -> None:
        """Post these events, up to the end of a request that is not open yet; the rest later.

        This happens if a mission was cut short: the end of `Halt` is in the same turn as the cause.
        """
        self._held_back = ()
        for index, event in enumerate(events):
            match event:
                case Ended(request, result):
                    number = request - self._requests_before
                    if number > self._inbox.last:
                        self._held_back = events[index:]
                        return
                    self._inbox.post(Ended(number, result))
                case StopRequested(by):
                    self.stop(by)
                case _:
                    self._inbox.post(event)


class Absent:
    """Stands in for robot, perception, model and person: opens requests, which end as recorded."""

    name = "absent"
    context_tokens = 4096
    can_rank = True

    def __init__(self, inbox: Inbox, situation: Situation) -> None:
        """Open requests in this inbox; `holding` is read from the situation."""
        self._inbox = inbox
        self._situation = situation
        self.several: Mapping[str, int] = {}
        """Number of head poses for each place that needs more than one."""
        self.ways: Mapping[tuple[str, str], float] = {}
        """Durations of drives from a place to another one (s)."""
        self.rests = False
        """Whether `Halt` succeeds at once, whatever was recorded: early missions did not check."""

    @property
    def holding(self) -> bool | None:
        """What the fingers last felt; changes are among the recorded events."""
        return self._situation.hand.felt

    def start(self, goal: Goal) -> int:
        """Open a request."""
        request = self._inbox.open()
        if self.rests and isinstance(goal, Halt):
            self._inbox.end(request, Succeeded())
        return request

    def see(self) -> int:
        """Open a request."""
        return self._inbox.open()

    def chat(self, request: ChatRequest) -> int:
        """Open a request."""
        return self._inbox.open()

    def rank(self, request: RankRequest) -> int:
        """Open a request."""
        return self._inbox.open()

    def prepare(self, request: ChatRequest | RankRequest) -> None:
        """Do nothing."""

    def ask(self, question: Question) -> int:
        """Open a request."""
        return self._inbox.open()

    def tell(self, text: str) -> None:
        """Do nothing."""

    def cancel(self, request: int) -> None:
        """Drop the request: the recording has no end of it."""
        self._inbox.drop(request)

    def views(self, place: str) -> int:
        """The recorded number of head poses; 1 if none is recorded."""
        return self.several.get(place, 1)

    def seconds(self, start: str, place: str) -> float:
        """The recorded duration (s); infinite if none is recorded."""
        return self.ways.get((start, place), inf)

    def count_tokens(self, text: str) -> int:
        """Return 0: prompts are not compared, so the dialogue need not be shortened."""
        return 0

    def close(self) -> None:
        """Nothing to free."""
