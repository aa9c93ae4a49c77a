"""Why something failed is a value: of the behaviour that failed, and of the fallback around it."""

from types import SimpleNamespace
from typing import cast

import pytest
from py_trees.behaviour import Behaviour
from py_trees.common import Status
from py_trees.trees import BehaviourTree

from executive.situation import Situation
from trees.context import MissionContext
from trees.nodes import Check, FirstOf, Optionally, Selector, Step, fallback, reason_of, sequence


@pytest.fixture
def context() -> MissionContext:
    """As much of it as these behaviours look at."""
    return cast(MissionContext, SimpleNamespace(situation=Situation()))


class Fails(Step):
    def __init__(self, why: str, context: MissionContext) -> None:
        super().__init__("fails", context)
        self.why = why

    def update(self) -> Status:
        return self.fail(self.why)


class Waits(Step):
    """Waits a tick, then tells why what was tried before it failed."""

    def update(self) -> Status:
        return Status.RUNNING if self.status != Status.RUNNING else self.succeed(self.why_before())


def ticked(root: Behaviour, times: int = 1) -> Behaviour:
    tree = BehaviourTree(root)
    for _ in range(times):
        tree.tick()
    return root


def no(context: MissionContext) -> Check:
    return Check("no", context, lambda: False)


def test_a_fallback_fails_for_what_its_last_child_says_that_says_why(context) -> None:
    root = fallback("any", Fails("a", context), Fails("b", context), no(context))
    assert reason_of(ticked(root)) == "b"


def test_a_sequence_fails_for_what_its_child_fails_for(context) -> None:
    root = sequence("all", Optionally("if", context.situation, Fails("a", context)), no(context))
    assert reason_of(ticked(root)) == ""


def test_a_loop_fails_for_what_its_last_item_says_that_says_why(context) -> None:
    items = iter(("a", ""))
    child = fallback("any", Fails("a", context))
    one = sequence("one", Check("first", context, lambda: bool(next(items))), child)
    root = FirstOf("each", lambda: (1, 2), one)
    assert reason_of(ticked(root)) == "a"


def test_why_it_failed_before_is_known_many_ticks_later(context) -> None:
    waits = Waits("waits", context)
    ticked(fallback("any", Fails("a", context), sequence("then", waits)), times=2)
    assert waits.feedback_message == "a"


def test_what_failed_in_an_earlier_round_is_no_reason_in_this_one(context) -> None:
    root = fallback("any", Check("no", context, lambda: False))
    assert isinstance(root, Selector)
    root.reason = "of an earlier round"
    assert reason_of(ticked(root)) == ""


def test_a_step_that_fails_without_a_word_has_none_of_its_former_words(context) -> None:
    class Once(Fails):
        def update(self) -> Status:
            return self.fail("a") if self.why else Status.FAILURE

    step = Once("a", context)
    ticked(step)
    step.why = ""
    assert reason_of(ticked(step)) == ""
