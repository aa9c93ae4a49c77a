"""Collaborators that misbehave: they raise, hang, end twice, end late, talk nonsense."""

import math
import random
from collections.abc import Sequence

from executive.events import Inbox, StopRequested
from executive.interfaces.perception import Perception
from executive.interfaces.robot import Robot
from executive.records import Record
from executive.types.goals import Goal, Halt
from executive.types.llm import ChatRequest, RankRequest, Usage
from executive.types.results import Failed, Replied, Scored, Succeeded
from logs.recorder import Stamp

HOSTILE = (
    "",
    " ",
    "\x1b[2J\x1b[1;1Hdone: all is well",
    "so it is\n    9.999  done: nothing was asked  [person]",
    "\N{RIGHT-TO-LEFT OVERRIDE}ti dnuof ton did I",
    "line\N{LINE SEPARATOR}separator",
    "{object} %s {0}",
    "\ud800",
    "x" * 3000,
)
"""Texts that no adapter should give, and some will."""
REPLIES = (
    "",
    "I would look in the pantry.",
    '{"places": ["pantry", "moon"]}',
    '{"places": ["desk", "sofa"]}',
    '{"places": []}',
    '{"places": ["kitchen"]}',
    '{"places": "desk"}',
    '{"places": [1, null, {"name": "bed"}]}',
    '{"action": "bring", "object": "mug"}',
    '{"kind": "take", "object": "ghost"}',
    "[" * 2000,
    '{"places": ["bed"',
    "<think>desk?</think>",
    *HOSTILE,
)
"""What a model may write, good and bad."""


class ChaosError(Exception):
    """Raised by a collaborator that is out of order."""


class Chaos:
    """Decides, by a seed, which call of which collaborator goes wrong, and where a stop comes."""

    def __init__(self, chance: random.Random, rate: float, stops_at: Sequence[int]) -> None:
        """Strike a call with probability `rate`; post a stop at the calls with these numbers."""
        self.chance = chance
        self.rate = rate
        self._stops_at = set(stops_at)
        self.calls = 0
        self.struck: set[str] = set()
        """Calls that went wrong since `calm` was last set."""

    def call(self, inbox: Inbox) -> None:
        """Count a call; say stop if it is its time."""
        self.calls += 1
        if self.calls in self._stops_at:
            inbox.post(StopRequested(self.chance.choice(("the person", "SIGTERM"))))

    def strikes(self, what: str) -> bool:
        """Whether this call goes wrong."""
        if self.chance.random() >= self.rate:
            return False
        self.struck.add(what)
        return True

    def may_raise(self, what: str) -> None:
        """Raise, perhaps.

        Raises:
            ChaosError: if this call is struck.
        """
        if self.strikes(what):
            raise ChaosError(self.chance.choice(("driver gone", *HOSTILE)))

    def reason(self) -> str:
        """Why something failed, as a careless adapter says it."""
        return self.chance.choice(("the way is blocked", "error 17", *HOSTILE))


class ChaosRobot:
    """A Robot whose driver is out of order now and then."""

    def __init__(self, robot: Robot, chaos: Chaos, inbox: Inbox) -> None:
        """Pass on to `robot` what is not struck."""
        self.inner = robot
        self._chaos = chaos
        self._inbox = inbox
        self._hung: set[int] = set()
        self.goals: list[tuple[int, Goal]] = []
        """Every goal with the number of its request."""
        self.halts = 0
        """How often it was told to halt."""

    @property
    def holding(self) -> bool:
        self._chaos.may_raise("holding")
        return self.inner.holding

    def views(self, place: str) -> int:
        self._chaos.may_raise("views")
        return self.inner.views(place)

    def seconds(self, start: str, place: str) -> float:
        self._chaos.may_raise("seconds")
        return self.inner.seconds(start, place)

    def start(self, goal: Goal) -> int:
        self._chaos.call(self._inbox)
        self.halts += isinstance(goal, Halt)
        self._chaos.may_raise("start")
        request = self._pursue(goal)
        self.goals.append((request, goal))
        return request

    def _pursue(self, goal: Goal) -> int:
        chaos, inbox = self._chaos, self._inbox
        if chaos.strikes("robot hangs"):
            self._hung.add(request := inbox.open())
            return request
        if chaos.strikes("robot fails"):
            inbox.end(request := inbox.open(), Failed(chaos.reason()))
            return request
        request = self.inner.start(goal)
        if chaos.strikes("robot ends what it never began"):
            inbox.end(request + 1000, Succeeded())
        return request

    def cancel(self, request: int) -> None:
        self._chaos.call(self._inbox)
        if request in self._hung and self._chaos.strikes("robot ends late"):
            self._inbox.end(request, Succeeded())
        self._chaos.may_raise("cancel")
        if request not in self._hung:
            self.inner.cancel(request)
        else:
            self._inbox.drop(request)


class ChaosEyes:
    """Perception whose camera is out of order now and then."""

    def __init__(self, perception: Perception, chaos: Chaos, inbox: Inbox) -> None:
        """Pass on to `perception` what is not struck."""
        self._perception = perception
        self._chaos = chaos
        self._inbox = inbox
        self.looks: list[int] = []
        """Requests of pictures that were really taken."""

    def see(self) -> int:
        self._chaos.call(self._inbox)
        self._chaos.may_raise("see")
        if self._chaos.strikes("eyes hang"):
            return self._inbox.open()
        if self._chaos.strikes("eyes fail"):
            self._inbox.end(request := self._inbox.open(), Failed(self._chaos.reason()))
            return request
        request = self._perception.see()
        self.looks.append(request)
        return request

    def cancel(self, request: int) -> None:
        self._chaos.may_raise("cancel of the eyes")
        self._perception.cancel(request)


class ChaosModel:
    """A LanguageModel that writes and scores at random, fails, hangs, or raises.

    `health` is how much of it works: 1 always answers, though not always sense.
    """

    name = "chaos"
    can_rank = True

    def __init__(self, chaos: Chaos, inbox: Inbox, health: float, context_tokens: int) -> None:
        self.context_tokens = context_tokens
        self._chaos = chaos
        self._inbox = inbox
        self._health = health
        self.failed = 0
        """Requests that ended in failure."""
        self.unanswered = 0
        """Requests that have no end."""

    def chat(self, request: ChatRequest) -> int:
        text = self._chaos.chance.choice(REPLIES)
        return self._answer(Replied(request, text, Usage(self.name, 10, 10, 10)))

    def rank(self, request: RankRequest) -> int:
        chance = self._chaos.chance
        scores = [chance.gauss(0.0, 2.0) for _ in request.options]
        if self._chaos.strikes("odd scores"):
            scores = chance.choice(
                ([math.nan] * len(scores), [math.inf, *scores[1:]], [-math.inf] * len(scores))
            )
        return self._answer(Scored(request, tuple(scores), Usage(self.name, 10, 10)))

    def prepare(self, request: ChatRequest | RankRequest) -> None:
        self._chaos.may_raise("prepare")

    def cancel(self, request: int) -> None:
        self._chaos.may_raise("cancel of the model")
        self._inbox.drop(request)

    def count_tokens(self, text: str) -> int:
        return len(text.split())

    def close(self) -> None:
        pass

    def _answer(self, result: Replied | Scored) -> int:
        self._chaos.call(self._inbox)
        self._chaos.may_raise("model")
        request = self._inbox.open()
        if self._chaos.chance.random() < self._health:
            self._inbox.end(request, result)
        elif self._chaos.chance.random() < 0.8:
            self.failed += 1
            why = ("HTTP 429: Rate limit reached", *HOSTILE)
            self._inbox.end(request, Failed(self._chaos.chance.choice(why)))
        else:
            self.unanswered += 1
        return request


class ChaosSink:
    """A log that breaks."""

    def __init__(self, chaos: Chaos) -> None:
        self._chance = random.Random(chaos.chance.random())
        self._rate = chaos.rate / 10

    def write(self, stamp: Stamp, record: Record) -> None:
        self._break()

    def flush(self) -> None:
        self._break()

    def close(self) -> None:
        self._break()

    def _break(self) -> None:
        if self._chance.random() < self._rate:
            raise ChaosError("the log is out of order")
