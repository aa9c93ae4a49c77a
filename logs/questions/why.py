"""Why the robot did it: the chain of decisions from words to deed, read from the recorded ticks.

Every fallback of the tree is a decision, and its children are the alternatives: the one that
succeeded was taken, those before it failed and gave a reason, those after it were not needed.
"""

import re
from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from heapq import merge
from itertools import islice

from executive.belief import PLAN
from executive.events import Heard, Started
from executive.records import (
    Activity,
    EventTaken,
    Intervention,
    LlmCall,
    NodeShape,
    NodeState,
    Planned,
    Tick,
    TreeShape,
    Utterance,
    Verified,
)
from executive.types.results import Scored
from logs.questions.changes import (
    is_under_way,
    parts_ended,
    split,
    tasks_ended,
    visits,
    where_to_look,
)
from logs.questions.decision import NOT_NEEDED, PERSON, WORLD, Alternative, Decision
from logs.questions.interventions import EXPERIMENTER, done
from logs.recording.reader import At, Run

LOOK_OR_ASK = "look or ask"
"""The question that a plan answers."""
MOST_TOLD, LEAST = 5, 0.005
"""The largest number of alternatives of a plan that are told, and the least probability of one."""
SOMETHING = "something"
_VERB = re.compile(r"\b(is|was|may)\b")


def why(run: Run) -> list[Decision]:
    """All decisions of a mission in order of time: with what was said, faults, and the outcome."""
    chain = merge(
        _asked(run),
        _faults(run),
        _interventions(run),
        _heard(run),
        _Chain(run).decisions(),
        _plans(run),
        key=lambda decision: decision.time_s,
    )
    return [*chain, *_outcome(run)]


def _asked(run: Run) -> Iterator[Decision]:
    """The words that the mission began with."""
    for at in run.records(EventTaken):
        match at.value.event:
            case Started(words):
                yield Decision(at.time_s, "asked", f"'{words}'", PERSON, "")


def _faults(run: Run) -> Iterator[Decision]:
    """The injected faults that occurred in the simulated world."""
    for at in run.mishaps():
        yield Decision(at.time_s, "fault", f"{at.value.fault}: {at.value.text}", WORLD, "")


def _interventions(run: Run) -> Iterator[Decision]:
    """What an experimenter did in place of the person or the robot."""
    for at in run.records(Intervention):
        who = at.value.by
        yield Decision(at.time_s, f"{who} stepped in", done(at.value), EXPERIMENTER, who)


def _heard(run: Run) -> Iterator[Decision]:
    """What the person said unasked, and what the robot answered."""
    waiting: list[At[Heard]] = []
    for at in run.records(EventTaken, Utterance):
        match at.value:
            case EventTaken(Heard() as heard):
                waiting.append(At(at.time_s, heard))
            case Utterance(speaker="robot", text=answer) if waiting:
                before = waiting.pop(0)
                yield Decision(before.time_s, f"heard '{before.value.words}'", answer, PERSON, "")


def _plans(run: Run) -> Iterator[Decision]:
    """The plans: where to look next, or whether to ask, with the other places."""
    for at in run.records(Planned):
        others = tuple(_less_likely(at.value))
        yield Decision(at.time_s, LOOK_OR_ASK, at.value.text, "", "", others)


def _outcome(run: Run) -> Iterator[Decision]:
    """How the mission ended; nothing if the recording breaks off before."""
    if (outcome := run.outcome()) is not None:
        ending = outcome.reason or outcome.status
        yield Decision(outcome.mission_time_s, "outcome", ending, "", outcome.status)


class _Chain:
    """Follows the fallbacks of one mission from tick to tick."""

    def __init__(self, run: Run) -> None:
        self._run = run
        self._branches = _Branches(run.tree())
        self._searches = {n.path for n in run.tree().nodes if n.activity == Activity.SEARCHING}
        self._reasons: dict[str, str] = {}
        self._thoughts: list[LlmCall | Verified] = []

    def decisions(self) -> Iterator[Decision]:
        before: At[Tick] | None = None
        for thought in self._run.thoughts():
            if not isinstance(thought.value, Tick):
                self._thoughts.append(thought.value)
                continue
            at = At(thought.time_s, thought.value)
            states = {node.path: node for node in at.value.nodes}
            yield from visits(before, at, self._searches)
            ended = [*parts_ended(before, at), *tasks_ended(before, at)]
            goes_on = bool(ended) and is_under_way(at)
            if goes_on:  # then what is settled in this tick belongs to the next task
                yield from ended
                self._reasons.clear()
                self._thoughts.clear()
            anew = goes_on or before is None
            yield from split(before, at)
            settled = list(_outermost(self._settled(at, states, None if anew else before)))
            yield from settled
            yield from where_to_look(before, at, {d.answer for d in settled})
            if not goes_on:
                yield from ended
            self._remember(states)
            before = at

    def _settled(
        self, at: At[Tick], states: dict[str, NodeState], before: At[Tick] | None
    ) -> Iterator[Decision]:
        """The fallbacks that have succeeded or failed in a tick, and had not before it."""
        earlier = {node.path: node.status for node in before.value.nodes} if before else {}
        for fallback in self._branches.fallbacks:
            status = states[fallback.path].status
            if status in ("SUCCESS", "FAILURE") and earlier.get(fallback.path) != status:
                decision = self._decision(at, fallback, states)
                if decision.source != PLAN or _failed(decision):  # a plan has a record of its own
                    yield decision

    def _decision(
        self, at: At[Tick], fallback: NodeShape, states: dict[str, NodeState]
    ) -> Decision:
        alternatives: list[Alternative] = []
        taken: NodeShape | None = None
        for child in self._branches.children[fallback.path]:
            if taken is not None:
                alternatives.append(Alternative(child.name, NOT_NEEDED))
            elif states[child.path].status == "SUCCESS":
                taken = child
            elif child.source != PLAN and (reason := self._reason(child, states)):
                alternatives.append(Alternative(child.name, reason))
        if taken is None:
            return Decision(at.time_s, fallback.name, "nothing worked", "", "", tuple(alternatives))
        last = self._last(taken, lambda leaf: states[leaf.path].status == "SUCCESS") or taken
        if last.source:
            alternatives += dict.fromkeys(self._passed_over(at))
        return Decision(
            time_s=at.time_s,
            question=fallback.name,
            answer=states[last.path].message or taken.name,
            source=last.source,
            by=last.path,
            alternatives=tuple(alternatives),
        )

    def _passed_over(self, at: At[Tick]) -> Iterator[Alternative]:
        """What the model named or scored since the last sourced decision, and was not taken."""
        situation = at.value.situation
        taken = {c["place"] for c in situation.get("candidates") or ()}
        taken.add((situation.get("command") or {}).get("kind"))
        for thought in self._thoughts:
            if isinstance(thought, LlmCall):
                yield from (a for a in _outranked(thought) if a.what not in taken)
                continue
            among = bool(situation.get("among"))
            why_not = "none of its usual places" if among else "no such place here"
            yield from (Alternative(name, why_not) for name in thought.dropped)
        self._thoughts.clear()

    def _reason(self, child: NodeShape, states: dict[str, NodeState]) -> str:
        """Why a child failed: the message of its last leaf that failed, now or before.

        A leaf without a message counts as the opposite of its name, or as `no` if it is the child.
        Empty if no leaf has failed: there was nothing to try.
        """
        leaf = self._last(
            child, lambda leaf: states[leaf.path].status == "FAILURE" or leaf.path in self._reasons
        )
        if leaf is None:
            return ""
        now = states[leaf.path]
        said = now.message if now.status == "FAILURE" else self._reasons[leaf.path]
        return said or ("no" if leaf is child else denied(leaf.name))

    def _last(self, node: NodeShape, holds: Callable[[NodeShape], bool]) -> NodeShape | None:
        return next(filter(holds, reversed(self._branches.leaves[node.path])), None)

    def _remember(self, states: dict[str, NodeState]) -> None:
        for path, state in states.items():
            if state.status == "FAILURE":
                self._reasons[path] = state.message
            elif state.status == "SUCCESS":
                self._reasons.pop(path, None)


class _Branches:
    """The branches of a tree: children, leaves, and fallbacks, of which inner ones come first.

    In this order the fallbacks are settled.
    """

    def __init__(self, tree: TreeShape) -> None:
        self.children: dict[str, list[NodeShape]] = defaultdict(list)
        for node in tree.nodes:
            self.children[node.parent].append(node)
        nodes = {node.path: node for node in tree.nodes}
        self.leaves: dict[str, list[NodeShape]] = defaultdict(list)
        """The leaves below each behaviour; a leaf has itself."""
        for leaf in (node for node in tree.nodes if node.path not in self.children):
            above: NodeShape | None = leaf
            while above is not None:
                self.leaves[above.path].append(leaf)
                above = nodes.get(above.parent)
        self.fallbacks = [
            node
            for root in self.children[""]
            for node in self._inner_first(root)
            if node.kind == "selector" and node.parent
        ]

    def _inner_first(self, node: NodeShape) -> Iterator[NodeShape]:
        for child in self.children.get(node.path, ()):
            yield from self._inner_first(child)
        yield node


def _outermost(settled: Iterable[Decision]) -> Iterator[Decision]:
    """The decisions without those that an outer one of the same leaf repeats.

    The outer one gets their alternatives, too.
    """
    last: Decision | None = None
    for decision in settled:
        if last is not None and last.by and last.by == decision.by:
            spared = (*decision.alternatives, *last.alternatives)
            decision = replace(decision, alternatives=spared)
        elif last is not None:
            yield last
        last = decision
    if last is not None:
        yield last


def _failed(decision: Decision) -> bool:
    """Whether an alternative had failed."""
    return any(a.why_not != NOT_NEEDED for a in decision.alternatives)


def _less_likely(planned: Planned) -> Iterator[Alternative]:
    """The likeliest other places: how likely they are, who says so, and how far away they are."""
    away = dict(zip(planned.places, planned.away, strict=False))
    next_s = min((away.get(place, -1.0) for place in planned.order[:1]), default=-1.0)
    told = zip(planned.places, planned.probabilities, planned.says, strict=False)
    others = (
        (place, p, says) for place, p, says in told if place not in planned.order[:1] and p >= LEAST
    )
    for place, probability, says in islice(others, MOST_TOLD):
        likely = f"{probability:.2f} ({says})" if says else f"{probability:.2f}"
        yield Alternative(place, likely + _farther(away.get(place, -1.0), next_s))


def _farther(seconds: float, next_s: float) -> str:
    """The time to drive and look there, compared with the next place; empty if it is unknown."""
    if seconds < 0:
        return ""
    return f", {seconds:.0f} s away" + (f" instead of {next_s:.0f}" if next_s >= 0 else "")


def _outranked(call: LlmCall) -> list[Alternative]:
    if not isinstance(call.result, Scored):
        return []
    ranked = sorted(zip(call.result.scores, call.result.request.places, strict=True), reverse=True)
    return [Alternative(place, f"scored {score:.2f}") for score, place in ranked]


def denied(condition: str) -> str:
    """The opposite of a condition, whose name says what is true if it holds.

    `it was there` becomes `it was not there`, and `in my hand` becomes `not in my hand`.
    """
    if condition.startswith(SOMETHING):
        return f"nothing{condition.removeprefix(SOMETHING)}"
    contrary, verbs = _VERB.subn(r"\1 not", condition, count=1)
    return contrary if verbs else f"not {condition}"
