"""Wrappers around code of others, which let none of its exceptions reach the executive.

Robot, perception, person and model may be anybody's code. If one raises when it is asked to start
something, that becomes a failed request with a reason, and so an event like any other: it is
recorded, and a replay is the same. If it raises anywhere else, the exception is noted in the log,
and the mission goes on.
"""

import logging
import traceback
from abc import ABC, abstractmethod
from collections.abc import Callable
from typing import Any, TypeVar

from executive.belief import Statement
from executive.errors import ExecutiveError
from executive.events import Inbox
from executive.interfaces.dialogue import User
from executive.interfaces.knowledge import Experience, PlaceSource
from executive.interfaces.llm import LanguageModel
from executive.interfaces.perception import Perception
from executive.interfaces.robot import Robot
from executive.interfaces.runtime import Recorder
from executive.records import Note, Recalled, Record, SourceAnswer
from executive.text import printable, writable
from executive.types.dialogue import Question
from executive.types.goals import DriveTo, Goal, Halt, LookAt
from executive.types.llm import ChatRequest, RankRequest

T = TypeVar("T")

UNKNOWN_WAY_S = 10.0
"""The assumed duration of a drive that the robot cannot estimate."""
LONGEST = 120
"""The text of a foreign exception is cut to this many characters."""
WHOLE = 500
"""The same for our own exceptions, which are longer: at the end they say what would be right."""

log = logging.getLogger(__name__)


def in_words(error: BaseException) -> str:
    """An exception as a clause: "ConnectionError: driver gone"; of our own, only the message."""
    name = type(error).__name__
    try:
        said = printable(error).strip()
    except Exception:
        said = ""
    if isinstance(error, ExecutiveError) and said:
        return said[:WHOLE]
    return f"{name}: {said}"[:LONGEST] if said else name


def traceback_of(error: BaseException) -> str:
    """The traceback of an exception, as Python prints it."""
    try:
        return writable("".join(traceback.format_exception(error)))
    except Exception:  # an exception that cannot even be printed
        return type(error).__name__


class GuardedRecorder:
    """Implements `Recorder` around one that may raise: then that record is lost."""

    def __init__(self, recorder: Recorder) -> None:
        """Guard this recorder."""
        self._recorder = recorder

    def record(self, record: Record) -> None:
        """Pass the record on; if that raises, warn."""
        try:
            self._recorder.record(record)
        except Exception as error:
            log.warning("a record was lost: %s", in_words(error))


class _Fault:
    """Reports the exceptions of one part: each as a note in the log, the first as a warning."""

    def __init__(self, what: str, recorder: Recorder) -> None:
        self._what = what
        self._recorder = recorder
        self._told = False

    def tell(self, error: Exception) -> None:
        level = logging.DEBUG if self._told else logging.WARNING
        log.log(level, "%s: %s", self._what, in_words(error))
        self._recorder.record(Note("error", traceback_of(error)))
        self._told = True


class GuardedSource:
    """Implements `PlaceSource` around one that may raise: then it knows no place.

    Each answer is recorded, so that a replay gets the same. The first exception is a warning.
    """

    def __init__(self, source: PlaceSource, recorder: Recorder) -> None:
        """Guard this source; its `name` and `says` are read once, here."""
        self._source = source
        self._recorder = GuardedRecorder(recorder)
        self.name = printable(source.name)
        self.says = printable(source.says)
        self._fault = _Fault(f"the {self.name} does not answer", self._recorder)

    def places_of(self, name: str) -> tuple[str, ...]:
        """The places that the source names for this thing; recorded."""
        places = self._ask(name)
        self._recorder.record(SourceAnswer(self.name, name, places))
        return places

    def _ask(self, name: str) -> tuple[str, ...]:
        try:
            said: Any = self._source.places_of(name)
            places = [said] if isinstance(said, str) else said
            return tuple(writable(str(place)) for place in places)
        except Exception as error:
            self._fault.tell(error)
            return ()


class GuardedExperience:
    """Implements `Experience` around one that may raise: then nothing was learned.

    Each answer is recorded, so that a replay gets the same.
    """

    def __init__(self, experience: Experience, recorder: Recorder) -> None:
        """Guard this experience."""
        self._experience = experience
        self._recorder = GuardedRecorder(recorder)
        self._fault = _Fault("what was learned is of no use", self._recorder)

    def learn(self) -> None:
        """Learn from what is remembered; nothing is learned if that raises."""
        try:
            self._experience.learn()
        except Exception as error:
            self._fault.tell(error)

    def recalled(self, name: str) -> tuple[Statement, ...]:
        """What was learned about this thing; recorded."""
        try:
            said = tuple(self._experience.recalled(name))
        except Exception as error:
            self._fault.tell(error)
            said = ()
        each = [(one.source, *pair) for one in said for pair in one.weights]
        self._recorder.record(
            Recalled(
                thing=name,
                sources=tuple(one.source for one in said),
                trusts=tuple(one.trust for one in said),
                places=tuple(place for _, place, _ in each),
                says=tuple(source for source, _, _ in each),
                weights=tuple(weight for _, _, weight in each),
            )
        )
        return said


class _Guard(ABC):
    """Turns the exceptions of a part into failed requests and notes in the log."""

    def __init__(self, inbox: Inbox, recorder: Recorder) -> None:
        self._inbox = inbox
        self._recorder = GuardedRecorder(recorder)

    @abstractmethod
    def _cancel(self, request: int) -> None:
        """Cancel the request at the guarded part."""

    def cancel(self, request: int) -> None:
        """Cancel a request; its end is not delivered, even if cancelling raises."""
        self._try(lambda: self._cancel(request), None)
        self._inbox.drop(request)

    def _start(self, clause: str, start: Callable[[], int]) -> int:
        """Start something; return its request, or if `start` raises, one that has failed.

        `clause` says what failed, in the reason. Requests that `start` opened before it raised are
        cancelled. The failed request takes the number of the first of them: so the requests after
        it have the same numbers in a replay, where nothing raises.
        """
        before = self._inbox.last
        try:
            request = start()
            if self._inbox.is_open(request):
                return request
            raise TypeError(f"{request!r} is not the number of a new request")
        except Exception as error:
            self._note(error)
            for opened in range(before + 1, self._inbox.last + 1):
                self.cancel(opened)
            request = before + 1 if self._inbox.last > before else self._inbox.open()
            self._inbox.fail(request, f"{clause}: {in_words(error)}")
            return request

    def _try(self, do: Callable[[], T], otherwise: T) -> T:
        try:
            return do()
        except Exception as error:
            self._note(error)
            return otherwise

    def _note(self, error: Exception) -> None:
        log.debug("raised by a part of the robot", exc_info=error)
        self._recorder.record(Note("error", traceback_of(error)))


class GuardedRobot(_Guard):
    """Implements `Robot` around one that may raise."""

    def __init__(self, robot: Robot, inbox: Inbox, recorder: Recorder) -> None:
        """Guard this robot."""
        super().__init__(inbox, recorder)
        self._robot = robot

    def start(self, goal: Goal) -> int:
        """Start to pursue a goal."""
        return self._start(f"my {_part(goal)} failed", lambda: self._robot.start(goal))

    def _cancel(self, request: int) -> None:
        self._robot.cancel(request)

    def views(self, place: str) -> int:
        """How many head poses it takes to see all of a place; 1 if the robot cannot tell."""
        return max(1, self._try(lambda: int(self._robot.views(place)), 1))

    def seconds(self, start: str, place: str) -> float:
        """How long the drive takes (s); `UNKNOWN_WAY_S` if the robot cannot tell."""
        if not hasattr(self._robot, "seconds"):
            return UNKNOWN_WAY_S
        seconds = self._try(lambda: float(self._robot.seconds(start, place)), UNKNOWN_WAY_S)
        return seconds if seconds >= 0 else UNKNOWN_WAY_S

    @property
    def holding(self) -> bool | None:
        """Whether the fingers feel something; None if the robot cannot tell."""
        return self._try(self._holding, None)

    def _holding(self) -> bool | None:
        holding = self._robot.holding
        return None if holding is None else bool(holding)


def _part(goal: Goal) -> str:
    """The part of the robot that pursues such a goal, as a word for the person."""
    match goal:
        case DriveTo():
            return "base"
        case LookAt():
            return "head"
        case Halt():
            return "brake"
        case _:
            return "arm"


class GuardedPerception(_Guard):
    """Implements `Perception` around one that may raise."""

    def __init__(self, perception: Perception, inbox: Inbox, recorder: Recorder) -> None:
        """Guard this perception."""
        super().__init__(inbox, recorder)
        self._perception = perception

    def see(self) -> int:
        """Start to take a picture and recognise what is in it."""
        return self._start("my camera failed", lambda: self._perception.see())

    def _cancel(self, request: int) -> None:
        self._perception.cancel(request)


class GuardedUser(_Guard):
    """Implements `User` around one that may raise."""

    def __init__(self, user: User, inbox: Inbox, recorder: Recorder) -> None:
        """Guard this person's interface."""
        super().__init__(inbox, recorder)
        self._user = user

    def ask(self, question: Question) -> int:
        """Start to ask a question."""
        return self._start("I cannot ask you", lambda: self._user.ask(question))

    def _cancel(self, request: int) -> None:
        self._user.cancel(request)

    def tell(self, text: str) -> None:
        """Say something to the person."""
        self._try(lambda: self._user.tell(text), None)


class GuardedModel(_Guard):
    """Implements `LanguageModel` around one that may raise."""

    def __init__(self, model: LanguageModel, inbox: Inbox, recorder: Recorder) -> None:
        """Guard this model."""
        super().__init__(inbox, recorder)
        self._model = model

    @property
    def name(self) -> str:
        """Name for the logs."""
        return self._try(lambda: self._model.name, "a model without a name")

    @property
    def context_tokens(self) -> int:
        """Size of its context window (tokens)."""
        return self._try(lambda: self._model.context_tokens, 0)

    @property
    def can_rank(self) -> bool:
        """Whether `rank` is available."""
        return self._try(lambda: self._model.can_rank, False)

    def chat(self, request: ChatRequest) -> int:
        """Start to write a reply."""
        return self._start("my language model failed", lambda: self._model.chat(request))

    def rank(self, request: RankRequest) -> int:
        """Start to score the options."""
        return self._start("my language model failed", lambda: self._model.rank(request))

    def prepare(self, request: ChatRequest | RankRequest) -> None:
        """Let the model get ready for such a request."""
        self._try(lambda: self._model.prepare(request), None)

    def _cancel(self, request: int) -> None:
        self._model.cancel(request)

    def count_tokens(self, text: str) -> int:
        """Length of a text in tokens; if the model cannot tell, its bytes (never too few)."""
        return self._try(lambda: self._model.count_tokens(text), len(text.encode()))

    def close(self) -> None:
        """Free the model."""
        self._try(lambda: self._model.close(), None)
