"""The kinds of behaviour that the subtrees are made of, in addition to those of py_trees.

The tree is ticked by events. So a behaviour may be RUNNING only while something that it started is
under way: a loop goes on to its next item within the same tick, and whatever waits has a deadline.
"""

from abc import abstractmethod
from collections.abc import Callable, Iterable, Iterator
from typing import Any

from py_trees import composites
from py_trees.behaviour import Behaviour
from py_trees.common import BlackBoxLevel, ParallelPolicy, Status
from py_trees.composites import Parallel, Sequence
from py_trees.decorators import Decorator, FailureIsSuccess

from executive.situation import Situation
from executive.text import printable
from executive.types.results import Failed, Result
from trees.context import MissionContext

LONGEST = 400
"""Most characters of a reason that an adapter gives: it becomes a clause of a sentence."""
UNSAID = "it did not work, and nothing said why"
"""The reason when none was given."""


class Selector(composites.Selector):
    """A fallback that keeps why its last child failed, so that the next ones can tell it."""

    reason = ""

    def tick(self) -> Iterator[Behaviour]:
        """Tick the children as py_trees does, and note the reason of each that fails."""
        if self.status != Status.RUNNING:
            self.reason = ""
        for node in super().tick():
            if node.parent is self and node.status == Status.FAILURE:
                self.reason = reason_of(node) or self.reason
            yield node


def sequence(name: str, *children: Behaviour, activity: str = "") -> Sequence:
    """A sequence with memory; `activity` is what the robot does meanwhile, for the log."""
    node = Sequence(name, memory=True, children=list(children))
    vars(node)["activity"] = activity
    return node


def stages(name: str, *children: Behaviour) -> Sequence:
    """A sequence whose children are parts of the mission, each with a lane in the viewer."""
    for child in children:
        child.blackbox_level = BlackBoxLevel.BIG_PICTURE
    return sequence(name, *children)


def as_long_as(name: str, *children: Behaviour) -> Sequence:
    """A sequence without memory: at each tick the conditions before the last child must hold."""
    return Sequence(name, memory=False, children=list(children))


def beside(name: str, aside: Behaviour, main: Behaviour) -> Parallel:
    """Both in parallel: it ends when `main` does, and as `main` does. `aside` must never fail."""
    policy = ParallelPolicy.SuccessOnSelected([main], synchronise=True)
    return Parallel(name, policy, children=[aside, main])


def fallback(name: str, *children: Behaviour) -> Selector:
    """A fallback with memory: the first child that succeeds."""
    return Selector(name, memory=True, children=list(children))


class Step(Behaviour):
    """A behaviour that decides at once: a condition, or a change of the situation.

    Classes, or single instances, declare `source` and `activity` for those who read the log; nobody
    guesses them from a name. See `executive.records.NodeShape`.
    """

    source: str = ""
    activity: str = ""

    def __init__(self, name: str, context: MissionContext) -> None:
        """Work with this context."""
        super().__init__(name)
        self.context = context
        self.situation = context.situation
        self.reason = ""
        """Why it failed, as a clause; empty if it did not fail, or gave no reason."""

    def initialise(self) -> None:
        """Begin anew: forget why it failed before."""
        self.reason = ""

    @abstractmethod
    def update(self) -> Status:
        """Decide."""

    def succeed(self, message: str = "") -> Status:
        """Succeed, with a message for the log."""
        self.feedback_message = message
        return Status.SUCCESS

    def fail(self, reason: str) -> Status:
        """Fail, and keep the reason for the log and the person: one line, never empty."""
        self.reason = self.feedback_message = printable(reason).strip() or UNSAID
        self.situation.ending.last_word = self.reason
        return Status.FAILURE

    def why_before(self) -> str:
        """Why the alternative before this one failed, from the innermost fallback that knows."""
        node = self.parent
        while node and not (isinstance(node, Selector) and node.reason):
            node = node.parent
        return reason_of(node) if node else ""


def reason_of(node: Behaviour) -> str:
    """Why a behaviour failed: its own reason, or its failed child's; empty if there is none."""
    if isinstance(node, Step | Selector | _Loop):
        return node.reason
    failed = (child for child in node.children if child.status == Status.FAILURE)
    return next((reason_of(child) for child in failed), "")


class Check(Step):
    """A condition that a function of the situation decides."""

    def __init__(self, name: str, context: MissionContext, holds: Callable[[], bool]) -> None:
        """`name` says what is true when the condition holds."""
        super().__init__(name, context)
        self._holds = holds

    def update(self) -> Status:
        """Succeed if the condition holds."""
        return Status.SUCCESS if self._holds() else Status.FAILURE


class Action(Step):
    """Starts something slow, waits for its result, and cancels it when pre-empted or out of time.

    `start` returns the number of the request. `ended` turns the result into a status; to try once
    more it returns `self.start_again()`. After `patience_s` (mission time), `out_of_time` decides.
    """

    def __init__(self, name: str, context: MissionContext, patience_s: float) -> None:
        """Wait no longer than `patience_s` for each start."""
        super().__init__(name, context)
        self._patience_s = patience_s
        self._request: int | None = None
        self._deadline = 0.0

    @abstractmethod
    def start(self) -> int:
        """Start what takes time, and return the number of the request."""

    @abstractmethod
    def ended(self, result: Result) -> Status:
        """Decide what the result means."""

    @abstractmethod
    def cancel(self, request: int) -> None:
        """Cancel the request, so that no result comes."""

    @abstractmethod
    def out_of_time(self) -> Status:
        """Decide what it means that no result came in time; the request is already cancelled."""

    @property
    def is_under_way(self) -> bool:
        """Whether its request is open: neither ended nor cancelled, whatever the status says."""
        return self._request is not None

    def doing(self) -> str:
        """What the robot is doing meanwhile, to follow "I"; empty if there is nothing to say."""
        return ""

    def initialise(self) -> None:
        """Send the first request."""
        super().initialise()
        self.start_again()

    def start_again(self) -> Status:
        """Send a request, with a deadline of its own."""
        self.feedback_message = ""
        self._request = self.start()
        self._deadline = self.context.clock.now() + self._patience_s
        self.context.pending.wait_until(self._deadline, self._request, self.name)
        return Status.RUNNING

    def update(self) -> Status:
        """Check whether the request has ended, or its time is over."""
        request = self._request
        assert request is not None
        result = self.context.pending.take_end(request)
        if result is not None:
            self._wait_no_more(request)
            return self.ended(result)
        if self.context.clock.now() < self._deadline:
            return Status.RUNNING
        self.cancel(request)
        self._wait_no_more(request)
        return self.out_of_time()

    def terminate(self, new_status: Status) -> None:
        """Cancel the request if it is still open."""
        if (request := self._request) is not None:
            self._wait_no_more(request)
            self.cancel(request)

    def _wait_no_more(self, request: int) -> None:
        self._request = None
        self.context.pending.wait_no_more(request)

    def failed(self, result: Result) -> Status:
        """Fail with the reason of a result that is not a success."""
        return self.fail(why_of(result))


def why_of(result: Result) -> str:
    """The reason of a result that is not a success, as an adapter gave it; short, never empty."""
    if not isinstance(result, Failed):
        return f"it ended with {type(result).__name__}, which makes no sense here"
    why = printable(result.reason[:LONGEST]).strip() or UNSAID
    return f"{why} ..." if len(result.reason) > LONGEST else why


class Optionally(FailureIsSuccess):
    """Ignores the failure of its child, which then leaves no last word behind either."""

    def __init__(self, name: str, situation: Situation, child: Behaviour) -> None:
        """Guard the last word of this situation."""
        super().__init__(name, child)
        self._situation = situation
        self._last_word = ""

    def initialise(self) -> None:
        """Remember the last word of what came before."""
        self._last_word = self._situation.ending.last_word

    def update(self) -> Status:
        """Succeed in any case; after a failure, restore the last word."""
        if self.decorated.status == Status.FAILURE:
            self._situation.ending.last_word = self._last_word
        return super().update()


class _Loop(Decorator):
    """Runs its child for one item after another; goes on to the next within the same tick."""

    ends_on: Status
    """The loop ends with this status as soon as the child has it."""
    exhausted: Status
    """The status of the loop when there are no more items."""

    def __init__(
        self,
        name: str,
        items: Callable[[], Iterable[Any]],
        child: Behaviour,
        *,
        choose: Callable[[Any], None] | None = None,
    ) -> None:
        """`items` is called once, at the start; each item is taken when the one before is done.

        `choose` is called with each item before the child is ticked for it: it puts the item where
        the child can read it.
        """
        super().__init__(name, child)
        self._items = items
        self._choose = choose
        self._rest: Iterator[Any] = iter(())
        self.reason = ""
        """The last reason that the child failed with."""

    def tick(self) -> Iterator[Behaviour]:
        """Tick the child for the current item; whenever it is done, go on to the next one."""
        if self.status != Status.RUNNING:
            self._rest, self.reason = iter(self._items()), ""
            if not self._next():
                self.stop(self.exhausted)
                yield self
                return
        while True:
            yield from self.decorated.tick()
            status = self.decorated.status
            if status == Status.RUNNING:
                self.status = status
                break
            if status == Status.FAILURE:
                self.reason = reason_of(self.decorated) or self.reason
            if status == self.ends_on or not self._next():
                self.stop(status if status == self.ends_on else self.exhausted)
                break
        yield self

    def update(self) -> Status:
        """Unused: `tick` decides."""
        return self.status

    def _next(self) -> bool:
        for item in self._rest:
            if self._choose:
                self._choose(item)
            self.feedback_message = str(item)
            return True
        return False


class FirstOf(_Loop):
    """A fallback over data: succeeds with the first item for which the child succeeds.

    With no item, it fails. So with a list of one item or none, it is a condition.
    """

    ends_on = Status.SUCCESS
    exhausted = Status.FAILURE


class EachOf(_Loop):
    """A sequence over data: succeeds when the child succeeded for every item.

    With no item, it succeeds without a tick. So with a list of one item or none, it is an `if`.
    """

    ends_on = Status.FAILURE
    exhausted = Status.SUCCESS
