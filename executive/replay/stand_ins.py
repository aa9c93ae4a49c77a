"""What stands in for time, robot, model and person when a recorded mission is run again."""

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
    """The Clock of a replay: each wait goes on to the next events of the recording."""

    def __init__(self, turns: Iterable[Turn], inbox: Inbox, requests_before: int) -> None:
        """Play these turns; their requests are numbered on from `requests_before`."""
        self._turns = iter(turns)
        self._inbox = inbox
        self._requests_before = requests_before
        self._now = 0.0
        self._stopped = False
        self._held_back: tuple[Event, ...] = ()
        self.turn: Turn | None = None
        """The turn of the recording that is played; None at its end."""
        self.missed: Turn | None = None
        """The first turn in which the tree was not ticked although it was when recorded."""
        self._ticked = False

    def now(self) -> float:
        """The recorded mission time (s)."""
        return self._now

    def restart(self) -> None:
        """Nothing to do: the recording has its own start."""

    def wait(self, deadline: float | None) -> None:
        """Post what was recorded next; at the end say stop, then let the deadline pass."""
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
        """Go on to the next turn of the recording."""
        if self.missed is None and self.turn and self.turn.tick and not self._ticked:
            self.missed = self.turn
        self.turn, self._ticked = next(self._turns, None), False
        return self.turn

    def tick(self) -> Tick | None:
        """The tick that was recorded for the one that is made now."""
        self._ticked = True
        return self.turn.tick if self.turn else None

    def stop(self, by: str) -> None:
        """End the replay."""
        self._stopped = True
        self._inbox.post(StopRequested(by))

    def _post(self, events: tuple[Event, ...]) -> None:
        """Post these events up to the end of what is yet to be started: that, when it was.

        Where the mission was cut short, the end of `Halt` is in the same turn as what cut it short.
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
    """Stands in for robot, perception, model and person: numbers requests that end as recorded."""

    name = "absent"
    context_tokens = 4096
    can_rank = True

    def __init__(self, inbox: Inbox, situation: Situation) -> None:
        """Open requests in this inbox; the fingers feel what is known in this situation."""
        self._inbox = inbox
        self._situation = situation
        self.several: Mapping[str, int] = {}
        """How many views it takes to see the places for which one is not enough."""
        self.ways: Mapping[tuple[str, str], float] = {}
        """How long the ways take, from a place to another one (s)."""
        self.rests = False
        """Whether it halts at once, whatever was recorded: that was not judged in earlier days."""

    @property
    def holding(self) -> bool | None:
        """What they felt before: what they felt anew is among the recorded events."""
        return self._situation.hand.felt

    def start(self, goal: Goal) -> int:
        """Pursue nothing."""
        request = self._inbox.open()
        if self.rests and isinstance(goal, Halt):
            self._inbox.end(request, Succeeded())
        return request

    def see(self) -> int:
        """Look at nothing."""
        return self._inbox.open()

    def chat(self, request: ChatRequest) -> int:
        """Think nothing."""
        return self._inbox.open()

    def rank(self, request: RankRequest) -> int:
        """Think nothing."""
        return self._inbox.open()

    def prepare(self, request: ChatRequest | RankRequest) -> None:
        """Prepare nothing."""

    def ask(self, question: Question) -> int:
        """Ask nobody."""
        return self._inbox.open()

    def tell(self, text: str) -> None:
        """Tell nobody."""

    def cancel(self, request: int) -> None:
        """Its end, had it come, was not recorded."""
        self._inbox.drop(request)

    def views(self, place: str) -> int:
        """As many as when it was recorded."""
        return self.several.get(place, 1)

    def seconds(self, start: str, place: str) -> float:
        """As it was told when it was recorded."""
        return self.ways.get((start, place), inf)

    def count_tokens(self, text: str) -> int:
        """None: prompts are not judged, and memory need not be short."""
        return 0

    def close(self) -> None:
        """Nothing to free."""
