"""Every behaviour declares what it means: who says so, and what the robot is doing."""

import ast
import inspect
import pkgutil
from collections.abc import Iterator
from importlib import import_module
from textwrap import dedent

import pytest

import trees
from executive.types.knowledge import Source
from trees.__main__ import build
from trees.nodes import Action, Step
from trees.tree import MissionTree


def descendants(kind: type) -> Iterator[type]:
    for child in kind.__subclasses__():
        yield child
        yield from descendants(child)


def classes_of(kind: type) -> list[type]:
    """The classes of this kind that the tree may be built of, in all files of trees/."""
    for module in pkgutil.walk_packages(trees.__path__, "trees."):
        if not module.name.endswith("__main__"):
            import_module(module.name)
    ours = (c for c in descendants(kind) if c.__module__.startswith("trees."))
    return list(dict.fromkeys(c for c in ours if not inspect.isabstract(c)))


def sets(kind: type, attribute: str) -> bool:
    """Whether something in this class sets an attribute of this name, of whatever it is."""
    nodes = ast.walk(ast.parse(dedent(inspect.getsource(kind))))
    attributes = (node for node in nodes if isinstance(node, ast.Attribute))
    return any(isinstance(a.ctx, ast.Store) and a.attr == attribute for a in attributes)


@pytest.mark.parametrize("action", classes_of(Action), ids=lambda kind: kind.__name__)
def test_what_starts_something_slow_declares_what_the_robot_is_doing(action: type[Action]) -> None:
    assert action.activity


def test_what_says_where_a_thing_may_be_declares_who_says_so() -> None:
    speakers = [step for step in classes_of(Step) if sets(step, "candidates")]
    assert speakers
    assert not [step for step in speakers if not (step.source or sets(step, "source"))]


@pytest.mark.parametrize("elicit", ["rank", "generate"])
def test_for_every_source_some_behaviour_of_the_mission_speaks(elicit: str) -> None:
    nodes = MissionTree(build("okb+llm+mem", elicit)).shape().nodes
    assert {node.source for node in nodes} >= set(Source) - {
        Source.HABITS
    }  # memory tells them, too
