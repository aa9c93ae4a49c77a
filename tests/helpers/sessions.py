"""A long session, made up: what the experimenter's page is tried with."""

from collections.abc import Iterator

from executive.events import DeadlinePassed, Ended, Heard
from executive.records import (
    EventTaken,
    NodeShape,
    NodeState,
    Record,
    Tick,
    TreeShape,
    Utterance,
)
from executive.types.results import Succeeded

BRANCHES, LEAVES = 25, 7


def long_session(ticks: int) -> Iterator[Record]:
    """A tree of 201 behaviours; at each tick one branch works, and now and then something is said.

    Of 10,000 ticks in 40 minutes, four come in a second.
    """
    root = NodeShape("mission", "", "mission", "selector", "Selector")
    branches = [
        NodeShape(f"mission/branch {b}", "mission", f"branch {b}", "sequence", "Sequence")
        for b in range(BRANCHES)
    ]
    leaves = [
        NodeShape(f"{branch.path}/step {n}", branch.path, f"step {n}", "behaviour", "Step")
        for branch in branches
        for n in range(LEAVES)
    ]
    yield TreeShape((root, *branches, *leaves))
    for number in range(ticks):
        if number % 20 == 0:
            yield EventTaken(Heard(f"Where are you? ({number})"))
            yield Utterance("robot", f"I am at step {number % LEAVES}.")
        else:
            yield EventTaken(
                DeadlinePassed(number / 4) if number % 3 else Ended(number, Succeeded())
            )
        yield _tick(number, [root, *branches, *leaves])


def _tick(number: int, shapes: list[NodeShape]) -> Tick:
    works, step = (number // LEAVES) % BRANCHES, number % LEAVES

    def state(shape: NodeShape) -> NodeState:
        branch = f"mission/branch {works}"
        if shape.path in ("mission", branch):
            return NodeState(shape.path, "RUNNING")
        if not shape.path.startswith(f"{branch}/"):
            done = shape.kind == "sequence" and number % 2 == 0
            return NodeState(shape.path, "FAILURE" if done else "INVALID")
        at = int(shape.path.rsplit(" ", 1)[1])
        status = "SUCCESS" if at < step else "RUNNING" if at == step else "INVALID"
        return NodeState(shape.path, status, f"try {number}" if at == step else "")

    situation = {
        "words": "Tidy up",
        "round": number // 50,
        "visited": [f"place {works}"],
        "object": "mug",
    }
    nodes = tuple(map(state, shapes))
    return Tick(number, "DeadlinePassed", f"mission/branch {works}", nodes, situation, 0.001)
