"""The pieces that the tree is built of."""

from collections.abc import Callable

from py_trees.behaviour import Behaviour
from py_trees.common import Status
from py_trees.composites import Sequence

from executive.records import NodeState
from executive.testing.bench import run_mission
from trees.nodes import EachOf, FirstOf
from trees.tree import MissionTree


class Leaf(Behaviour):
    def __init__(self, name: str, decide: Callable[[], Status]) -> None:
        super().__init__(name)
        self.decide = decide

    def update(self) -> Status:
        return self.decide()


def loop(
    kind: type[FirstOf | EachOf], items: list[int], answers: dict[int, Status]
) -> tuple[FirstOf | EachOf, list[int]]:
    chosen: list[int] = []
    leaf = Leaf("leaf", lambda: answers[chosen[-1]])
    return kind("loop", lambda: items, leaf, choose=chosen.append), chosen


def test_first_of_goes_on_within_one_tick_until_one_succeeds() -> None:
    node, chosen = loop(
        FirstOf, [1, 2, 3], {1: Status.FAILURE, 2: Status.SUCCESS, 3: Status.SUCCESS}
    )
    node.tick_once()
    assert (node.status, chosen) == (Status.SUCCESS, [1, 2])


def test_first_of_fails_when_all_fail_and_for_nothing() -> None:
    node, chosen = loop(FirstOf, [1, 2], {1: Status.FAILURE, 2: Status.FAILURE})
    node.tick_once()
    assert (node.status, chosen) == (Status.FAILURE, [1, 2])
    node, _ = loop(FirstOf, [], {})
    node.tick_once()
    assert node.status == Status.FAILURE


def test_each_of_succeeds_when_all_succeed_and_for_nothing() -> None:
    node, chosen = loop(EachOf, [1, 2], {1: Status.SUCCESS, 2: Status.SUCCESS})
    node.tick_once()
    assert (node.status, chosen) == (Status.SUCCESS, [1, 2])
    node, _ = loop(EachOf, [], {})
    node.tick_once()
    assert node.status == Status.SUCCESS


def test_a_loop_keeps_its_place_while_the_child_runs_and_starts_over_afterwards() -> None:
    answers = {1: Status.FAILURE, 2: Status.RUNNING}
    node, chosen = loop(FirstOf, [1, 2], answers)
    node.tick_once()
    assert (node.status, chosen) == (Status.RUNNING, [1, 2])
    answers[2] = Status.SUCCESS
    node.tick_once()
    assert (node.status, chosen) == (Status.SUCCESS, [1, 2])
    node.tick_once()
    assert chosen == [1, 2, 1, 2]


def test_stopping_a_running_loop_stops_its_child() -> None:
    node, _ = loop(FirstOf, [1], {1: Status.RUNNING})
    tree = MissionTree(node)
    tree.tick()
    tree.stop()
    assert [state.status for state in tree.states()] == ["INVALID", "INVALID"]


def test_states_tell_a_new_message_of_what_goes_on_running() -> None:
    leaf = Leaf("leaf", lambda: Status.RUNNING)
    tree = MissionTree(leaf)
    for message in ("near", "nearer"):
        leaf.feedback_message = message
        tree.tick()
        assert tree.states() == (NodeState("leaf", "RUNNING", message),)


def test_states_of_one_tick_stay_as_they_are_in_the_next() -> None:
    tree = MissionTree(Leaf("leaf", iter((Status.RUNNING, Status.FAILURE)).__next__))
    tree.tick()
    before = tree.states()
    tree.tick()
    assert [state.status for state in (*before, *tree.states())] == ["RUNNING", "FAILURE"]


def test_a_behaviour_that_was_interrupted_has_no_message() -> None:
    leaf = Leaf("leaf", lambda: Status.RUNNING)
    tree = MissionTree(leaf)
    leaf.feedback_message = "on my way"
    tree.tick()
    tree.states()
    tree.stop()
    assert tree.states() == (NodeState("leaf", "INVALID"),)


def test_paths_are_unique_even_where_names_are_not() -> None:
    twins = [Leaf("look", lambda: Status.SUCCESS) for _ in range(2)]
    tree = MissionTree(Sequence("root", memory=True, children=list(twins)))
    assert [node.path for node in tree.shape().nodes] == ["root", "root/look", "root/look 2"]
    assert [node.parent for node in tree.shape().nodes] == ["", "root", "root"]


def test_hearing_is_no_fault_and_what_is_to_be_done_is_tried_next() -> None:
    ticks = run_mission("Find the hammer", llm=False).ticks
    heard = [{n.path: n.status for n in tick.nodes}["mission/and go on/hear"] for tick in ticks]
    assert "SUCCESS" in heard
    assert "FAILURE" not in heard


def test_what_was_active_inside_of_what_is_not_any_more_is_not_active() -> None:
    leaf = Leaf("leaf", lambda: Status.RUNNING)
    inner = Sequence("inner", memory=True, children=[leaf])
    tree = MissionTree(Sequence("root", memory=True, children=[inner]))
    tree.tick()
    assert [state.status for state in tree.states()] == ["RUNNING"] * 3
    inner.stop(Status.INVALID)
    assert [state.status for state in tree.states()] == ["RUNNING", "INVALID", "INVALID"]
    tree.tick()
    assert [state.status for state in tree.states()] == ["RUNNING"] * 3
