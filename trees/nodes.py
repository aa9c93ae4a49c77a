"""The kinds of behaviour that the subtrees are made of, beyond py_trees' own.

Rule of the house: a behaviour is RUNNING only while something that it started is under way, because
the tree is ticked by events. A loop therefore goes on within one tick, and waiting has a deadline.
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
"""Of a reason that an adapter gives (characters): it is to be a clause of a sentence."""
UNSAID = "it did not work, and nothing said why"
"""The reason of what fails without one."""


class Selector(composites.Selector):
    """A fallback that keeps why the child that it tried last failed, for those it tries then."""

    reason = ""

    def tick(self) -> Iterator[Behaviour]:
        """Tick the children as ever."""
        if self.status != Status.RUNNING:
            self.reason = ""
        for node in super().tick():
            if node.parent is self and node.status == Status.FAILURE:
                self.reason = reason_of(node) or self.reason
            yield node


def sequence(name: str, *children: Behaviour, activity: str = "") -> Sequence:
    """All children in order, until one fails; `activity` is what the robot does meanwhile."""
    node = Sequence(name, memory=True, children=list(children))
    vars(node)["activity"] = activity
    return node


def stages(name: str, *children: Behaviour) -> Sequence:
    """A sequence whose children are parts of the mission, each with a lane in the viewer."""
    for child in children:
        child.blackbox_level = BlackBoxLevel.BIG_PICTURE
    return sequence(name, *children)


def as_long_as(name: str, *children: Behaviour) -> Sequence:
    """A sequence that begins anew at each tick: the last child goes on while those before hold."""
    return Sequence(name, memory=False, children=list(children))


def beside(name: str, aside: Behaviour, main: Behaviour) -> Parallel:
    """Both at once: it ends as `main` does, whatever becomes of `aside`, which never fails."""
    policy = ParallelPolicy.SuccessOnSelected([main], synchronise=True)
    return Parallel(name, policy, children=[aside, main])


def fallback(name: str, *children: Behaviour) -> Selector:
    """The first child that succeeds."""
    return Selector(name, memory=True, children=list(children))


class Step(Behaviour):
    """Decides at once, from what is known: a condition, or a change of the situation.

    What it means for whoever reads the log is declared here, by a class or by one of its instances,
    and never guessed from a name: see `executive.records.NodeShape`.
    """

    source: str = ""
    activity: str = ""

    def __init__(self, name: str, context: MissionContext) -> None:
        """Keep the context at hand."""
        super().__init__(name)
        self.context = context
        self.situation = context.situation
        self.reason = ""
        """Why it failed, as a clause; empty if it did not, or fails without a word."""

    def initialise(self) -> None:
        """Begin: what it failed for before, counts no more."""
        self.reason = ""

    @abstractmethod
    def update(self) -> Status:
        """Decide."""

    def succeed(self, message: str = "") -> Status:
        """Succeed, and say in the log what with."""
        self.feedback_message = message
        return Status.SUCCESS

    def fail(self, reason: str) -> Status:
        """Fail, and keep why, for the log and for the person: on one line, and never empty."""
        self.reason = self.feedback_message = printable(reason).strip() or UNSAID
        self.situation.ending.last_word = self.reason
        return Status.FAILURE

    def why_before(self) -> str:
        """Why that failed which was tried before this, in the innermost fallback that knows."""
        node = self.parent
        while node and not (isinstance(node, Selector) and node.reason):
            node = node.parent
        return reason_of(node) if node else ""


def reason_of(node: Behaviour) -> str:
    """Why a behaviour failed: what the last said that failed within it; empty if none said why."""
    if isinstance(node, Step | Selector | _Loop):
        return node.reason
    failed = (child for child in node.children if child.status == Status.FAILURE)
    return next((reason_of(child) for child in failed), "")


class Check(Step):
    """A condition that a function of the situation decides."""

    def __init__(self, name: str, context: MissionContext, holds: Callable[[], bool]) -> None:
        """Name the condition as it reads when true."""
        super().__init__(name, context)
        self._holds = holds

    def update(self) -> Status:
        """Succeed if it holds."""
        return Status.SUCCESS if self._holds() else Status.FAILURE


class Action(Step):
    """Starts something slow, waits for its end, and cancels it when pre-empted or out of time.

    `start` returns the request's number; `ended` turns the result into a status, and may start
    anew by returning `self.start_again()`. After `patience_s` (mission time) the action fails.
    """

    def __init__(self, name: str, context: MissionContext, patience_s: float) -> None:
        """Wait no longer than `patience_s` for each start."""
        super().__init__(name, context)
        self._patience_s = patience_s
        self._request: int | None = None
        self._deadline = 0.0

    @abstractmethod
    def start(self) -> int:
        """Start it; return the number of the request."""

    @abstractmethod
    def ended(self, result: Result) -> Status:
        """Take in its end."""

    @abstractmethod
    def cancel(self, request: int) -> None:
        """Call it off."""

    @abstractmethod
    def out_of_time(self) -> Status:
        """Say that it took too long."""

    @property
    def is_under_way(self) -> bool:
        """Whether what it started was neither ended nor cancelled, whatever its status says."""
        return self._request is not None

    def doing(self) -> str:
        """What the robot does while it is under way, behind "I"; empty if there is no word."""
        return ""

    def initialise(self) -> None:
        """Start."""
        super().initialise()
        self.start_again()

    def start_again(self) -> Status:
        """Start, once more."""
        self.feedback_message = ""
        self._request = self.start()
        self._deadline = self.context.clock.now() + self._patience_s
        self.context.pending.wait_until(self._deadline, self._request, self.name)
        return Status.RUNNING

    def update(self) -> Status:
        """Look whether it ended."""
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
        """Cancel what is still under way."""
        if (request := self._request) is not None:
            self._wait_no_more(request)
            self.cancel(request)

    def _wait_no_more(self, request: int) -> None:
        self._request = None
        self.context.pending.wait_no_more(request)

    def failed(self, result: Result) -> Status:
        """Fail for the reason in a result that is no success."""
        return self.fail(why_of(result))


def why_of(result: Result) -> str:
    """The reason in a result that is no success, as an adapter gave it; short, and never empty."""
    if not isinstance(result, Failed):
        return f"it ended with {type(result).__name__}, which makes no sense here"
    why = printable(result.reason[:LONGEST]).strip() or UNSAID
    return f"{why} ..." if len(result.reason) > LONGEST else why


class Optionally(FailureIsSuccess):
    """Does what may fail: then all goes on, and for the log the last word is that of before."""

    def __init__(self, name: str, situation: Situation, child: Behaviour) -> None:
        """Keep the situation at hand."""
        super().__init__(name, child)
        self._situation = situation
        self._last_word = ""

    def initialise(self) -> None:
        """Remember the last word."""
        self._last_word = self._situation.ending.last_word

    def update(self) -> Status:
        """Succeed in either case."""
        if self.decorated.status == Status.FAILURE:
            self._situation.ending.last_word = self._last_word
        return super().update()


class _Loop(Decorator):
    """Runs its child for one item after another, going on to the next within the same tick."""

    ends_on: Status
    """The child's status that ends the loop, with the same status."""
    exhausted: Status
    """The status when all items were gone through."""

    def __init__(
        self,
        name: str,
        items: Callable[[], Iterable[Any]],
        child: Behaviour,
        *,
        choose: Callable[[Any], None] | None = None,
    ) -> None:
        """`items` is called once at the start, and each is taken when the one before is done.

        `choose` puts each into the situation, if the child is to know which it is.
        """
        super().__init__(name, child)
        self._items = items
        self._choose = choose
        self._rest: Iterator[Any] = iter(())
        self.reason = ""
        """Why its child failed, the last time that it said why."""

    def tick(self) -> Iterator[Behaviour]:
        """Tick the child for the item at hand, and for the next ones as long as it decides."""
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

    Over one item or none, it is a condition: without an item, it fails.
    """

    ends_on = Status.SUCCESS
    exhausted = Status.FAILURE


class EachOf(_Loop):
    """A sequence over data: succeeds when the child succeeded for every item.

    Over one item or none, it is an `if`: without an item, it succeeds, and nothing is done.
    """

    ends_on = Status.FAILURE
    exhausted = Status.SUCCESS
